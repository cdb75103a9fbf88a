#include "embed/plan_run.hpp"

#include <fmt/format.h>

#include <cassert>
#include <mutex>

#include "run/traced_variables.hpp"

namespace vagus::embed {

class PlanRun::Run {
public:
    Run(const LoadedPlan& plan, const RunSettings& settings)
        : plan_(plan),
          options_{.seed = settings.seed},
          variables_(plan_.graph()),
          execution_(plan_.graph(), plan_.library(), options_, settings.clock) {
        assert(plan.ok());
        // One that never comes is none: virtual time must not jump there.
        if (settings.max_time && *settings.max_time < run::kNever) {
            options_.max_time = settings.max_time;
        }
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
        {
            const std::lock_guard guard(mutex_);
            started_ = true;
        }
        const run::Ended ended = execution_.run();
        const std::lock_guard guard(mutex_);
        over_ = true;
        return ended;
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
        if (started_ && !over_) {
            execution_.set(index, std::move(fit.value()));
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
        if (started_) execution_.abort();
    }

    Status hear(run::BusEvent event) {
        const std::lock_guard guard(mutex_);
        if (!execution_.real_time() || !started_ || over_) {
            return Error{Code::Refused,
                         fmt::format("the event {} cannot be heard: a run hears events from "
                                     "outside while it runs in real time",
                                     event.name)};
        }
        execution_.real_time()->hear(std::move(event));
        return Status::done();
    }

private:
    const plan::GraphPlan& outermost() const { return plan_.graph().plans.front(); }

    Result<size_t> find(std::string_view variable) const {
        const auto& variables = outermost().variables;
        for (size_t slot = 0; slot < variables.size(); ++slot) {
            if (variables[slot].name == variable) return slot;
        }
        return Error{Code::NotFound,
                     fmt::format("the plan {} has no variable \"{}\"", outermost().name, variable)};
    }

    void see(const plan::TraceEvent& event) {
        variables_.see(event);
        if (std::holds_alternative<plan::VariableWritten>(event.what)) {
            const run::VariablePlace place = variables_.last_write();
            const std::lock_guard guard(mutex_);
            if (place.level == 0) {
                const auto slot = static_cast<size_t>(place.slot);
                values_[slot] = variables_.value(0, place.slot);
            }
        }
        for (const auto& listener : listeners_) listener(event);
    }

    LoadedPlan plan_;
    run::RunOptions options_;
    std::vector<std::function<void(const plan::TraceEvent&)>> listeners_;
    run::TracedVariables variables_;
    run::Execution execution_;
    mutable std::mutex mutex_;         // guards what follows
    std::vector<plan::Value> values_;  // of the outermost plan's variables, by slot
    bool started_ = false;
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
