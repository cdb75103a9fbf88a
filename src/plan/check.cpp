// The errors of section 5. One Checker looks at one plan; sub-plans are read before, each once.
#include "plan/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <functional>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "plan/file.hpp"
#include "plan/guess.hpp"
#include "plan/interface.hpp"

namespace vagus::plan {

namespace {

template <typename List>
std::vector<std::string_view> names_of(const List& list) {
    std::vector<std::string_view> names;
    for (const auto& item : list) names.push_back(item.name);
    return names;
}

struct Element {
    std::string_view name;
    Place line;
};

class Checker {
public:
    Checker(const Checked& checked, const Plan& plan, Findings& findings)
        : checked_(checked), plan_(plan), actors_(plan), findings_(findings) {}

    void check_plan() {
        check_toolboxes();
        for (const Variable& variable : plan_.configuration) check_variable(variable);
        check_start();
        for (const Supervisor& supervisor : plan_.globals) check_supervisor(supervisor);
        for (const Actor& actor : plan_.actors) {
            if (!actor.doubled) check_actor(actor);
        }
    }

private:
    void say(std::string_view rule, std::string_view element, Place line, std::string message,
             std::optional<Meant> meant = std::nullopt) {
        findings_.push_back({Severity::Error, std::string(rule), plan_.file, plan_.name,
                             std::string(element), line.line, std::move(message), line.column,
                             std::move(meant)});
    }

    // What the file should say of an element, and does not.
    void say_missing(std::string_view rule, const Element& element, Missing missing,
                     std::string message) {
        say(rule, element.name, element.line, std::move(message));
        findings_.back().missing = std::move(missing);
    }

    // ---- the plan's own parts ----

    void check_toolboxes() {
        for (const ToolboxName& toolbox : plan_.toolboxes) {
            if (checked_.library->find(toolbox.name)) continue;
            say("P2", "", toolbox.line,
                fmt::format("there is no toolbox \"{}\"{}; one of your own is given with --toolbox",
                            toolbox.name,
                            hint(toolbox.name, names_of(checked_.library->toolboxes()))),
                meant_by(toolbox.name, names_of(checked_.library->toolboxes())));
        }
    }

    void check_variable(const Variable& v) {
        static const std::vector<std::string_view> kTypes = {"bool", "int", "float", "string",
                                                             "object"};
        if (!v.access) {
            say("P5", v.name, v.access_line,
                fmt::format("the access \"{}\" is not known; write in, out, inout or shared, or "
                            "omit it for a local variable",
                            v.access_word));
        }
        if (!v.type) {
            const bool missing = v.type_line.line == 0;
            say("P7", v.name, missing ? v.line : v.type_line,
                missing ? fmt::format("the variable \"{}\" has no type; choose bool, int, float, "
                                      "string or object",
                                      v.name)
                        : fmt::format("the type \"{}\" is not known{}", v.type_word,
                                      hint(v.type_word, kTypes)),
                missing ? std::nullopt : meant_by(v.type_word, kTypes));
            return;
        }
        if (v.initial && !fits_initial(v)) {
            say("P6", v.name, v.initial_line,
                *v.type == Type::Object
                    ? std::string("a variable of type object has no initial value; delete it")
                    : fmt::format("the initial value must be a constant of the type {}, but is one "
                                  "of the type {}",
                                  name_of(*v.type), name_of(v.initial->type())));
        }
    }

    static bool fits_initial(const Variable& v) {
        if (v.initial->type() == *v.type) return true;
        return *v.type == Type::Float && v.initial->type() == Type::Int;
    }

    void check_start() {
        if (!plan_.start_actor) {
            say("P15", "", plan_.start_line.line > 0 ? plan_.start_line : Place{1, 1},
                "the plan has no start actor: draw an arrow from Start to the first actor, or name "
                "it in the file under start");
            findings_.back().missing = Missing{"start", "actor"};
        } else if (find_actor(plan_, *plan_.start_actor) < 0) {
            say("P15", "", plan_.start_actor_line,
                fmt::format("the start actor \"{}\" does not exist{}", *plan_.start_actor,
                            hint(*plan_.start_actor, names_of(plan_.actors))),
                meant_by(*plan_.start_actor, names_of(plan_.actors)));
        }
    }

    // ---- elements ----

    void check_actor(const Actor& actor) {
        const Template* found = nullptr;
        if (const auto face = interface_of_actor(actor, found)) {
            const Element element{actor.name, actor.line};
            const auto types = check_inputs(element, actor.in, face->inputs);
            check_outputs(element, actor.out, face->outputs, types);
            check_rules(element, actor.states, face->outcomes, "P17", "state");
        }
        if (found && found->kind == Kind::Computation && !actor.supervisors.empty()) {
            say("P14", actor.name, actor.line,
                fmt::format("\"{}\" is a computation ({}) and ends at once: it cannot have "
                            "supervisors; delete them",
                            actor.name, found->name));
        }
        for (const Supervisor& supervisor : actor.supervisors) check_supervisor(supervisor);
    }

    std::optional<Interface> interface_of_actor(const Actor& actor, const Template*& found) {
        if (!actor.template_name == !actor.plan) {
            say("P2", actor.name, actor.line,
                actor.plan
                    ? fmt::format("\"{}\" has both a template and a plan; keep one", actor.name)
                    : fmt::format("\"{}\" has neither a template nor a plan; add one", actor.name));
            return std::nullopt;
        }
        if (actor.plan) return interface_of_sub_plan(actor);
        found = find_template(plan_, *checked_.library, *actor.template_name, false);
        if (!found) {
            say_unknown_template(actor.name, actor.template_line, *actor.template_name, false);
            return std::nullopt;
        }
        return interface_of(*found);
    }

    std::optional<Interface> interface_of_sub_plan(const Actor& actor) {
        const std::string path = path_of_sub_plan(plan_.file, *actor.plan);
        if (!checked_.files.contains(path)) {
            const auto refused = checked_.unreadable.find(path);
            const bool outside =
                refused != checked_.unreadable.end() && refused->second.code == Code::Refused;
            say("P2", actor.name, actor.plan_line,
                outside ? refused->second.what
                        : fmt::format("the plan file \"{}\" cannot be read; the path counts from "
                                      "the folder of this file",
                                      *actor.plan));
            return std::nullopt;
        }
        const Plan* sub = checked_.sub_plan(plan_, actor);
        if (!sub) return std::nullopt;
        check_shared(actor, *sub);
        return interface_of(*sub);
    }

    void check_shared(const Actor& actor, const Plan& sub) {
        for (const Variable& shared : sub.configuration) {
            if (shared.access != Access::Shared) continue;
            const int index = find_variable(plan_, shared.name);
            if (index < 0) {
                say("P5", actor.name, actor.line,
                    fmt::format("the plan {} shares a variable \"{}\" that this plan lacks; add it "
                                "to the configuration",
                                sub.name, shared.name));
                continue;
            }
            const Variable& own = plan_.configuration[static_cast<size_t>(index)];
            if (!own.type || !shared.type || *own.type == *shared.type) continue;
            say("P5", actor.name, actor.line,
                fmt::format("the variable \"{}\" shared with the plan {} is of type {} there, but "
                            "of type {} here; make them equal",
                            shared.name, sub.name, name_of(*shared.type), name_of(*own.type)));
        }
    }

    void say_unlisted(std::string_view element, Place line, std::string_view name,
                      std::string_view toolbox) {
        say("P2", element, line,
            fmt::format("the template \"{}\" is in the toolbox {}, which this plan does not use; "
                        "add {} to the toolboxes of the plan",
                        name, toolbox, toolbox));
    }

    void say_unknown_template(std::string_view element, Place line, const std::string& name,
                              bool supervisor) {
        const std::string_view wanted = supervisor ? "supervisor" : "actor";
        if (const Template* other = find_template(plan_, *checked_.library, name, !supervisor)) {
            say("P2", element, line,
                fmt::format("the template \"{}\" is of the kind {}, where {} {} is needed", name,
                            name_of(other->kind), supervisor ? "a" : "an", wanted));
            return;
        }
        std::vector<std::string_view> known;
        for (const Toolbox& toolbox : checked_.library->toolboxes()) {
            for (const Template& one : toolbox.templates) {
                if ((one.kind == Kind::Supervisor) != supervisor) continue;
                if (one.name == name) return say_unlisted(element, line, name, toolbox.name);
                known.push_back(one.name);
            }
        }
        say("P2", element, line,
            fmt::format("there is no {} template \"{}\" in core or the listed toolboxes{}", wanted,
                        name, hint(name, known)),
            meant_by(name, known));
    }

    void check_supervisor(const Supervisor& supervisor) {
        if (supervisor.doubled) return;
        if (!supervisor.template_name) {
            say("P2", supervisor.name, supervisor.line,
                fmt::format("the supervisor \"{}\" has no template; add one", supervisor.name));
            return;
        }
        const Template* found =
            find_template(plan_, *checked_.library, *supervisor.template_name, true);
        if (!found) {
            say_unknown_template(supervisor.name, supervisor.template_line,
                                 *supervisor.template_name, true);
            return;
        }
        const Element element{supervisor.name, supervisor.line};
        check_period(supervisor, *found);
        const auto types = check_inputs(element, supervisor.in, found->inputs);
        check_outputs(element, supervisor.out, found->outputs, types);
        check_rules(element, supervisor.events, found->outcomes, "P18", "event");
    }

    void check_period(const Supervisor& supervisor, const Template& found) {
        if (!supervisor.period_ms) return;
        const Value& period = *supervisor.period_ms;
        if (found.period_ms == 0) {
            say("P22", supervisor.name, supervisor.period_line,
                fmt::format("{} waits for events itself and has no period; remove its period",
                            found.name));
        } else if (period.type() != Type::Int || period.integer() < 1 ||
                   period.integer() > kPeriodMaxMs) {
            say("P22", supervisor.name, supervisor.period_line,
                fmt::format("period_ms must be a whole number from 1 to {}, but is {}",
                            kPeriodMaxMs, text_of(period).value()));
        }
    }

    // ---- entries ----

    // Gives the type of what feeds each input; empty where that is not known.
    std::vector<std::optional<Type>> check_inputs(const Element& element,
                                                  const std::vector<Entry>& entries,
                                                  const std::vector<Input>& inputs) {
        std::vector<std::optional<Type>> types(inputs.size());
        std::vector<bool> fed(inputs.size());
        for (const Entry& entry : entries) {
            const auto at =
                std::find_if(inputs.begin(), inputs.end(),
                             [&entry](const Input& input) { return input.name == entry.name; });
            if (at == inputs.end()) {
                say("P3", element.name, entry.line,
                    fmt::format("\"{}\" has no input \"{}\"{}", element.name, entry.name,
                                hint(entry.name, names_of(inputs))),
                    key_meant_by(entry.name, names_of(inputs)));
                continue;
            }
            const auto index = static_cast<size_t>(at - inputs.begin());
            fed[index] = true;
            types[index] = check_formula(element, entry, *at);
        }
        for (size_t i = 0; i < inputs.size(); ++i) {
            if (fed[i] || inputs[i].fallback) continue;
            say_missing("P3", element, {"in", inputs[i].name},
                        fmt::format("the input \"{}\" of \"{}\" needs a value: it has no default",
                                    inputs[i].name, element.name));
        }
        return types;
    }

    std::optional<Type> check_formula(const Element& element, const Entry& entry,
                                      const Input& input) {
        if (!entry.formula) {
            say("P8", element.name, entry.line,
                fmt::format("the formula for \"{}\": {}{}", entry.name, entry.error,
                            unit_hint(entry.error, input.unit)));
            return std::nullopt;
        }
        std::vector<Type> types;
        for (const std::string& name : entry.formula->names()) {
            const int index = find_variable(plan_, name);
            if (index < 0) {
                say("P8", element.name, entry.line,
                    fmt::format("the formula for \"{}\" uses the variable \"{}\", which does not "
                                "exist{}",
                                entry.name, name, hint_of_variable(name)),
                    meant_by(name, names_of(plan_.configuration)));
                return std::nullopt;
            }
            const auto type = plan_.configuration[static_cast<size_t>(index)].type;
            if (!type) return std::nullopt;  // its declaration has its finding already
            types.push_back(*type);
        }
        return check_type(element, entry, input, types);
    }

    // What was meant may be a function or a word of the language, too.
    std::string hint_of_variable(const std::string& name) const {
        if (const FormulaFunction* function = find_function(name)) {
            return fmt::format("; the function is written {}", function->form);
        }
        auto known = names_of(plan_.configuration);
        if (nearest(name, known).empty()) {
            const auto reserved = reserved_words();
            const std::vector<std::string_view> words(reserved.begin(), reserved.end());
            const std::string word = nearest(small_letters(name), words);
            if (!word.empty()) return fmt::format("; did you mean \"{}\"?", word);
        }
        return hint(name, known);
    }

    std::optional<Type> check_type(const Element& element, const Entry& entry, const Input& input,
                                   const std::vector<Type>& types) {
        const auto type = entry.formula->type(types);
        if (!type.ok()) {
            say("P11", element.name, entry.line,
                fmt::format("the formula for \"{}\": {}", entry.name, type.error().what));
            return std::nullopt;
        }
        if (types.empty() && !check_constant(element, entry, input)) return std::nullopt;
        if (input.type && (*input.type == Type::Object) != (type.value() == Type::Object)) {
            say("P11", element.name, entry.line,
                fmt::format("the input \"{}\" is of type {}, what feeds it of type {}: an object "
                            "cannot become anything else, nor anything else an object",
                            entry.name, name_of(*input.type), name_of(type.value())));
        }
        return type.value();
    }

    // A formula without variables must have a value that fits its input, and its range.
    bool check_constant(const Element& element, const Entry& entry, const Input& input) {
        const Result<Value> value = entry.formula->evaluate({});
        if (!value.ok()) {
            say("P11", element.name, entry.line,
                fmt::format("the formula for \"{}\" has no value: {}", entry.name,
                            value.error().what));
            return false;
        }
        if (!input.type || *input.type == Type::Object) return true;
        const Result<Value> converted = convert(value.value(), *input.type);
        if (converted.ok()) return check_range(element, entry, input, converted.value());
        say("P11", element.name, entry.line,
            fmt::format("the input \"{}\" is of type {}: {}", entry.name, name_of(*input.type),
                        converted.error().what));
        return false;
    }

    bool check_range(const Element& element, const Entry& entry, const Input& input,
                     const Value& value) {
        const bool number = value.type() == Type::Int || value.type() == Type::Float;
        if (!number || is_within(input, convert(value, Type::Float).value().number())) return true;
        say("P11", element.name, entry.line,
            fmt::format("the input \"{}\" must be {}, but is {}", entry.name, range_of(input),
                        text_of(value).value()));
        return false;
    }

    void check_outputs(const Element& element, const std::vector<Output>& outputs,
                       const std::vector<OutputDeclaration>& declared,
                       const std::vector<std::optional<Type>>& input_types) {
        for (const Output& output : outputs) {
            const auto at = std::find_if(
                declared.begin(), declared.end(),
                [&output](const OutputDeclaration& one) { return one.name == output.name; });
            if (at == declared.end()) {
                say("P4", element.name, output.line,
                    fmt::format("\"{}\" has no output \"{}\"{}", element.name, output.name,
                                hint(output.name, names_of(declared))),
                    key_meant_by(output.name, names_of(declared)));
                continue;
            }
            auto type = at->type;
            if (!type && !input_types.empty()) type = input_types.front();
            check_output(element, output, type);
        }
    }

    void check_output(const Element& element, const Output& output, std::optional<Type> type) {
        const std::string& name = output.variable;
        if (!is_variable_name(name)) {
            say("P13", element.name, output.line,
                fmt::format("the output \"{}\" must name one variable, but leads to \"{}\"",
                            output.name, name));
            return;
        }
        const int index = find_variable(plan_, name);
        if (index < 0) {
            say("P4", element.name, output.line,
                fmt::format(
                    "the output \"{}\" leads to the variable \"{}\", which does not exist{}",
                    output.name, name, hint(name, names_of(plan_.configuration))),
                meant_by(name, names_of(plan_.configuration)));
            return;
        }
        const auto to = plan_.configuration[static_cast<size_t>(index)].type;
        if (!type || !to || (*type == Type::Object) == (*to == Type::Object)) return;
        say("P11", element.name, output.line,
            fmt::format("the output \"{}\" is of type {}, the variable \"{}\" of type {}: an "
                        "object cannot become anything else, nor anything else an object",
                        output.name, name_of(*type), name, name_of(*to)));
    }

    void check_rules(const Element& element, const std::vector<Rule>& rules,
                     const std::vector<Outcome>& outcomes, std::string_view number,
                     std::string_view what) {
        for (const Rule& rule : rules) {
            const auto known = names_of(outcomes);
            if (std::find(known.begin(), known.end(), rule.name) == known.end()) {
                say(number, element.name, rule.line,
                    fmt::format("\"{}\" has no {} \"{}\"{}", element.name, what, rule.name,
                                hint(rule.name, known)),
                    key_meant_by(rule.name, known));
                continue;
            }
            check_target(element, rule, number, what);
        }
        for (const Outcome& outcome : outcomes) {
            const bool has = std::any_of(rules.begin(), rules.end(), [&outcome](const Rule& rule) {
                return rule.name == outcome.name;
            });
            if (has) continue;
            const bool is_event = what == "event";
            say_missing(
                number, element, {is_event ? "events" : "states", outcome.name},
                fmt::format("the {} \"{}\" of \"{}\" leads nowhere; say what comes next: an "
                            "actor, {}or the end (@terminate)",
                            what, outcome.name, element.name,
                            is_event ? "nothing (@ignore), " : ""));
        }
    }

    void check_target(const Element& element, const Rule& rule, std::string_view number,
                      std::string_view what) {
        if (rule.target == kTerminate || actors_.find(rule.target) >= 0) return;
        if (rule.target == kIgnore) {
            if (what == "event") return;
            say(number, element.name, rule.line,
                fmt::format("the state \"{}\" cannot be ignored: it must lead to an actor or to "
                            "@terminate",
                            rule.name));
            return;
        }
        say(number, element.name, rule.line,
            fmt::format("the {} \"{}\" leads to \"{}\", which does not exist{}", what, rule.name,
                        rule.target, hint_of_target(rule.target, what == "event")),
            meant_by(rule.target, targets(what == "event")));
    }

    std::string hint_of_target(std::string_view target, bool of_event) const {
        if (plan_.actors.size() > kGuessAmongMax) return "; name an actor, or @terminate";
        return hint(target, targets(of_event));
    }

    std::vector<std::string_view> targets(bool of_event) const {
        auto known = names_of(plan_.actors);
        known.push_back(kTerminate);
        if (of_event) known.push_back(kIgnore);
        return known;
    }

    const Checked& checked_;
    const Plan& plan_;
    const ActorNames actors_;
    Findings& findings_;
};

// Reads the plan at `path` and all that it names, each file once.
void read_all(const std::string& path, const Files& files, Checked& checked,
              std::vector<Findings>& findings_of_file) {
    std::vector<std::string> open = {path};
    while (!open.empty() && checked.files.size() < kPlanFilesMax) {
        const std::string next = open.front();
        open.erase(open.begin());
        if (checked.files.contains(next)) continue;
        const Result<std::string> text = files.read(next);
        if (!text.ok()) {
            if (next != path) {  // the actor that names it has the finding
                checked.unreadable[next] = text.error();
                continue;
            }
            findings_of_file.push_back(
                {{Severity::Error, "P0", path, "", "", 1, text.error().what, 0}});
            checked.files[next] = -1;
            return;
        }
        PlanFile file = parse_plan(text.value(), next);
        findings_of_file.push_back(std::move(file.findings));
        checked.files[next] = file.readable ? static_cast<int>(checked.plans.size()) : -1;
        if (!file.readable) continue;
        for (const Actor& actor : file.plan.actors) {
            if (actor.plan && !actor.template_name && !actor.doubled) {
                open.push_back(path_of_sub_plan(next, *actor.plan));
            }
        }
        checked.plans.push_back(std::move(file.plan));
    }
}

}  // namespace

const Template* find_template(const Plan& plan, const Library& library, std::string_view name,
                              bool supervisor) {
    std::vector<std::string_view> order = {kCoreToolbox};
    for (const ToolboxName& toolbox : plan.toolboxes) order.push_back(toolbox.name);
    for (const std::string_view toolbox_name : order) {
        const Toolbox* toolbox = library.find(toolbox_name);
        if (!toolbox) continue;
        for (const Template& one : toolbox->templates) {
            if (one.name == name && (one.kind == Kind::Supervisor) == supervisor) return &one;
        }
    }
    return nullptr;
}

std::string path_of_sub_plan(const std::string& file, const std::string& named) {
    const std::filesystem::path path = std::filesystem::path(file).parent_path() / named;
    return path.lexically_normal().string();
}

const Plan* Checked::sub_plan(const Plan& plan, const Actor& actor) const {
    if (!actor.plan) return nullptr;
    const auto found = files.find(path_of_sub_plan(plan.file, *actor.plan));
    if (found == files.end() || found->second < 0) return nullptr;
    return &plans[static_cast<size_t>(found->second)];
}

namespace {

// Checks what has been read; `found` is what reading found.
void check_read(Checked& checked, std::vector<Findings> found, const std::string& first) {
    for (const auto& [file, index] : checked.files) {
        if (index < 0) continue;
        const Plan& plan = checked.plans[static_cast<size_t>(index)];
        found.emplace_back();
        Checker(checked, plan, found.back()).check_plan();
    }
    if (std::none_of(found.begin(), found.end(), has_error)) {
        for (const Plan& plan : checked.plans) {
            found.emplace_back();
            warn(checked, plan, found.back());
        }
    }
    checked.findings = sorted(found, first);
}

}  // namespace

Checked check(const std::string& path, const Files& files, const Library& library) {
    Checked checked;
    checked.library = &library;
    std::vector<Findings> found;
    const std::string first = std::filesystem::path(path).lexically_normal().string();
    read_all(first, files, checked, found);
    check_read(checked, std::move(found), first);
    return checked;
}

Checked check(std::vector<Plan> plans, Findings found, const Library& library) {
    assert(!plans.empty());
    Checked checked;
    checked.library = &library;
    checked.plans = std::move(plans);
    for (size_t i = 0; i < checked.plans.size(); ++i) {
        checked.files.emplace(checked.plans[i].file, static_cast<int>(i));
    }
    check_read(checked, {std::move(found)}, checked.plans.front().file);
    return checked;
}

}  // namespace vagus::plan
