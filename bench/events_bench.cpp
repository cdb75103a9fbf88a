// Obstacle avoidance by polling, by events, and by a reflex: what each puts on the bus of a Carbot,
// and how long after a touch the wheels are told to stop. docs/events-and-polling.md explains the
// table.
//
//     build/release/bin/bench_events      the table, in simulated time: the same on every machine
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/rng.hpp"
#include "base/test_places.hpp"
#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/surroundings.hpp"
#include "run/virtual_time.hpp"
#include "session/plan_world.hpp"
#include "toolbox/builtin.hpp"
#include "toolbox/bus.hpp"
#include "wire/messages.hpp"

namespace {

using namespace vagus;
using namespace std::chrono_literals;

constexpr int kRuns = 40;
constexpr double kTopSpeed = 310;  // mm/s
constexpr Duration kGiveUp = 20s;
constexpr const char* kPolled = "polled.touch";  // in the main computer's own program

// Nodes and addresses of docs/carbot.md.
constexpr uint16_t kDrive = 1;
constexpr uint16_t kBumper = 2;
constexpr uint16_t kRange = 3;
constexpr uint16_t kTouchSectors = 34;  // 12 words, then touch.count
constexpr uint16_t kTouchWords = 13;
constexpr uint16_t kTouchCount = 46;
constexpr uint16_t kSonar = 34;  // rotator.angle, sonar.angle, sonar.distance
constexpr uint16_t kSonarWords = 3;

enum class Way { Nobody, Polling, Event, Reflex };

struct Case {
    const char* name;
    Way way;
    Duration period = {};  // of polling
};

[[noreturn]] void fail(const std::string& why) {
    std::fprintf(stderr, "bench_events: %s\n", why.c_str());
    std::exit(1);
}

template <typename T>
T must(Result<T> result) {
    if (!result.ok()) fail(result.error().what);
    return std::move(result.value());
}

// ---- files ----

class Folder {
public:
    Folder() {
        std::string name = std::filesystem::temp_directory_path() / "vagus-events-XXXXXX";
        if (::mkdtemp(name.data()) == nullptr) fail("no temporary folder can be made");
        path_ = name;
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    std::string write(const std::string& name, const std::string& text) const {
        const std::string file = path_ / name;
        const Status written = write_file(file, text);
        if (!written.ok()) fail(written.error().what);
        return file;
    }

private:
    std::filesystem::path path_;
};

// Carbot's scripts; where the reflex is not what is measured, without it.
std::string scripts(Way way) {
    std::string text = must(read_file(test::examples("carbot/carbot.aesl")));
    if (way == Way::Reflex) return text;
    const std::string reflex = "onevent touched\n\ttouch_ended = 1\n\tcall drive.brake()\n";
    const size_t at = text.find(reflex);
    if (at == std::string::npos) fail("carbot.aesl has another reflex than this program knows");
    return text.erase(at, reflex.size());
}

// A wall across the way, 2 m and a little ahead.
std::string world(double start) {
    return fmt::format(R"({{ "format": "vagus-world/1", "size": [6, 4],
        "objects": [{{ "kind": "wall", "at": [4, 2], "size": [0.1, 3], "height": 0.5 }}],
        "robots": [{{ "name": "carbot", "type": "carbot", "at": [{:.4f}, 2],
                     "script": "carbot.aesl" }}] }})",
                       start);
}

std::string plan_text(Way way) {
    std::string supervisors;
    if (way == Way::Polling) {
        supervisors = fmt::format(R"("touch": {{ "template": "OnEvent",
            "in": {{ "event": "'{}'" }}, "events": {{ "Received": "@terminate" }} }})",
                                  kPolled);
    } else if (way == Way::Event) {
        supervisors = R"("touch": { "template": "CheckTouchSensor",
            "events": { "TouchSensorPressed": "@terminate" } })";
    }
    return R"({ "format": "vagus-plan/1", "name": "Obstacle", "toolboxes": ["carbot"],
        "start": { "actor": "drive" }, "actors": { "drive": { "template": "Forward",
        "in": { "distance": 1000, "speed": 31 }, "states": { "ForwardSuccessful": "@terminate" },
        "supervisors": {)" +
           supervisors + "} } } }";
}

// ---- one run ----

// A main computer that asks the bumper and the range node for their variables again and again.
class Poller {
public:
    Poller(hub::Hub& bus, Duration period, Duration offset)
        : bus_(bus), link_(must(bus.add({.name = "poller"}))), period_(period), next_(offset) {}

    // Asks if it is time; true if the answers tell of a touch.
    bool look(Time now) {
        if (now >= next_) {
            ask(kBumper, kTouchSectors, kTouchWords);
            ask(kRange, kSonar, kSonarWords);
            next_ += period_;
        }
        bool touched = false;
        wire::Frame frame;
        while (bus_.take(link_, frame)) {
            wire::Variables told;
            if (wire::decode_message(frame, told) != wire::Error::None) continue;
            if (frame.source != kBumper || told.values.count != kTouchWords) continue;
            touched = touched || told.values.values[kTouchCount - kTouchSectors] > 0;
        }
        return touched;
    }

private:
    void ask(uint16_t node, uint16_t start, uint16_t length) {
        wire::GetVariables message{};
        message.dest = node;
        message.start = start;
        message.length = length;
        wire::Frame frame;
        if (wire::encode_message(message, wire::kHostId, frame) != wire::Error::None)
            fail("a question does not fit a frame");
        bus_.receive(link_, frame);
    }

    hub::Hub& bus_;
    hub::LinkId link_;
    Duration period_;
    Time next_;
};

struct Measured {
    std::optional<Duration> reaction;
    sim::BusLoad load;  // until the touch, or the end
};

// Between the run and its world: polls, and notes when the bumper is pressed and when the drive
// node's script brakes.
class Observer final : public run::Surroundings {
public:
    Observer(session::PlanWorld& world, std::optional<Poller> poller)
        : world_(world), poller_(std::move(poller)) {}

    Time next() const override { return world_.next(); }
    std::vector<run::BusEvent> begin() override {
        std::vector<run::BusEvent> heard = world_.begin();
        const Time now = world_.session().now();
        if (poller_ && poller_->look(now)) heard.push_back({kPolled, {}});
        note(now);
        return heard;
    }
    void emit(Time at, const run::BusEvent& event) override { world_.emit(at, event); }
    void end() override { world_.end(); }

    bool over() const { return measured_.reaction.has_value(); }
    Measured measured() const {
        Measured all = measured_;
        if (!touched_at_) all.load = *world_.session().world().bus_load();
        return all;
    }

private:
    void note(Time now) {
        const sim::World& world = world_.session().world();
        if (!touched_at_ && world.variables_of(kBumper)[kTouchCount] > 0) {
            touched_at_ = now;
            measured_.load = *world.bus_load();
        }
        if (touched_at_ && !measured_.reaction && brakes()) measured_.reaction = now - *touched_at_;
    }
    // What the script sets beside its call of drive.brake().
    bool brakes() const {
        for (const auto& [name, values] : world_.session().script_variables(kDrive)) {
            if (name == "stopping" && values.front() != -1) return true;
            if (name == "touch_ended" && values.front() == 1) return true;
        }
        return false;
    }

    session::PlanWorld& world_;
    std::optional<Poller> poller_;
    std::optional<Time> touched_at_;
    Measured measured_;
};

Measured run_once(const Case& of, uint64_t seed) {
    SplitMix64 random(seed);
    const Folder folder;
    folder.write("carbot.aesl", scripts(of.way));
    const std::string file = folder.write("w.world.json", world(1 + 0.2 * random.unit()));
    toolbox::BusNodes nodes;
    toolbox::Parts parts;
    parts.bus = &nodes;
    run::CodeLibrary library;
    toolbox::add_builtin(library, parts);
    const plan::OneText plan(plan_text(of.way));
    const plan::Checked checked = plan::check("p.plan.json", plan, library.templates());
    if (!checked.ok()) fail(plan::format_findings_json(checked.findings));
    const plan::Graph graph = plan::make_graph(checked);
    const auto beside = must(session::PlanWorld::open({.path = file, .seed = seed}, nodes));
    std::optional<Poller> poller;
    if (of.way == Way::Polling) {
        const auto offset =
            static_cast<int64_t>(random.below(static_cast<uint64_t>(of.period / 1ms)));
        poller.emplace(beside->session().world().bus(), of.period, offset * 1ms);
    }
    Observer observer(*beside, std::move(poller));
    run::RunOptions options;
    beside->join(options);
    options.surroundings = &observer;
    options.max_time = of.way == Way::Nobody ? Duration(5s) : kGiveUp;
    run::VirtualTime run(graph, library, options);
    beside->before_each([&](Time) {
        if (observer.over()) run.abort();
    });
    run.run();
    return observer.measured();
}

// ---- the table ----

double milliseconds(Duration time) {
    return static_cast<double>(time.count()) / 1000;
}

void print_case(const Case& of) {
    std::vector<Duration> reactions;
    double share = 0;
    double frames = 0;
    for (uint64_t seed = 1; seed <= kRuns; ++seed) {
        const Measured measured = run_once(of, seed);
        share += measured.load.all.share_of_all / kRuns;
        const double bits = static_cast<double>(measured.load.all.bits);
        const double seconds = bits / measured.load.all.share_of_all / 1e6;
        frames += static_cast<double>(measured.load.all.can_frames) / seconds / kRuns;
        if (measured.reaction) reactions.push_back(*measured.reaction);
    }
    std::sort(reactions.begin(), reactions.end());
    fmt::print("{:<24}{:>10.2f} %{:>14.0f}", of.name, 100 * share, frames);
    if (of.way == Way::Nobody) {
        fmt::print("{:>14}{:>12}{:>14}\n", "-", "-", "-");
        return;
    }
    if (reactions.size() != kRuns) fail(fmt::format("{}: not every touch was met", of.name));
    const double worst = milliseconds(reactions.back());
    fmt::print("{:>11.0f} ms{:>9.0f} ms{:>11.1f} mm\n", milliseconds(reactions[kRuns / 2]), worst,
               worst / 1000 * kTopSpeed);
}

}  // namespace

int main() {
    fmt::print("Carbot drives into a wall at 31 cm/s, {} times each (simulated time).\n\n", kRuns);
    fmt::print("{:<24}{:>12}{:>14}{:>14}{:>12}{:>14}\n", "who watches the bumper", "bus load",
               "CAN frames/s", "reaction", "worst", "way until");
    for (const Case& of :
         {Case{"nobody", Way::Nobody}, Case{"polling every 50 ms", Way::Polling, 50ms},
          Case{"polling every 20 ms", Way::Polling, 20ms},
          Case{"polling every 10 ms", Way::Polling, 10ms},
          Case{"polling every 2 ms", Way::Polling, 2ms}, Case{"an event to the plan", Way::Event},
          Case{"the reflex", Way::Reflex}})
        print_case(of);
    return 0;
}
