// Tests of behaviour, for pages: the commands tests.run and tests.stop, and the topics tests and
// coverage. They are run by a process of its own (`vagus test-host`), which runs each seed in one
// more. What is run is what the editor shows: all is saved first, as before any run.
//
//     TestDesk tests(desk, files, scripts, start, {.doc_of = …, .shorten = …, .save_all = …});
//     tests.tick(now);
//     tests.text_changed("Wall.test.json");      // what was counted is of another text
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/project/files.hpp"
#include "serve/run/run.hpp"
#include "serve/script/scripts.hpp"
#include "serve/studio/desk.hpp"
#include "serve/workbench/telling_process.hpp"
#include "trial/told.hpp"

namespace vagus::serve {

constexpr size_t kTestsRunMax = 1000;       // tests of one run
constexpr size_t kFailuresToldMax = 100;    // of one test; the others are counted
constexpr size_t kFailuresOfRunMax = 1000;  // the same, of all tests together
constexpr Duration kTestsSilentMax = 300s;  // no seed has ended: then the run is ended
constexpr Duration kTestsLookEvery = 50ms;
constexpr size_t kTestMemoryMax = size_t{2} << 30;  // of each process

class TestDesk {
public:
    struct Project {
        std::function<std::string(const std::string& file)> doc_of;   // of a file of this computer
        std::function<std::string(const std::string& text)> shorten;  // paths as pages call them
        std::function<bool(const Call& call)> save_all;               // false: it has said why not
    };

    // Borrowed. Declares its commands and topics.
    TestDesk(Desk& desk, Files& files, Scripts& scripts, StartRunProcess start, Project project);

    void tick(Time now);
    Time next_tick() const;
    // Counts only if it is another one than it was when the run began.
    void text_changed(const std::string& path);
    // Of a run that failed: a path that no document has.
    bool has_recording(const std::string& path) const;
    // Another project: what runs is ended.
    void forget();

private:
    enum class State { None, Running, Done, Stopped, Failed };
    struct Failed {
        uint64_t seed = 0;
        trial::Failure failure;  // unless there is a trouble
        std::string trouble;
        std::string recording;  // path; empty: none that can be opened
    };
    struct Test {
        std::string path;
        uint64_t runs = 0, done = 0, failed = 0;
        bool world = false;
        std::string refused = {};
        std::vector<Failed> failures = {};
        // All its runs are done, or it has none.
        bool is_over() const { return !refused.empty() || (runs > 0 && done == runs); }
    };

    // Of a file on disk, or of none.
    struct Stamp {
        bool exists = false;
        std::filesystem::file_time_type written{};
        uintmax_t size = 0;
        bool operator==(const Stamp&) const = default;
    };

    void run(const Call& call);
    void stop(const Call& call);
    Result<std::vector<std::string>> paths_of(const Call& call) const;
    Status begin(const std::vector<std::string>& paths, bool scripts);
    std::string real(const std::string& path) const;
    Stamp stamp_of(const std::string& path) const;
    void hear(const Packet& packet);
    void planned(const std::vector<trial::PlannedTest>& tests);
    void take(trial::SeedTold told);
    void add_failures(Test& test, trial::SeedTold& told);
    void add_coverage(trial::Coverage& told);
    void end(State how, std::string why = {});
    std::string why_silent() const;
    void touch();
    Json document() const;
    Json document_of(const Test& test) const;
    Json place_in(const Test& test) const;
    Json document_of(const Failed& failed) const;
    Json coverage_table() const;
    Json coverage_of(const std::string& doc);

    Desk& desk_;
    Files& files_;
    Scripts& scripts_;
    const StartRunProcess start_;
    const Project project_;

    State state_ = State::None;
    std::string why_;
    bool counts_scripts_ = false;
    TellingProcess process_;
    std::vector<Test> tests_;
    trial::Coverage coverage_;  // by document instead of by file
    std::map<std::string, Stamp> began_with_;
    std::set<std::string> changed_;
    size_t told_ = 0;  // failures
    Time now_{};
};

}  // namespace vagus::serve
