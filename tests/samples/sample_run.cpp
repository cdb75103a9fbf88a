#include "sample_run.hpp"

#include <memory>
#include <set>
#include <type_traits>
#include <variant>

#include "base/file.hpp"
#include "base/trig.hpp"
#include "clearance.hpp"
#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "plan/test_files.hpp"
#include "run/virtual_time.hpp"
#include "session/plan_world.hpp"
#include "toolbox/builtin.hpp"

namespace vagus::samples {

namespace {

constexpr int kPosesTried = 10'000;

// Looks at the robot while the plan runs.
class Watcher {
public:
    Watcher(session::SimSession& session, bool traced) : session_(session), traced_(traced) {}

    void hear(const plan::TraceEvent& event) {
        if (traced_) ran_.trace += session_.take_trace() + plan::format_trace(event) + "\n";
        if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
            actor_ = *names_.emplace(started->actor).first;
        } else if (const auto* ended = std::get_if<plan::ActorEnded>(&event.what)) {
            ran_.states.push_back(std::string(ended->actor) + ": " + std::string(ended->state));
        } else if (const auto* raised = std::get_if<plan::EventRaised>(&event.what)) {
            ran_.states.push_back(std::string(actor_) + "! " + std::string(raised->event));
        }
    }

    // The moment, at the instants at which there is one.
    const Moment* look(Time now) {
        if (now % kLookEvery != Duration::zero()) return nullptr;
        const std::vector<sim::RobotView> robots = session_.world().robots();
        const sim::RobotView& robot = robots.front();
        const double gap = clearance(session_.world(), robot, robot.pose);
        Moment moment{now, robot.pose, gap, actor_};
        for (size_t i = 1; i < robots.size(); ++i) moment.others.push_back(robots[i].pose);
        ran_.way.push_back(std::move(moment));
        note_contact(ran_.way.back());
        return &ran_.way.back();
    }

    Ran take(run::Ended ended, bool called_off) {
        ran_.ended = std::move(ended);
        ran_.called_off = called_off;
        ran_.names = std::move(names_);
        return std::move(ran_);
    }

private:
    void note_contact(const Moment& now) {
        const bool touches = now.gap < kTouchingMetres;
        if (touches && !touched_) ran_.contacts.push_back({now.at, {}});
        if (touches) ran_.contacts.back().length = now.at - ran_.contacts.back().from;
        touched_ = touches;
    }

    session::SimSession& session_;
    bool traced_;
    bool touched_ = false;
    std::set<std::string, std::less<>> names_;  // of actors, for the moments
    std::string_view actor_;
    Ran ran_;
};

Result<plan::Graph> graph_of(const std::string& path, const run::CodeLibrary& library) {
    const plan::Checked checked = plan::check(path, plan::Disk(), library.templates());
    if (checked.ok()) return plan::make_graph(checked);
    return Error{Code::BadInput, plan::format_findings_json(checked.findings)};
}

Result<std::pair<int, plan::Value>> slot_of(const plan::Graph& graph, const std::string& name,
                                            const plan::Value& value) {
    const auto& variables = graph.plans.front().variables;
    for (size_t slot = 0; slot < variables.size(); ++slot) {
        if (variables[slot].name == name) return std::pair{static_cast<int>(slot), value};
    }
    return Error{Code::NotFound, "the plan has no variable \"" + name + "\"; look at its names"};
}

}  // namespace

Result<Ran> run_sample(const Start& start, const std::function<bool(const Moment&)>& look) {
    toolbox::BusNodes nodes;
    toolbox::Parts parts;
    parts.bus = &nodes;
    run::CodeLibrary library;
    toolbox::add_builtin(library, parts);
    const plan::Graph graph = TRY(graph_of(start.plan, library));
    const auto beside = TRY(session::PlanWorld::open(
        {.path = start.world, .seed = start.seed, .traced = start.traced}, nodes));
    sim::World& world = beside->session().world();
    parts.camera = beside->camera();
    if (start.at) TRY(world.move(world.robots().front().id, *start.at));

    Watcher watcher(beside->session(), start.traced);
    run::RunOptions options;
    options.seed = start.seed;
    options.max_time = start.at_most;
    for (const auto& [name, value] : start.set) {
        options.set.push_back(TRY(slot_of(graph, name, value)));
    }
    options.on_trace = [&watcher](const plan::TraceEvent& event) { watcher.hear(event); };
    beside->join(options);
    run::VirtualTime run(graph, library, options);
    bool called_off = false;
    beside->before_each([&](Time now) {
        const Moment* moment = watcher.look(now);
        if (!moment || !look || look(*moment)) return;
        called_off = true;
        run.abort();
    });
    run::Ended ended = run.run();
    return watcher.take(std::move(ended), called_off);
}

Result<sim::Pose> free_pose(const std::string& file, double clear, SplitMix64& random) {
    const std::string text = TRY(read_file(file));
    const sim::World world = TRY(sim::World::load(text, file));
    const sim::WorldDefinition& size = world.definition();
    for (int i = 0; i < kPosesTried; ++i) {
        const double x = size.width * random.unit();
        const double y = size.height * random.unit();
        const sim::Pose pose{{x, y}, (2 * random.unit() - 1) * trig::kPi};
        if (clearance(world, world.robots().front(), pose) >= clear) return pose;
    }
    return Error{Code::NotFound, file + " has no free place for its robot; make it emptier"};
}

}  // namespace vagus::samples
