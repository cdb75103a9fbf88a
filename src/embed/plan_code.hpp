// A plan as C++ code: actors and supervisors are objects, states and events are constants of their
// classes, and each rule is one call. `vagus plan generate` writes such code; so can a person:
//
//     #include <vagus/embed/plan_code.hpp>
//     #include <vagus/templates/core.hpp>
//
//     vagus::embed::Plan make_Blink() {
//         using vagus::embed::Plan, vagus::embed::Type;
//         using vagus::templates::core::Timeout, vagus::templates::core::WaitForever;
//
//         WaitForever shine("shine");
//         Timeout enough("enough", {.seconds = "length / 2"});      // entries are formulas (P8)
//
//         Plan plan("Blink");
//         plan.variable("length", Type::Float, {.initial = 3});
//         plan.start_with(shine);
//         plan.during(shine, enough, Timeout::Timeout_, Plan::kTerminate);
//         return plan;
//     }
//
// The same checks hold as for a plan file (docs/plans.md, section 5); their findings name the line
// of the code. A sub-plan is an actor whose class is made with the function that makes its plan.
#pragma once

#include <concepts>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <source_location>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "plan/finding.hpp"
#include "plan/model.hpp"
#include "plan/template.hpp"

namespace vagus::embed {

using plan::Access;
using plan::Type;

class Plan;
// What makes one plan: the address of such a function stands for the plan.
using MakePlan = Plan (*)();

// A state of the class of actors `Of`, an event of the class of supervisors `Of`.
template <typename Of>
struct State {
    std::string_view name;
};
template <typename Of>
struct Event {
    std::string_view name;
};

// What actors of all classes have in common; the classes are in vagus/templates/. (Inheritance
// that implements no interface: it keeps what a class adds down to names.)
class ActorObject {
public:
    ActorObject(const ActorObject&) = delete;
    ActorObject& operator=(const ActorObject&) = delete;

    // Outputs are written in the order of their declaration, or in this one (P17a).
    void writes_in_order(std::initializer_list<std::string_view> outputs);

protected:
    ActorObject(std::string name, std::string_view template_name, std::source_location at);
    ~ActorObject() = default;
    // An empty formula or variable: not fed, not written.
    void feed(std::string_view input, const std::string& formula);
    void write(std::string_view output, const std::string& variable);

private:
    friend class Plan;
    friend class SubPlanObject;
    plan::Actor model_;
    MakePlan sub_plan_ = nullptr;
};

class SubPlanObject : public ActorObject {
protected:
    SubPlanObject(std::string name, MakePlan make, std::source_location at);
    ~SubPlanObject() = default;
};

class SupervisorObject {
public:
    SupervisorObject(const SupervisorObject&) = delete;
    SupervisorObject& operator=(const SupervisorObject&) = delete;

    void writes_in_order(std::initializer_list<std::string_view> outputs);
    // Time from check to check, if not that of the template (P22).
    void period_ms(int64_t period, std::source_location at = std::source_location::current());

protected:
    SupervisorObject(std::string name, std::string_view template_name, std::source_location at);
    ~SupervisorObject() = default;
    void feed(std::string_view input, const std::string& formula);
    void write(std::string_view output, const std::string& variable);

private:
    friend class Plan;
    plan::Supervisor model_;
};

// Where a state or event leads: an actor, Plan::kTerminate or Plan::kIgnore.
class Target {
public:
    explicit constexpr Target(std::string_view word) : word_(word) {}
    Target(const ActorObject& actor) : actor_(&actor) {}

private:
    friend class Plan;
    std::string_view word_;
    const ActorObject* actor_ = nullptr;
};

// The initial value of a variable.
class Constant {
public:
    Constant(bool value) : value_(value) {}
    Constant(std::integral auto value) : value_(static_cast<int64_t>(value)) {}
    Constant(double value) : value_(value) {}
    Constant(const char* value) : value_(std::string(value)) {}
    Constant(std::string value) : value_(std::move(value)) {}
    const plan::Value& value() const { return value_; }

private:
    plan::Value value_;
};

struct VariableOptions {
    std::optional<Constant> initial = {};
    Access access = Access::Local;
    std::string unit = {};
    std::string help = {};
};

class Plan {
public:
    using Place = std::source_location;
    static constexpr Target kTerminate{plan::kTerminate};
    static constexpr Target kIgnore{plan::kIgnore};

    // The toolboxes besides `core`; a template is looked for in their order.
    explicit Plan(std::string name, const std::vector<std::string>& toolboxes = {},
                  Place at = Place::current());

    void help(std::string text) { model_.help = std::move(text); }
    void variable(std::string name, Type type, const VariableOptions& options = {},
                  Place at = Place::current());

    void start_with(const ActorObject& actor, Place at = Place::current());
    // A global supervisor: whatever runs, its event leads there.
    template <typename Supervisor>
    void always(const Supervisor& supervisor, Event<Supervisor> event, Target target,
                Place at = Place::current()) {
        add_event(kGlobal, supervisor, event.name, target, at);
    }
    // When `actor` has ended in that state, go there.
    template <typename Actor>
    void after(const Actor& actor, State<Actor> state, Target target, Place at = Place::current()) {
        add_state(actor, state.name, target, at);
    }
    // While `actor` runs, `supervisor` watches; its event leads there.
    template <typename Supervisor>
    void during(const ActorObject& actor, const Supervisor& supervisor, Event<Supervisor> event,
                Target target, Place at = Place::current()) {
        add_event(index_of(actor), supervisor, event.name, target, at);
    }
    // Supervisors that raise no event at all.
    void always(const SupervisorObject& supervisor) { supervisor_in(kGlobal, supervisor); }
    void during(const ActorObject& actor, const SupervisorObject& supervisor) {
        supervisor_in(index_of(actor), supervisor);
    }
    // An actor without rules: only what watches always ends it.
    void add(const ActorObject& actor) { index_of(actor); }

private:
    friend class Assembler;
    // Instead of the index of the actor that a supervisor is attached to.
    static constexpr size_t kGlobal = SIZE_MAX;

    size_t index_of(const ActorObject& actor);
    void add_state(const ActorObject& actor, std::string_view state, Target target, Place at);
    void add_event(size_t owner, const SupervisorObject& supervisor, std::string_view event,
                   Target target, Place at);
    plan::Supervisor& supervisor_in(size_t owner, const SupervisorObject& supervisor);
    void add_rule(std::vector<plan::Rule>& rules, plan::Rule rule, const std::string& element);
    std::string word_of(Target target);
    void check_name(const std::string& name, std::string_view what, vagus::Place line);
    void complain(std::string_view rule, std::string_view element, vagus::Place line,
                  std::string message);

    plan::Plan model_;
    // Which object each actor and supervisor was; only compared, never followed.
    std::vector<const ActorObject*> actors_;
    std::map<std::pair<size_t, std::string>, const SupervisorObject*> supervisors_;
    std::vector<MakePlan> sub_plans_;  // of each actor; nullptr if it is none
    plan::Findings findings_;
};

// A plan and the sub-plans that it uses, the outermost first: what plan::check() takes.
struct Assembly {
    std::vector<plan::Plan> plans;
    plan::Findings findings;
};
Assembly assemble(MakePlan make);

}  // namespace vagus::embed
