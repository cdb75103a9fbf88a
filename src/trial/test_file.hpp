// A test of behaviour, NAME.test.json: a plan, perhaps in a world, or a world whose robots run
// their scripts, with what is expected of each of its runs (docs/formats.md, "Test file").
//
//     const TestFile test = TRY(read_test(text, "examples/follow-wall/Wall.test.json"));
//     for (uint64_t seed = test.seeds.first; seed <= test.seeds.last; ++seed) run(test, seed);
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "base/result.hpp"
#include "base/time.hpp"
#include "sim/chaos.hpp"
#include "sim/definitions.hpp"
#include "trial/condition.hpp"

namespace vagus::trial {

constexpr std::string_view kTestEnding = ".test.json";
constexpr uint64_t kSeedsMax = 10'000;      // of one test
constexpr uint64_t kSeedMax = INT64_MAX;    // as numbers of JSON are read
constexpr size_t kExpectationsMax = 1'000;  // of one test
constexpr double kMaxTimeMax = 86'400;      // s
constexpr double kMaxTimeUnlessSaid = 60;   // s
constexpr double kWithinMax = kMaxTimeMax;  // s
constexpr size_t kOrderMax = 10'000;        // actors of one order

struct SeedRange {
    uint64_t first = 1;
    uint64_t last = 1;
};

// Where a robot begins, drawn for each seed: uniformly in a rectangle, m, and between two angles.
struct Starts {
    std::string robot;
    sim::Point low, high;
    double angle_low = 0, angle_high = 0;  // degrees, counter-clockwise; 0 to 360: any
};

struct Expectation {
    enum class Kind : uint8_t { Order, Eventually, Always, Never, Ends };
    Kind kind = Kind::Ends;
    Place at = {};  // of it in the file
    std::string help = {};
    std::vector<std::string> order = {};      // names of actors, or SUB-PLAN'S ACTOR/ACTOR
    std::optional<double> within = {};        // s; of Eventually
    std::optional<Condition> condition = {};  // of Eventually, Always, Never
    std::string ends = {};                    // one of ways_to_end()
    std::string by = {};                      // the supervisor that ended it; empty: any
};

// "OK", "Interrupted", "Error", and kEndsMaxTime: its time was over.
constexpr std::string_view kEndsMaxTime = "MaxTime";
const std::vector<std::string_view>& ways_to_end();

// `always "contact < 2"`: what is expected, for people.
std::string text_of(const Expectation& expectation);

struct TestFile {
    std::string path;  // as it was opened
    std::string help = {};
    // Paths as seen from where the test was opened. One of plan and world is there.
    std::string plan = {};                  // empty: the world alone, with its scripts
    std::string world = {};                 // empty: the plan alone, in virtual time
    std::vector<std::string> scripts = {};  // without a plan: --load of `vagus sim`
    std::vector<std::string> toolboxes = {};
    std::string robot = {};  // that the plan drives, or signals are about; empty: the only one
    SeedRange seeds = {};
    double max_time = kMaxTimeUnlessSaid;  // s
    std::vector<std::string> set = {};     // NAME=VALUE
    std::optional<Starts> starts = {};
    bool answers = false;   // it has the key "answers" (run/answers.hpp)
    sim::Chaos chaos = {};  // what breaks in each of its runs
    std::vector<Expectation> expect = {};
};

// The Error reads "FILE:LINE:COL: sentence". What only the plan and the world can tell is not
// checked here (trial.hpp).
Result<TestFile> read_test(std::string_view text, const std::string& path);

// "A..B" or "A". The Error says what was expected.
Result<SeedRange> parse_seeds(const std::string& text);

}  // namespace vagus::trial
