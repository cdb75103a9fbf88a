// Samples under every single fault of --chaos: Carbot brakes within 350 ms of the last sign of life
// and is at rest within 0.9 s, and so is a Thymio that runs drive.aesl (docs/carbot.md,
// docs/thymio.md). What moves is looked at, not what variables say of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "base/test_places.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/prepared_run.hpp"
#include "session/plan_world.hpp"
#include "session/toolboxes.hpp"
#include "sim/chaos_file.hpp"

namespace vagus {
namespace {

using namespace std::chrono_literals;

constexpr Duration kBrakesWithin = 350ms;
constexpr Duration kRestsWithin = 900ms;
constexpr Duration kSlowerWithin = kBrakesWithin + 100ms;  // 0.6 m/s^2 take 60 mm/s off
constexpr double kSlower = 0.03;                           // m/s: half of it
constexpr double kRest = 0.002;                            // m/s: what still counts as rest
constexpr double kRim = 0.1;                               // m: what turns moves so far out
constexpr Time kFaultBegins = 5s;                          // it drives then
constexpr Time kFaultEnds = 8s;

struct Sample {
    std::string plan;
    std::string world;
    uint16_t node;  // that drives
};

const Sample kCarbot = {test::examples("follow-wall/WallFollow.plan.json"),
                        test::examples("follow-wall/hall.world.json"), 1};
const Sample kThymio = {test::examples("patterns/Square.plan.json"),
                        test::examples("patterns/thymio.world.json"), 1};

// Looks at the robot each millisecond.
class Watch {
public:
    Watch(session::SimSession& session, uint16_t node) : session_(session), node_(node) {
        const auto words = session.world().variables(robot_, node);
        for (const auto& [name, value] : session.script_variables(node)) {
            if (name == "patience") patience_ = static_cast<size_t>(value.data() - words.data());
        }
        pose_ = session.world().robots()[0].pose;
    }

    bool found() const { return patience_ > 0; }
    void look() {
        const Time now = session_.now();
        const int16_t patience = session_.world().variables(robot_, node_)[patience_];
        if (patience > patience_before_) {
            last_sign_ = now;
            lowest_.reset();
            ++signs_;
        }
        patience_before_ = patience;
        if (now % sim::kPhysicsStep == Duration::zero()) look_at_speed(now);
    }
    double fastest() const { return fastest_; }
    int signs() const { return signs_; }
    const std::string& wrong() const { return wrong_; }

private:
    void look_at_speed(Time now) {
        const sim::Pose pose = session_.world().robots()[0].pose;
        const double way = std::hypot(pose.at.x - pose_.at.x, pose.at.y - pose_.at.y);
        const double turn = std::remainder(pose.angle - pose_.angle, 2 * 3.14159265358979);
        const double speed = (way + kRim * std::abs(turn)) / 0.01;
        pose_ = pose;
        fastest_ = std::max(fastest_, speed);
        const Duration silent = now - last_sign_;
        if (silent <= kBrakesWithin) return;
        if (!lowest_) lowest_ = at_350_ = speed;
        if (speed > *lowest_ + kRest) complain(now, speed, "is faster again");
        lowest_ = std::min(*lowest_, speed);
        const bool slower = speed <= std::max(at_350_ - kSlower, kRest);
        if (silent > kSlowerWithin && !slower) complain(now, speed, "does not brake");
        if (silent > kRestsWithin && speed > kRest) complain(now, speed, "is not at rest");
    }
    void complain(Time now, double speed, const char* what) {
        if (!wrong_.empty()) return;
        wrong_ = std::string(what) + " at " + std::to_string(now.count()) + " us, " +
                 std::to_string((now - last_sign_).count()) + " us after a sign of life, at " +
                 std::to_string(speed) + " m/s";
    }

    session::SimSession& session_;
    uint16_t node_;
    sim::RobotId robot_{1};
    size_t patience_ = 0;
    int16_t patience_before_ = 0;
    int signs_ = 0;
    Time last_sign_ = -10s;
    std::optional<double> lowest_;
    double at_350_ = 0;
    double fastest_ = 0;
    sim::Pose pose_;
    std::string wrong_;
};

// What a run of a sample came to.
struct Came {
    std::string wrong;
    double fastest = 0;
    int signs = 0;
    std::vector<std::string> told = {};  // of its faults
};

Came run(const Sample& sample, const std::vector<sim::ChaosFault>& faults) {
    toolbox::Parts parts;
    run::CodeLibrary library;
    EXPECT_TRUE(session::add_toolboxes(library, parts, {}).ok());
    const auto plan = embed::LoadedPlan::from_file(sample.plan, library);
    EXPECT_TRUE(plan.ok()) << plan.report();
    embed::RunWords words;
    words.world = sample.world;
    words.clock = "virtual";
    words.max_time = "15";
    if (!faults.empty()) words.chaos = sim::format_chaos(faults);
    auto prepared = embed::PreparedRun::prepare(plan, words, parts);
    if (!prepared.ok()) return {.wrong = prepared.error().what};
    prepared.value()->tell([](const std::string&) {});
    session::SimSession& session = prepared.value()->world()->session();
    Watch watch(session, sample.node);
    if (!watch.found()) return {.wrong = "the script has no variable patience"};
    Came came;
    session.on_instant([&] {
        watch.look();
        for (const sim::Happening& one : session.world().happenings()) {
            const auto* const note = std::get_if<sim::ChaosNote>(&one.what);
            if (note != nullptr) came.told.push_back(note->what);
        }
    });
    const auto ended = prepared.value()->run();
    EXPECT_TRUE(ended.ok());
    session.step(2s);  // the plan may have ended while it drove
    session.forget_listeners();
    came.wrong = watch.wrong();
    came.fastest = watch.fastest();
    came.signs = watch.signs();
    return came;
}

std::vector<sim::ChaosTarget> targets_of(const Sample& sample) {
    auto session = session::open_sim(sample.world, {});
    EXPECT_TRUE(session.ok());
    return session.value().world().chaos_targets();
}

// Each kind, at each place, in strengths from hardly noticed to total.
class Faults {
public:
    explicit Faults(const Sample& sample) {
        std::vector<std::string> links = {"main"};
        for (const sim::ChaosTarget& target : targets_of(sample)) {
            links.push_back(target.node);
            for (const auto kind :
                 {sim::ChaosKind::Reset, sim::ChaosKind::Hung, sim::ChaosKind::Unplugged}) {
                add({.kind = kind, .where = target.node});
            }
            for (const std::string& sensor : target.sensors) of_sensor(target.node, sensor);
        }
        for (const std::string& link : links) of_link(link);
        for (const double by : {0.05, 0.3, 1.0}) add({.kind = sim::ChaosKind::Slow, .by = by});
    }

    std::vector<sim::ChaosFault> all;

private:
    void add(sim::ChaosFault fault) {
        fault.from = kFaultBegins;
        if (!sim::is_instant(fault.kind)) fault.until = kFaultEnds;
        all.push_back(fault);
    }
    void of_link(const std::string& link) {
        for (const double chance : {0.3, 0.8, 1.0}) {
            add({.kind = sim::ChaosKind::Lost, .where = link, .chance = chance});
        }
        add({.kind = sim::ChaosKind::Doubled, .where = link});
        for (const double by : {0.05, 0.4, 2.0}) {
            add({.kind = sim::ChaosKind::Delayed, .where = link, .by = by});
            add({.kind = sim::ChaosKind::Reordered, .where = link, .by = by});
        }
    }
    void of_sensor(const std::string& node, const std::string& sensor) {
        for (const auto kind : {sim::ChaosKind::Stuck, sim::ChaosKind::Dead}) {
            add({.kind = kind, .where = node, .sensor = sensor});
        }
        for (const double by : {30.0, 1000.0}) {
            add({.kind = sim::ChaosKind::Noisy, .where = node, .sensor = sensor, .by = by});
        }
    }
};

void expect_safe_stops(const Sample& sample, size_t kinds) {
    std::set<sim::ChaosKind> tried;
    for (const sim::ChaosFault& fault : Faults(sample).all) {
        SCOPED_TRACE(sim::format_chaos({fault}));
        const Came came = run(sample, {fault});
        EXPECT_EQ(came.wrong, "");
        ASSERT_FALSE(came.told.empty()) << "the fault was not there";
        EXPECT_EQ(came.told[0], sim::began_sentence(fault));
        tried.insert(fault.kind);
    }
    EXPECT_EQ(tried.size(), kinds);
}

// The test can fail: a Carbot that waits for a second does not brake in time.
TEST(SafeStop, AScriptWithMorePatienceIsFound) {
    const test::Folder folder;
    std::string script = read_file(test::examples("carbot/carbot.aesl")).value();
    const std::string patience = "const PATIENCE = 15 ";
    script.replace(script.find(patience), patience.size(), "const PATIENCE = 50 ");
    std::string world = read_file(kCarbot.world).value();
    const std::string path = "../carbot/carbot.aesl";
    world.replace(world.find(path), path.size(), "carbot.aesl");
    folder.write("carbot.aesl", script);
    folder.write("hall.world.json", world);
    const Sample slow = {kCarbot.plan, folder / "hall.world.json", 1};
    const sim::ChaosFault lost{
        .kind = sim::ChaosKind::Lost, .where = "main", .from = kFaultBegins, .until = kFaultEnds};
    EXPECT_EQ(run(slow, {}).wrong, "");
    EXPECT_TRUE(run(slow, {lost}).wrong.starts_with("does not brake"));
}

// The robots drive by signs of life.
TEST(SafeStop, TheSamplesDriveBySignsOfLife) {
    for (const Sample& sample : {kCarbot, kThymio}) {
        SCOPED_TRACE(sample.plan);
        const Came came = run(sample, {});
        EXPECT_EQ(came.wrong, "");
        EXPECT_GT(came.fastest, 0.1);
        EXPECT_GT(came.signs, 20);
    }
}

TEST(SafeStop, CarbotStopsUnderEverySingleFault) {
    expect_safe_stops(kCarbot, sim::chaos_kinds().size());
}

TEST(SafeStop, AThymioThatAsksForSignsOfLifeStopsUnderEverySingleFault) {
    expect_safe_stops(kThymio, sim::chaos_kinds().size());
}

}  // namespace
}  // namespace vagus
