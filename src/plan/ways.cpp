// The warnings of section 5: they follow the ways that states and events lead.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "plan/interface.hpp"

namespace vagus::plan {

namespace {

// One way out of an actor, and the variables that are written when it is taken.
struct Way {
    int to = -1;  // actor; -1: @terminate
    bool by_state = false;
    std::vector<std::string_view> writes;
};

class Warner {
public:
    Warner(const Checked& checked, const Plan& plan, Findings& findings)
        : checked_(checked),
          plan_(plan),
          actors_(plan),
          findings_(findings),
          ways_(plan.actors.size()) {
        for (size_t i = 0; i < plan.actors.size(); ++i) ways_[i] = ways_of(plan.actors[i]);
    }

    void warn_all() {
        find_reached();
        warn_of_unreached();
        warn_of_variables();
        warn_of_conversions();
        warn_of_ignored();
        warn_of_computations();
        warn_of_no_end();
    }

private:
    void say(std::string_view rule, std::string_view element, Place line, std::string message) {
        findings_.push_back({Severity::Warning, std::string(rule), plan_.file, plan_.name,
                             std::string(element), line.line, std::move(message), line.column});
    }

    // ---- ways ----

    void add_events(const Supervisor& supervisor, std::vector<Way>& ways) const {
        for (const Rule& event : supervisor.events) {
            if (event.target == kIgnore) continue;
            Way way{.to = actors_.find(event.target), .by_state = false, .writes = {}};
            for (const Output& output : supervisor.out) way.writes.push_back(output.variable);
            ways.push_back(std::move(way));
        }
    }

    std::vector<Way> ways_of(const Actor& actor) const {
        std::vector<Way> ways;
        for (const Rule& state : actor.states) {
            Way way{.to = actors_.find(state.target), .by_state = true, .writes = {}};
            const bool nothing = actor.plan && state.name == kStateError;
            for (const Output& output : actor.out) {
                if (!nothing) way.writes.push_back(output.variable);
            }
            ways.push_back(std::move(way));
        }
        for (const Supervisor& supervisor : actor.supervisors) add_events(supervisor, ways);
        for (const Supervisor& supervisor : plan_.globals) add_events(supervisor, ways);
        return ways;
    }

    void find_reached() {
        reached_.assign(plan_.actors.size(), false);
        std::vector<int> open = {find_actor(plan_, *plan_.start_actor)};
        while (!open.empty()) {
            const auto at = static_cast<size_t>(open.back());
            open.pop_back();
            if (reached_[at]) continue;
            reached_[at] = true;
            for (const Way& way : ways_[at]) {
                if (way.to >= 0) open.push_back(way.to);
            }
        }
    }

    void warn_of_unreached() {
        for (size_t i = 0; i < plan_.actors.size(); ++i) {
            const Actor& actor = plan_.actors[i];
            if (reached_[i]) continue;
            say("W1", actor.name, actor.line,
                fmt::format("\"{}\" can never be reached: no state or event on a way from the "
                            "start leads to it",
                            actor.name));
        }
    }

    // ---- variables ----

    static bool reads(const std::vector<Entry>& in, std::string_view variable) {
        return std::any_of(in.begin(), in.end(), [variable](const Entry& entry) {
            const auto& names = entry.formula->names();
            return std::find(names.begin(), names.end(), variable) != names.end();
        });
    }

    static bool writes(const std::vector<Output>& out, std::string_view variable) {
        return std::any_of(out.begin(), out.end(),
                           [variable](const Output& one) { return one.variable == variable; });
    }

    template <typename Predicate>
    bool any_supervisor(const Actor& actor, Predicate predicate) const {
        return std::any_of(actor.supervisors.begin(), actor.supervisors.end(), predicate) ||
               std::any_of(plan_.globals.begin(), plan_.globals.end(), predicate);
    }

    bool reads_at(const Actor& actor, std::string_view variable) const {
        return reads(actor.in, variable) ||
               any_supervisor(actor, [variable](const Supervisor& supervisor) {
                   return reads(supervisor.in, variable);
               });
    }

    bool writes_at(const Actor& actor, std::string_view variable) const {
        return writes(actor.out, variable) ||
               any_supervisor(actor, [variable](const Supervisor& supervisor) {
                   return writes(supervisor.out, variable);
               });
    }

    bool is_shared(const Variable& variable) const {
        if (variable.access == Access::Shared) return true;
        return std::any_of(plan_.actors.begin(), plan_.actors.end(), [&](const Actor& actor) {
            const Plan* sub = checked_.sub_plan(plan_, actor);
            if (!sub) return false;
            const int index = find_variable(*sub, variable.name);
            return index >= 0 &&
                   sub->configuration[static_cast<size_t>(index)].access == Access::Shared;
        });
    }

    void warn_of_variables() {
        for (const Variable& variable : plan_.configuration) {
            if (is_shared(variable) || warn_of_use(variable)) continue;
            const bool starts_empty =
                variable.access == Access::Local || variable.access == Access::Out;
            if (!starts_empty || variable.initial || !read_before_written(variable.name)) continue;
            say("W2", variable.name, variable.line,
                fmt::format("\"{}\" may be read before anything wrote it; give it an initial value",
                            variable.name));
        }
    }

    bool warn_of_use(const Variable& variable) {
        bool read = is_output(*variable.access);
        bool written = variable.initial.has_value() || is_input(*variable.access);
        for (const Actor& actor : plan_.actors) {
            read = read || reads_at(actor, variable.name);
            written = written || writes_at(actor, variable.name);
        }
        if (read && written) return false;
        say("W3", variable.name, variable.line,
            read ? fmt::format("\"{}\" has no initial value and nothing writes it; it stays {}",
                               variable.name,
                               *variable.type == Type::Object ? "absent" : "as it begins")
                 : fmt::format("nothing reads \"{}\"; delete it, or use it", variable.name));
        return true;
    }

    // Whether a way leads from the start to a reader without passing a writer.
    bool read_before_written(std::string_view variable) const {
        std::vector<bool> seen(plan_.actors.size());
        std::vector<int> open = {find_actor(plan_, *plan_.start_actor)};
        while (!open.empty()) {
            const auto at = static_cast<size_t>(open.back());
            open.pop_back();
            if (seen[at]) continue;
            seen[at] = true;
            if (reads_at(plan_.actors[at], variable)) return true;
            for (const Way& way : ways_[at]) {
                const auto& written = way.writes;
                const bool writes_it =
                    std::find(written.begin(), written.end(), variable) != written.end();
                if (way.to >= 0 && !writes_it) open.push_back(way.to);
            }
        }
        return false;
    }

    // ---- conversions that may fail or lose ----

    static bool is_risky(Type from, Type to) {
        const bool number = to == Type::Int || to == Type::Float || to == Type::Bool;
        return (from == Type::String && number) || (from == Type::Float && to == Type::Int);
    }

    void say_conversion(std::string_view element, Place line, std::string_view what,
                        std::string_view name, Type from, Type to) {
        say("W4", element, line,
            fmt::format(
                "the {} \"{}\" goes from {} to {}: {}", what, name, name_of(from), name_of(to),
                from == Type::String ? "a text that is no number ends the plan with an error"
                                     : "it is rounded"));
    }

    Type type_of(std::string_view variable) const {
        return *plan_.configuration[static_cast<size_t>(find_variable(plan_, variable))].type;
    }

    Type type_of(const Formula& formula) const {
        std::vector<Type> types;
        for (const std::string& name : formula.names()) types.push_back(type_of(name));
        return formula.type(types).value();
    }

    void warn_of_element(std::string_view element, const Interface& face,
                         const std::vector<Entry>& in, const std::vector<Output>& out) {
        std::optional<Type> first;
        for (const Entry& entry : in) {
            const Type type = type_of(*entry.formula);
            for (const Input& input : face.inputs) {
                if (input.name != entry.name) continue;
                if (&input == &face.inputs.front()) first = type;
                if (!input.type || entry.formula->names().empty()) continue;
                if (is_risky(type, *input.type)) {
                    say_conversion(element, entry.line, "input", entry.name, type, *input.type);
                }
            }
        }
        for (const Output& output : out) {
            for (const OutputDeclaration& one : face.outputs) {
                if (one.name != output.name) continue;
                const auto from = one.type ? one.type : first;
                const Type to = type_of(output.variable);
                if (from && is_risky(*from, to)) {
                    say_conversion(element, output.line, "output", output.name, *from, to);
                }
            }
        }
    }

    void warn_of_supervisor_conversions(const Supervisor& supervisor) {
        const Template* found =
            find_template(plan_, *checked_.library, *supervisor.template_name, true);
        warn_of_element(supervisor.name, interface_of(*found), supervisor.in, supervisor.out);
    }

    void warn_of_conversions() {
        for (const Supervisor& supervisor : plan_.globals) {
            warn_of_supervisor_conversions(supervisor);
        }
        for (const Actor& actor : plan_.actors) {
            const Plan* sub = checked_.sub_plan(plan_, actor);
            const Interface face = sub ? interface_of(*sub) : interface_of(*template_of(actor));
            warn_of_element(actor.name, face, actor.in, actor.out);
            for (const Supervisor& supervisor : actor.supervisors) {
                warn_of_supervisor_conversions(supervisor);
            }
        }
    }

    // ---- supervisors, computations, ends ----

    void warn_of_ignored(const Supervisor& supervisor) {
        const bool all = std::all_of(supervisor.events.begin(), supervisor.events.end(),
                                     [](const Rule& event) { return event.target == kIgnore; });
        if (!all) return;
        say("W5", supervisor.name, supervisor.line,
            fmt::format("every event of \"{}\" is ignored: it watches for nothing",
                        supervisor.name));
    }

    void warn_of_ignored() {
        for (const Supervisor& supervisor : plan_.globals) warn_of_ignored(supervisor);
        for (const Actor& actor : plan_.actors) {
            for (const Supervisor& supervisor : actor.supervisors) warn_of_ignored(supervisor);
        }
    }

    const Template* template_of(const Actor& actor) const {
        if (!actor.template_name) return nullptr;
        return find_template(plan_, *checked_.library, *actor.template_name, false);
    }

    bool is_computation(int actor) const {
        const Template* found = template_of(plan_.actors[static_cast<size_t>(actor)]);
        return found && found->kind == Kind::Computation;
    }

    // Actors from which some way leads to one that is marked; `states_only` follows states alone.
    std::vector<bool> leading_to(std::vector<bool> marked, bool states_only) const {
        std::vector<std::vector<size_t>> sources(ways_.size());
        std::vector<size_t> open;
        for (size_t i = 0; i < ways_.size(); ++i) {
            for (const Way& way : ways_[i]) {
                if (states_only && !way.by_state) continue;
                if (way.to < 0) marked[i] = true;
                if (way.to >= 0) sources[static_cast<size_t>(way.to)].push_back(i);
            }
            if (marked[i]) open.push_back(i);
        }
        while (!open.empty()) {
            const size_t at = open.back();
            open.pop_back();
            for (const size_t source : sources[at]) {
                if (marked[source]) continue;
                marked[source] = true;
                open.push_back(source);
            }
        }
        return marked;
    }

    void warn_of_computations() {
        std::vector<bool> takes_time(plan_.actors.size());
        for (size_t i = 0; i < takes_time.size(); ++i) {
            takes_time[i] = !is_computation(static_cast<int>(i));
        }
        const std::vector<bool> leaves = leading_to(takes_time, true);
        for (size_t i = 0; i < leaves.size(); ++i) {
            const Actor& actor = plan_.actors[i];
            if (leaves[i]) continue;
            say("W6", actor.name, actor.line,
                fmt::format("from \"{}\" only computations follow, without end: no time passes; "
                            "lead one of them to an actor or to @terminate",
                            actor.name));
        }
    }

    void warn_of_no_end() {
        const std::vector<bool> ends = leading_to(std::vector<bool>(plan_.actors.size()), false);
        for (size_t i = 0; i < ends.size(); ++i) {
            const Actor& actor = plan_.actors[i];
            if (ends[i] || !reached_[i]) continue;
            say("W7", actor.name, actor.line,
                fmt::format("no way leads from \"{}\" to @terminate: the plan can only be stopped",
                            actor.name));
        }
    }

    const Checked& checked_;
    const Plan& plan_;
    const ActorNames actors_;
    Findings& findings_;
    std::vector<std::vector<Way>> ways_;
    std::vector<bool> reached_;
};

}  // namespace

void warn(const Checked& checked, const Plan& plan, Findings& findings) {
    Warner(checked, plan, findings).warn_all();
}

}  // namespace vagus::plan
