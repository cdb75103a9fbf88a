#include "embed/plan_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>

namespace vagus::embed {

namespace {

vagus::Place line_of(std::source_location at) {
    return {static_cast<int>(at.line()), 0};
}

template <typename Model>
void feed_model(Model& model, std::string_view input, const std::string& formula) {
    if (formula.empty()) return;
    plan::Entry entry{.name = std::string(input),
                      .line = model.line,
                      .text = formula,
                      .formula = {},
                      .error = {}};
    Result<plan::Formula> parsed = plan::parse_formula(formula);
    if (parsed.ok()) {
        entry.formula = std::move(parsed.value());
    } else {
        entry.error = parsed.error().what;
    }
    model.in.push_back(std::move(entry));
}

template <typename Model>
void write_model(Model& model, std::string_view output, const std::string& variable) {
    if (!variable.empty()) model.out.push_back({std::string(output), model.line, variable});
}

// Outputs that the list does not name stay where they are, behind those that it names.
void sort_outputs(std::vector<plan::Output>& outputs, std::vector<std::string_view> order) {
    std::stable_sort(outputs.begin(), outputs.end(),
                     [&order](const plan::Output& a, const plan::Output& b) {
                         return std::find(order.begin(), order.end(), a.name) <
                                std::find(order.begin(), order.end(), b.name);
                     });
}

}  // namespace

// ---- the objects ----

ActorObject::ActorObject(std::string name, std::string_view template_name,
                         std::source_location at) {
    model_.name = std::move(name);
    model_.line = model_.template_line = line_of(at);
    model_.template_name = template_name;
}

SubPlanObject::SubPlanObject(std::string name, MakePlan make, std::source_location at)
    : ActorObject(std::move(name), "", at) {
    model_.template_name.reset();
    model_.plan_line = model_.line;
    sub_plan_ = make;
}

SupervisorObject::SupervisorObject(std::string name, std::string_view template_name,
                                   std::source_location at) {
    model_.name = std::move(name);
    model_.line = model_.template_line = line_of(at);
    model_.template_name = template_name;
}

void ActorObject::feed(std::string_view input, const std::string& formula) {
    feed_model(model_, input, formula);
}

void SupervisorObject::feed(std::string_view input, const std::string& formula) {
    feed_model(model_, input, formula);
}

void ActorObject::write(std::string_view output, const std::string& variable) {
    write_model(model_, output, variable);
}

void SupervisorObject::write(std::string_view output, const std::string& variable) {
    write_model(model_, output, variable);
}

void ActorObject::writes_in_order(std::initializer_list<std::string_view> outputs) {
    sort_outputs(model_.out, outputs);
}

void SupervisorObject::writes_in_order(std::initializer_list<std::string_view> outputs) {
    sort_outputs(model_.out, outputs);
}

void SupervisorObject::period_ms(int64_t period, std::source_location at) {
    model_.period_ms = plan::Value(period);
    model_.period_line = line_of(at);
}

// ---- the plan ----

Plan::Plan(std::string name, const std::vector<std::string>& toolboxes, Place at) {
    model_.file = std::filesystem::path(at.file_name()).filename().string();
    model_.name = std::move(name);
    for (const std::string& toolbox : toolboxes) {
        model_.toolboxes.push_back({toolbox, line_of(at)});
    }
    check_name(model_.name, "plan", line_of(at));
}

void Plan::complain(std::string_view rule, std::string_view element, vagus::Place line,
                    std::string message) {
    findings_.push_back({plan::Severity::Error, std::string(rule), model_.file, model_.name,
                         std::string(element), line.line, std::move(message), line.column});
}

void Plan::check_name(const std::string& name, std::string_view what, vagus::Place line) {
    if (what == "variable" ? plan::is_variable_name(name) : plan::is_name(name)) return;
    complain("P1", what == "plan" ? "" : name, line,
             fmt::format("\"{}\" cannot be the name of a {}: use letters, digits and _, not "
                         "beginning with a digit{}",
                         name, what, what == "variable" ? plan::kNotReserved : ""));
}

void Plan::variable(std::string name, Type type, const VariableOptions& options, Place at) {
    const vagus::Place line = line_of(at);
    check_name(name, "variable", line);
    if (plan::find_variable(model_, name) >= 0) {
        complain("P1", name, line,
                 fmt::format("there is a variable named \"{}\" already; give this one another name",
                             name));
        return;
    }
    plan::Variable variable;
    variable.name = std::move(name);
    variable.line = variable.type_line = variable.access_line = variable.initial_line = line;
    variable.type = type;
    variable.type_word = plan::name_of(type);
    if (options.initial) variable.initial = options.initial->value();
    variable.access = options.access;
    variable.unit = options.unit;
    variable.help = options.help;
    model_.configuration.push_back(std::move(variable));
}

void Plan::start_with(const ActorObject& actor, Place at) {
    model_.start_line = model_.start_actor_line = line_of(at);
    model_.start_actor = model_.actors[index_of(actor)].name;
}

// Of the actor in the plan, which it enters with this if it has not before.
size_t Plan::index_of(const ActorObject& actor) {
    const auto known = std::find(actors_.begin(), actors_.end(), &actor);
    if (known != actors_.end()) return static_cast<size_t>(known - actors_.begin());
    const plan::Actor& model = actor.model_;
    check_name(model.name, "actor", model.line);
    const bool doubled = plan::find_actor(model_, model.name) >= 0;
    if (doubled) {
        complain("P1", model.name, model.line,
                 fmt::format("there is an actor named \"{}\" already; give this one another name",
                             model.name));
    }
    actors_.push_back(&actor);
    sub_plans_.push_back(actor.sub_plan_);
    model_.actors.push_back(model);
    model_.actors.back().doubled = doubled;
    return actors_.size() - 1;
}

std::string Plan::word_of(Target target) {
    if (!target.actor_) return std::string(target.word_);
    return model_.actors[index_of(*target.actor_)].name;
}

void Plan::add_rule(std::vector<plan::Rule>& rules, plan::Rule rule, const std::string& element) {
    for (const plan::Rule& other : rules) {
        if (other.name != rule.name) continue;
        complain("P17", element, rule.line,
                 fmt::format("\"{}\" of {} leads to {} already; keep one of the two", rule.name,
                             element, other.target));
        return;
    }
    rules.push_back(std::move(rule));
}

void Plan::add_state(const ActorObject& actor, std::string_view state, Target target, Place at) {
    const size_t index = index_of(actor);
    plan::Rule rule{std::string(state), line_of(at), word_of(target)};
    plan::Actor& model = model_.actors[index];
    add_rule(model.states, std::move(rule), model.name);
}

void Plan::add_event(size_t owner, const SupervisorObject& supervisor, std::string_view event,
                     Target target, Place at) {
    if (owner == kGlobal && model_.start_line.line == 0) model_.start_line = line_of(at);
    plan::Rule rule{std::string(event), line_of(at), word_of(target)};
    plan::Supervisor& model = supervisor_in(owner, supervisor);
    add_rule(model.events, std::move(rule), model.name);
}

// As attached there; attaches it, if it is not yet.
plan::Supervisor& Plan::supervisor_in(size_t owner, const SupervisorObject& supervisor) {
    const plan::Supervisor& model = supervisor.model_;
    auto& list = owner == kGlobal ? model_.globals : model_.actors[owner].supervisors;
    for (plan::Supervisor& other : list) {
        if (other.name == model.name && supervisors_.at({owner, other.name}) == &supervisor) {
            return other;
        }
    }
    check_name(model.name, "supervisor", model.line);
    bool doubled = false;
    for (const auto& [place, object] : supervisors_) {
        if (place.second != model.name || doubled) continue;
        doubled = true;
        complain("P1", model.name, model.line,
                 fmt::format("there is a supervisor named \"{}\" already; make one object, with a "
                             "name of its own, for each place",
                             model.name));
    }
    supervisors_[{owner, model.name}] = &supervisor;
    list.push_back(model);
    list.back().doubled = doubled;
    return list.back();
}

// ---- the plan with its sub-plans ----

class Assembler {
public:
    Assembly assemble(MakePlan make) {
        path_of(make);
        for (size_t i = 0; i < made_.size(); ++i) {
            for (size_t actor = 0; actor < made_[i].sub_plans_.size(); ++actor) {
                const MakePlan sub = made_[i].sub_plans_[actor];
                if (!sub) continue;
                const std::string path = path_of(sub);  // made_ may grow
                made_[i].model_.actors[actor].plan = path;
            }
        }
        Assembly assembly;
        for (Plan& plan : made_) {
            assembly.plans.push_back(std::move(plan.model_));
            assembly.findings.insert(assembly.findings.end(), plan.findings_.begin(),
                                     plan.findings_.end());
        }
        return assembly;
    }

private:
    // What findings call the plan's file: that of its code, told apart where two have the same.
    std::string path_of(MakePlan make) {
        for (size_t i = 0; i < makers_.size(); ++i) {
            if (makers_[i] == make) return made_[i].model_.file;
        }
        Plan plan = make();
        const std::string file = plan.model_.file;
        for (int number = 2; is_taken(plan.model_.file); ++number) {
            plan.model_.file = fmt::format("{}({})", file, number);
        }
        for (plan::Finding& finding : plan.findings_) finding.file = plan.model_.file;
        makers_.push_back(make);
        made_.push_back(std::move(plan));
        return made_.back().model_.file;
    }

    bool is_taken(const std::string& file) const {
        return std::any_of(made_.begin(), made_.end(),
                           [&file](const Plan& plan) { return plan.model_.file == file; });
    }

    std::vector<MakePlan> makers_;
    std::vector<Plan> made_;  // of each maker
};

Assembly assemble(MakePlan make) {
    return Assembler().assemble(make);
}

}  // namespace vagus::embed
