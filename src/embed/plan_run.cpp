#include "embed/plan_run.hpp"

#include <fmt/format.h>

#include <cassert>
#include <mutex>

#include "base/text.hpp"
#include "run/real_time.hpp"
#include "run/virtual_time.hpp"

namespace vagus::embed {

namespace {

// The outermost plan's variable that a plan inside means, where each plan on the way shares it
// (P5); -1 if it is another. `path` is an instance path: "Main/calibrate".
int outermost_slot(const plan::Graph& graph, std::string_view path, std::string_view variable) {
    const plan::GraphPlan* plan = &graph.plans.front();
    const std::vector<std::string_view> names = split(path, '/');
    const auto slot_in = [variable](const plan::GraphPlan& in) {
        for (size_t slot = 0; slot < in.variables.size(); ++slot) {
            if (in.variables[slot].name == variable) return static_cast<int>(slot);
        }
        return -1;
    };
    for (size_t level = 1; level < names.size(); ++level) {
        for (const plan::GraphActor& actor : plan->actors) {
            if (actor.name != names[level] || actor.sub_plan < 0) continue;
            plan = &graph.plans[static_cast<size_t>(actor.sub_plan)];
            break;
        }
        const int slot = slot_in(*plan);
        if (slot < 0 || !plan->variables[static_cast<size_t>(slot)].shared) return -1;
    }
    return slot_in(graph.plans.front());
}

}  // namespace

class PlanRun::Run {
public:
    Run(const LoadedPlan& plan, const RunSettings& settings) : plan_(plan), clock_(settings.clock) {
        assert(plan.ok());
        options_.seed = settings.seed;
        options_.max_time = settings.max_time;
        options_.on_trace = [this](const plan::TraceEvent& event) { see(event); };
        for (const auto& variable : outermost().variables) values_.push_back(variable.initial);
    }

    void listen(std::function<void(const plan::TraceEvent&)> listener) {
        listeners_.push_back(std::move(listener));
    }
    void listen_to_bus(std::function<void(const run::BusEvent&)> listener) {
        options_.on_emit = std::move(listener);
    }

    run::Ended run() {
        assert(!started_);
        started_ = true;
        if (clock_ == Clock::Virtual) {
            run::VirtualTime run(plan_.graph(), plan_.library(), options_);
            return run_as(virtual_, run);
        }
        run::RealTime run(plan_.graph(), plan_.library(), options_);
        return run_as(real_, run);
    }

    Result<plan::Value> read(std::string_view variable) const {
        const size_t slot = TRY(find(variable));
        const std::lock_guard guard(mutex_);
        return values_[slot];
    }

    Status write(std::string_view variable, const plan::Value& value) {
        const size_t slot = TRY(find(variable));
        Result<plan::Value> fit = plan::convert(value, outermost().variables[slot].type);
        if (!fit.ok()) {
            return Error{Code::BadInput, fmt::format("the variable \"{}\" of the plan {}: {}",
                                                     variable, outermost().name, fit.error().what)};
        }
        const std::lock_guard guard(mutex_);
        const int index = static_cast<int>(slot);
        if (real_) {
            real_->set(index, std::move(fit.value()));
        } else if (virtual_) {
            virtual_->set(index, std::move(fit.value()));
        } else if (over_) {
            return Error{
                Code::Refused,
                fmt::format("the variable \"{}\" cannot be written: the run of the plan {} "
                            "is over; make a new PlanRun",
                            variable, outermost().name)};
        } else {
            values_[slot] = fit.value();
            options_.set.emplace_back(index, std::move(fit.value()));
        }
        return Status::done();
    }

    void abort() {
        const std::lock_guard guard(mutex_);
        if (real_) real_->abort();
        if (virtual_) virtual_->abort();
    }

    Status hear(run::BusEvent event) {
        const std::lock_guard guard(mutex_);
        if (!real_) {
            return Error{Code::Refused,
                         fmt::format("the event {} cannot be heard: a run hears events from "
                                     "outside while it runs in real time",
                                     event.name)};
        }
        real_->hear(std::move(event));
        return Status::done();
    }

private:
    const plan::GraphPlan& outermost() const { return plan_.graph().plans.front(); }

    Result<size_t> find(std::string_view variable) const {
        const int slot = outermost_slot(plan_.graph(), outermost().name, variable);
        if (slot >= 0) return static_cast<size_t>(slot);
        return Error{Code::NotFound,
                     fmt::format("the plan {} has no variable \"{}\"", outermost().name, variable)};
    }

    // While it runs, other threads find it through `door`.
    template <typename Executor>
    run::Ended run_as(Executor*& door, Executor& executor) {
        open(door, &executor);
        const run::Ended ended = executor.run();
        open(door, static_cast<Executor*>(nullptr));
        close();
        return ended;
    }
    template <typename Executor>
    void open(Executor*& door, Executor* executor) {
        const std::lock_guard guard(mutex_);
        door = executor;
    }

    void close() {
        const std::lock_guard guard(mutex_);
        over_ = true;
    }

    void see(const plan::TraceEvent& event) {
        if (const auto* written = std::get_if<plan::VariableWritten>(&event.what)) {
            const int slot = outermost_slot(plan_.graph(), event.plan, written->variable);
            const std::lock_guard guard(mutex_);
            if (slot >= 0) values_[static_cast<size_t>(slot)] = written->value;
        }
        for (const auto& listener : listeners_) listener(event);
    }

    LoadedPlan plan_;
    Clock clock_;
    run::RunOptions options_;
    std::vector<std::function<void(const plan::TraceEvent&)>> listeners_;
    bool started_ = false;
    mutable std::mutex mutex_;         // guards what follows
    std::vector<plan::Value> values_;  // of the outermost plan's variables, by slot
    run::RealTime* real_ = nullptr;    // while it runs
    run::VirtualTime* virtual_ = nullptr;
    bool over_ = false;
};

PlanRun::PlanRun(const LoadedPlan& plan, const RunSettings& settings)
    : run_(std::make_unique<Run>(plan, settings)) {}

PlanRun::~PlanRun() = default;

void PlanRun::listen(std::function<void(const plan::TraceEvent&)> listener) {
    run_->listen(std::move(listener));
}

void PlanRun::listen_to_bus(std::function<void(const run::BusEvent&)> listener) {
    run_->listen_to_bus(std::move(listener));
}

run::Ended PlanRun::run() {
    return run_->run();
}

Result<plan::Value> PlanRun::read(std::string_view variable) const {
    return run_->read(variable);
}

Status PlanRun::write(std::string_view variable, const plan::Value& value) {
    return run_->write(variable, value);
}

void PlanRun::abort() {
    run_->abort();
}

Status PlanRun::hear(run::BusEvent event) {
    return run_->hear(std::move(event));
}

// ---- a plan as a function ----

namespace {

Status check_inputs(const LoadedPlan& plan, const std::map<std::string, plan::Value>& inputs) {
    const std::string& name = plan.graph().plans.front().name;
    for (const auto& [input, value] : inputs) {
        bool known = false;
        for (const Parameter& one : plan.parameters()) known |= one.input && one.name == input;
        if (!known) {
            return Error{Code::NotFound, fmt::format("the plan {} has no input \"{}\"; inputs are "
                                                     "variables with the access in or inout",
                                                     name, input)};
        }
    }
    for (const Parameter& one : plan.parameters()) {
        if (!one.input || one.has_default || inputs.contains(one.name)) continue;
        return Error{Code::BadInput,
                     fmt::format("the input \"{}\" of the plan {} has no initial value and none "
                                 "was given; give one",
                                 one.name, name)};
    }
    return Status::done();
}

}  // namespace

Result<Called> call(const LoadedPlan& plan, const std::map<std::string, plan::Value>& inputs,
                    const RunSettings& settings) {
    const Status fit = check_inputs(plan, inputs);
    if (!fit.ok()) return fit.error();
    PlanRun run(plan, settings);
    for (const Parameter& one : plan.parameters()) {
        const auto given = inputs.find(one.name);
        if (given == inputs.end()) continue;
        const Status written = run.write(one.name, given->second);
        if (!written.ok()) return written.error();
    }
    Called called;
    called.ended = run.run();
    for (const Parameter& one : plan.parameters()) {
        if (one.output) called.outputs.emplace(one.name, run.read(one.name).value());
    }
    return called;
}

}  // namespace vagus::embed
