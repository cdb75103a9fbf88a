#include "plan/graph.hpp"

#include <cassert>

#include "plan/interface.hpp"

namespace vagus::plan {

namespace {

class GraphMaker {
public:
    explicit GraphMaker(const Checked& checked) : checked_(checked) {}

    GraphPlan make(const Plan& plan) {
        plan_ = &plan;
        slots_.clear();
        GraphPlan made{
            .name = plan.name, .file = plan.file, .variables = {}, .globals = {}, .actors = {}};
        for (const Variable& variable : plan.configuration) {
            slots_.emplace(variable.name, static_cast<int>(slots_.size()));
            made.variables.push_back(
                {variable.name, *variable.type, initial_of(variable), *variable.access});
        }
        for (size_t i = 0; i < plan.actors.size(); ++i) {
            actors_.emplace(plan.actors[i].name, static_cast<int>(i));
        }
        made.start = actors_.at(*plan.start_actor);
        for (const Supervisor& supervisor : plan.globals) made.globals.push_back(make(supervisor));
        for (const Actor& actor : plan.actors) made.actors.push_back(make(actor));
        return made;
    }

private:
    GraphSupervisor make(const Supervisor& supervisor) {
        GraphSupervisor made;
        made.name = supervisor.name;
        made.of = find_template(*plan_, *checked_.library, *supervisor.template_name, true);
        made.period_us = made.of->period_ms * 1000;
        if (supervisor.period_ms) made.period_us = supervisor.period_ms->integer() * 1000;
        const Interface face = interface_of(*made.of);
        made.inputs = make_inputs(supervisor.in, face);
        made.outputs = make_outputs(supervisor.out, face);
        made.targets = make_targets(supervisor.events, face);
        return made;
    }

    GraphActor make(const Actor& actor) {
        GraphActor made;
        made.name = actor.name;
        const Plan* sub = checked_.sub_plan(*plan_, actor);
        if (!sub) {
            made.of = find_template(*plan_, *checked_.library, *actor.template_name, false);
        }
        const Interface face = sub ? interface_of(*sub) : interface_of(*made.of);
        made.inputs = make_inputs(actor.in, face);
        made.outputs = make_outputs(actor.out, face);
        made.targets = make_targets(actor.states, face);
        for (const Outcome& outcome : face.outcomes) made.states.push_back(outcome.name);
        if (sub) bind_sub_plan(made, *sub);
        for (const Supervisor& supervisor : actor.supervisors) {
            made.supervisors.push_back(make(supervisor));
        }
        return made;
    }

    void bind_sub_plan(GraphActor& actor, const Plan& sub) {
        actor.sub_plan = static_cast<int>(&sub - checked_.plans.data());
        actor.sub_plan_file = sub.file;
        for (size_t i = 0; i < sub.configuration.size(); ++i) {
            const Variable& variable = sub.configuration[i];
            const int slot = static_cast<int>(i);
            if (is_output(*variable.access)) actor.inner_outputs.push_back(variable.name);
            if (variable.access == Access::Shared) {
                actor.shared.emplace_back(slot, slots_.at(variable.name));
            }
        }
    }

    std::vector<GraphInput> make_inputs(const std::vector<Entry>& entries, const Interface& face) {
        std::vector<GraphInput> made;
        for (const Input& input : face.inputs) {
            GraphInput one{.name = input.name,
                           .type = input.type,
                           .formula = {},
                           .slots = {},
                           .value = input.fallback.value_or(Value())};
            for (const Entry& entry : entries) {
                if (entry.name == input.name) feed(one, *entry.formula);
            }
            made.push_back(std::move(one));
        }
        return made;
    }

    void feed(GraphInput& input, const Formula& formula) {
        input.fed = true;
        if (formula.names().empty()) {
            const Value value = formula.evaluate({}).value();
            input.value = input.type ? convert(value, *input.type).value() : value;
            return;
        }
        input.formula = formula;
        for (const std::string& name : formula.names()) input.slots.push_back(slots_.at(name));
    }

    std::vector<GraphOutput> make_outputs(const std::vector<Output>& outputs,
                                          const Interface& face) {
        std::vector<GraphOutput> made;
        for (const Output& output : outputs) {
            for (size_t i = 0; i < face.outputs.size(); ++i) {
                if (face.outputs[i].name != output.name) continue;
                made.push_back({output.name, static_cast<int>(i), slots_.at(output.variable)});
            }
        }
        return made;
    }

    std::vector<int> make_targets(const std::vector<Rule>& rules, const Interface& face) {
        std::vector<int> targets;
        for (const Outcome& outcome : face.outcomes) {
            for (const Rule& rule : rules) {
                if (rule.name == outcome.name) targets.push_back(target(rule.target));
            }
        }
        assert(targets.size() == face.outcomes.size());
        return targets;
    }

    int target(const std::string& name) const {
        if (name == kTerminate) return kTargetTerminate;
        return name == kIgnore ? kTargetIgnore : actors_.at(name);
    }

    const Checked& checked_;
    const Plan* plan_ = nullptr;
    std::map<std::string, int> slots_;
    std::map<std::string, int> actors_;
};

template <typename Named>
int index_of(const std::vector<Named>& among, std::string_view name) {
    for (size_t i = 0; i < among.size(); ++i) {
        if (among[i].name == name) return static_cast<int>(i);
    }
    return -1;
}

}  // namespace

int find_variable(const GraphPlan& plan, std::string_view name) {
    return index_of(plan.variables, name);
}

int find_actor(const GraphPlan& plan, std::string_view name) {
    return index_of(plan.actors, name);
}

int find_supervisor(const std::vector<GraphSupervisor>& among, std::string_view name) {
    return index_of(among, name);
}

Graph make_graph(const Checked& checked) {
    assert(checked.ok());
    Graph graph;
    for (const Plan& plan : checked.plans) graph.plans.push_back(GraphMaker(checked).make(plan));
    return graph;
}

}  // namespace vagus::plan
