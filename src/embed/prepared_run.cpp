#include "embed/prepared_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>

#include "base/file.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/plan_bus.hpp"
#include "embed/trace_sink.hpp"
#include "net/network.hpp"
#include "run/real_time.hpp"
#include "run/virtual_time.hpp"
#include "session/plan_world.hpp"
#include "toolbox/bus.hpp"
#include "toolbox/core_values.hpp"
#include "toolbox/needs_bus.hpp"

namespace vagus::embed {

namespace {

using namespace std::chrono_literals;

constexpr Duration kBehindMax = 200ms;  // a machine that cannot keep up slows time down instead

Error usage(std::string sentence) {
    return {Code::BadInput, std::move(sentence)};
}

Status check_words(const RunWords& words) {
    if (!words.clock.empty() && words.clock != "real" && words.clock != "virtual") {
        return usage(fmt::format("--clock {}: expected real or virtual", words.clock));
    }
    if (!words.bus.empty() && !words.world.empty()) {
        return usage("--bus and --world: a run has one bus; leave one of them out");
    }
    if (!words.bus.empty() && words.clock == "virtual") {
        return usage(
            "--bus with --clock virtual: what is on a bus lives in real time; leave "
            "--clock out, or let a --world stand for it");
    }
    if (!words.project.empty() && words.bus.empty()) {
        return usage(
            "--project goes with --bus; beside a world, names of events are those of the "
            "scripts that its robots load");
    }
    if (!words.trace_all.empty() && words.world.empty()) {
        return usage("--trace-all goes with --world; for the plan alone there is --trace");
    }
    return Status::done();
}

Status check_names(const session::BusNames& names, const Runnable& what) {
    const plan::Findings findings = names.check(what.plans);
    if (findings.empty()) return Status::done();
    std::string lines = format_findings(findings);
    lines.pop_back();  // the last newline
    return usage("the plan names events that its bus does not have\n" + lines);
}

// Time that follows the wall clock from the first call on.
class Pace {
public:
    void wait(Time at) {
        const Time now = net_.now();
        // The first instant, and one that came much too late: a pause, or too slow a machine.
        if (!origin_ || now > *origin_ + at + kBehindMax) origin_ = now - at;
        const Time due = *origin_ + at;
        while (net_.now() < due) (void)net_.poll(due);
    }

private:
    net::Network net_;
    std::optional<Duration> origin_;
};

}  // namespace

class PreparedRun::Insides {
public:
    Insides(const Runnable& its_what, RunWords its_words)
        : what(its_what), words(std::move(its_words)) {}

    Status take_options();
    Status open_world();
    Status open_bus();
    Status check_alone() const;
    void trace(const plan::TraceEvent& event);
    Result<run::Ended> run_beside_world();
    run::Ended run_in_virtual_time();
    run::Ended run_in_real_time();
    void abort();

    const Runnable what;
    const RunWords words;
    run::RunOptions how;
    std::vector<std::function<void(const plan::TraceEvent&)>> listeners;
    std::function<void(Time)> wait;
    toolbox::BusNodes nodes;
    std::unique_ptr<session::PlanWorld> world;
    bool world_used = false;
    std::unique_ptr<PlanBus> bus;
    std::unique_ptr<TraceSink> sink;
    std::unique_ptr<TraceSink> sink_all;

private:
    std::mutex mutex_;  // guards what follows
    run::VirtualTime* virtual_ = nullptr;
    run::RealTime* real_ = nullptr;
};

// ---- making it ready ----

Status PreparedRun::Insides::take_options() {
    TRY(check_words(words));
    how.seed = words.seed.value_or(1);
    for (const std::string& text : words.set) {
        how.set.push_back(TRY(parse_set(what.graph.plans.front(), text)));
    }
    if (!words.max_time.empty()) {
        how.max_time = TRY(parse_max_time(words.max_time));
    } else if (!words.world.empty()) {
        how.max_time = kWorldMaxTime;
    }
    how.on_trace = [this](const plan::TraceEvent& event) { trace(event); };
    if (!words.world.empty()) TRY(open_world());
    if (!words.bus.empty()) TRY(open_bus());
    if (!world && !bus) TRY(check_alone());
    const bool at_once = words.clock != "virtual";
    sink = TRY(TraceSink::open(words.trace, at_once));
    sink_all = TRY(TraceSink::open(words.trace_all, at_once));
    return Status::done();
}

Status PreparedRun::Insides::open_world() {
    world = TRY(session::PlanWorld::open(
        {.path = words.world, .seed = words.seed, .traced = !words.trace_all.empty()}, nodes));
    world_used = false;
    return check_names(world->names(), what);
}

Status PreparedRun::Insides::open_bus() {
    PlanBusOptions options{words.bus, {}, "", [](const std::string& sentence) {
                               std::fputs((sentence + "\n").c_str(), stderr);
                           }};
    if (!words.project.empty()) {
        const std::string text = TRY(read_file(words.project));
        options.common = TRY(aesl::parse_project(text, words.project)).common;
        options.project = words.project;
    } else if (session::uses_bus(what.plans, what.library.templates())) {
        return usage(
            "--bus without --project: the plan uses events, and only a project gives them "
            "their numbers; name the one that the nodes were loaded with, as --project "
            "arm.aesl");
    }
    bus = TRY(PlanBus::open(std::move(options), nodes));
    return check_names(bus->names(), what);
}

Status PreparedRun::Insides::check_alone() const {
    const Status alone = toolbox::check_without_bus(what.graph);
    if (alone.ok()) return alone;
    return Error{alone.error().code,
                 alone.error().what + "; give it a world (--world FILE) or a bus (--bus TARGET)"};
}

// ---- running ----

void PreparedRun::Insides::trace(const plan::TraceEvent& event) {
    if (*sink || *sink_all) {
        const std::string line = plan::format_trace(event) + "\n";
        sink->write(line);
        if (*sink_all) sink_all->write(world->session().take_trace() + line);
    }
    for (const auto& listener : listeners) listener(event);
}

Result<run::Ended> PreparedRun::Insides::run_beside_world() {
    if (world_used) TRY(open_world());
    world_used = true;
    Pace pace;
    if (wait) {
        world->before_each(wait);
    } else if (words.clock != "virtual") {
        world->before_each([&pace](Time at) { pace.wait(at); });
    }
    world->join(how);
    const run::Ended ended = run_in_virtual_time();
    sink_all->write(world->session().take_trace());
    return ended;
}

run::Ended PreparedRun::Insides::run_in_virtual_time() {
    run::VirtualTime run(what.graph, what.library, how);
    {
        const std::lock_guard lock(mutex_);
        virtual_ = &run;
    }
    const run::Ended ended = run.run();
    const std::lock_guard lock(mutex_);
    virtual_ = nullptr;
    return ended;
}

run::Ended PreparedRun::Insides::run_in_real_time() {
    if (bus) bus->join(how);
    run::RealTime run(what.graph, what.library, how);
    {
        const std::lock_guard lock(mutex_);
        real_ = &run;
    }
    if (bus) bus->start([&run](run::BusEvent event) { run.hear(std::move(event)); });
    const run::Ended ended = run.run();
    if (bus) bus->stop();
    const std::lock_guard lock(mutex_);
    real_ = nullptr;
    return ended;
}

void PreparedRun::Insides::abort() {
    const std::lock_guard lock(mutex_);
    if (virtual_) virtual_->abort();
    if (real_) real_->abort();
}

// ---- the public side ----

PreparedRun::PreparedRun(std::unique_ptr<Insides> insides) : insides_(std::move(insides)) {}
PreparedRun::~PreparedRun() = default;

Result<std::unique_ptr<PreparedRun>> PreparedRun::prepare(const Runnable& what,
                                                          const RunWords& words,
                                                          toolbox::Parts& parts) {
    auto insides = std::make_unique<Insides>(what, words);
    TRY(insides->take_options());
    if (insides->world || insides->bus) parts.bus = &insides->nodes;
    if (insides->world) parts.camera = insides->world->camera();
    // make_unique cannot reach the constructor.
    return std::unique_ptr<PreparedRun>(new PreparedRun(std::move(insides)));
}

bool PreparedRun::in_virtual_time() const {
    return insides_->words.clock == "virtual" || insides_->world;
}

session::PlanWorld* PreparedRun::world() {
    return insides_->world.get();
}

void PreparedRun::listen(std::function<void(const plan::TraceEvent&)> listener) {
    insides_->listeners.push_back(std::move(listener));
}

void PreparedRun::pace(std::function<void(Time)> wait) {
    insides_->wait = std::move(wait);
}

Result<run::Ended> PreparedRun::run(run::Debugger* debugger) {
    insides_->how.debugger = debugger;
    if (insides_->world) return insides_->run_beside_world();
    return in_virtual_time() ? insides_->run_in_virtual_time() : insides_->run_in_real_time();
}

void PreparedRun::abort() {
    insides_->abort();
}

// ---- options ----

Result<std::pair<int, plan::Value>> parse_set(const plan::GraphPlan& plan,
                                              const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos) {
        return usage(fmt::format("--set {}: expected NAME=VALUE, as --set speed=12", text));
    }
    const std::string name = text.substr(0, equals);
    for (size_t slot = 0; slot < plan.variables.size(); ++slot) {
        if (plan.variables[slot].name != name) continue;
        Result<plan::Value> value =
            plan::convert(plan::Value(text.substr(equals + 1)), plan.variables[slot].type);
        if (value.ok()) return std::pair(static_cast<int>(slot), std::move(value.value()));
        return usage(fmt::format("--set {}: {}", text, value.error().what));
    }
    return Error{Code::NotFound, fmt::format("--set {}: the plan {} has no variable \"{}\"", text,
                                             plan.name, name)};
}

Result<Duration> parse_max_time(const std::string& text) {
    const Result<double> seconds = plan::float_from_text(text);
    if (seconds.ok() && toolbox::duration_of(seconds.value()).count() > 0) {
        return toolbox::duration_of(seconds.value());
    }
    return usage(fmt::format("--max-time {}: expected seconds above 0, as --max-time 2.5", text));
}

}  // namespace vagus::embed
