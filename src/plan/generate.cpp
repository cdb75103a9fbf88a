#include "plan/generate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <functional>
#include <set>

#include "plan/cpp_text.hpp"
#include "plan/generate_classes.hpp"
#include "plan/interface.hpp"

namespace vagus::plan {

namespace {

// What C++ calls a plan: its files, the function that makes it, its class as a sub-plan.
struct PlanNames {
    std::string file;  // without .hpp
    std::string make;
    CppClass as_actor;
};

constexpr std::string_view kNamespace = "plans";

std::vector<PlanNames> name_plans(const Checked& checked) {
    // Also names of CMake's own targets: that of the first plan becomes one.
    CppNames names({"main", "Plan", "Type", "Access", "all", "clean", "edit_cache", "help",
                    "install", "package", "rebuild_cache", "test"});
    for (const Toolbox& toolbox : checked.library->toolboxes()) names.take(cpp_namespace(toolbox));
    std::vector<PlanNames> named;
    for (const Plan& plan : checked.plans) {
        const std::string name = names.give(plan.name);
        named.push_back({name, "make_" + name, cpp_class_of(plan, name)});
    }
    return named;
}

// The class of a template, and the toolbox in whose namespace it is.
struct TemplateClass {
    const Toolbox* toolbox;
    CppClass names;
    const Template* declared;
};

TemplateClass find_class(const Library& library, const Template& of) {
    for (const Toolbox& toolbox : library.toolboxes()) {
        for (size_t i = 0; i < toolbox.templates.size(); ++i) {
            if (&toolbox.templates[i] == &of) return {&toolbox, cpp_classes(toolbox)[i], &of};
        }
    }
    assert(false);
    return {};
}

// The formula as C++ passes it on. The lowest int is a number in JSON but no formula (P8a).
std::string entry_text(const Entry& entry) {
    return entry.text == "-9223372036854775808" ? "-9223372036854775807 - 1" : entry.text;
}

std::string constant_text(const Value& value) {
    switch (value.type()) {
        case Type::Bool:
            return value.boolean() ? "true" : "false";
        case Type::Int:
            if (value.integer() == INT64_MIN) return "-9223372036854775807 - 1";
            return fmt::format("{}", value.integer());
        case Type::Float: {
            const std::string text = text_of(value.number());
            return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
        }
        case Type::String:
            return cpp_string(value.string());
        case Type::Object:
            break;
    }
    assert(false);
    return "";
}

std::string_view type_text(Type type) {
    switch (type) {
        case Type::Bool:
            return "Type::Bool";
        case Type::Int:
            return "Type::Int";
        case Type::Float:
            return "Type::Float";
        case Type::String:
            return "Type::String";
        case Type::Object:
            break;
    }
    return "Type::Object";
}

std::string_view access_text(Access access) {
    switch (access) {
        case Access::Local:
            return "Access::Local";
        case Access::In:
            return "Access::In";
        case Access::Out:
            return "Access::Out";
        case Access::InOut:
            return "Access::InOut";
        case Access::Shared:
            break;
    }
    return "Access::Shared";
}

// Breaks a call behind commas of its outermost list so that lines stay below 100 columns.
std::string call(std::string_view head, const std::vector<std::string>& arguments) {
    std::string text = fmt::format("    {}(", head);
    size_t column = text.size();
    for (size_t i = 0; i < arguments.size(); ++i) {
        const std::string piece = arguments[i] + (i + 1 < arguments.size() ? "," : ");");
        if (i > 0 && column + piece.size() + 1 > 100) {
            text += "\n        ";
            column = 8;
        } else if (i > 0) {
            text += ' ';
            ++column;
        }
        text += piece;
        column += piece.size();
    }
    return text + "\n";
}

// A long text as literals of one line each, which C++ joins.
std::string in_lines(std::string_view text) {
    constexpr size_t kLine = 80;
    if (text.size() <= kLine || text.find('\0') != std::string_view::npos) return cpp_string(text);
    std::string lines;
    while (!text.empty()) {
        const size_t space = text.size() <= kLine ? std::string_view::npos : text.rfind(' ', kLine);
        const std::string_view line =
            text.substr(0, space == std::string_view::npos ? space : space + 1);
        lines += (lines.empty() ? "" : "\n              ") + cpp_string(line);
        text.remove_prefix(line.size());
    }
    return lines;
}

class CodeWriter {
public:
    CodeWriter(const Checked& checked, const Plan& plan, const std::vector<PlanNames>& names,
               const OwnToolboxes& own)
        : checked_(checked), plan_(plan), plan_names_(names), own_(own) {}

    MarkedText write() {
        for (const PlanNames& names : plan_names_) names_.take(names.as_actor.name);
        give_objects();
        MarkedText body;
        body += write_actors();
        body += write_supervisors();
        body += write_configuration();
        body += write_start();
        body += write_rules();
        const PlanNames& own = names_of(plan_);
        MarkedText text;
        text += fmt::format("// The plan {}.\n#include \"{}.hpp\"\n\n", plan_.name, own.file);
        text += write_includes();
        text += fmt::format("{}::Plan {}::{}() {{\n", "vagus::embed", kNamespace, own.make);
        text += write_usings(body.text());
        text += body;
        text += "    return plan;\n}\n";
        return text;
    }

private:
    const PlanNames& names_of(const Plan& plan) const {
        return plan_names_[static_cast<size_t>(&plan - checked_.plans.data())];
    }

    using Keys = std::vector<std::string>;

    static Keys keys_of(const Actor& actor) { return {"actors", actor.name}; }
    static Keys keys_of(const Supervisor& supervisor, const Actor* of) {
        if (!of) return {"start", "supervisors", supervisor.name};
        return {"actors", of->name, "supervisors", supervisor.name};
    }

    // ---- names ----

    void give_objects() {
        for (const Actor& actor : plan_.actors) use_class(actor);
        each_supervisor(
            [this](const Supervisor& supervisor, const Actor*) { use_class(supervisor); });
        for (const Actor& actor : plan_.actors) actors_[actor.name] = names_.give(actor.name);
        each_supervisor([this](const Supervisor& supervisor, const Actor*) {
            supervisors_[supervisor.name] = names_.give(supervisor.name);
        });
    }

    // With the actor that it is attached to; a global one has none.
    void each_supervisor(const std::function<void(const Supervisor&, const Actor*)>& act) const {
        for (const Supervisor& supervisor : plan_.globals) act(supervisor, nullptr);
        for (const Actor& actor : plan_.actors) {
            for (const Supervisor& supervisor : actor.supervisors) act(supervisor, &actor);
        }
    }

    void use_template(std::string_view name, bool supervisor) {
        const Template* of = find_template(plan_, *checked_.library, name, supervisor);
        if (classes_.contains(of)) return;
        const TemplateClass made = find_class(*checked_.library, *of);
        const std::string space = cpp_namespace(*made.toolbox);
        names_.take(space);
        (own_.contains(made.toolbox->name) ? own_toolboxes_ : toolboxes_).insert(space);
        classes_[of] = made.names;
        paths_[of] = fmt::format("{}::{}", space, made.names.name);
    }

    void use_class(const Actor& actor) {
        if (actor.template_name) use_template(*actor.template_name, false);
        if (const Plan* sub = checked_.sub_plan(plan_, actor))
            sub_plans_.insert(names_of(*sub).file);
    }
    void use_class(const Supervisor& supervisor) { use_template(*supervisor.template_name, true); }

    struct Class {
        const CppClass* names;
        std::string path;
        Interface face;
    };
    Class class_of(const Actor& actor) const {
        if (const Plan* sub = checked_.sub_plan(plan_, actor)) {
            const CppClass& names = names_of(*sub).as_actor;
            return {&names, names.name, interface_of(*sub)};
        }
        return class_of_template(*actor.template_name, false);
    }
    Class class_of(const Supervisor& supervisor) const {
        return class_of_template(*supervisor.template_name, true);
    }
    Class class_of_template(std::string_view name, bool supervisor) const {
        const Template* of = find_template(plan_, *checked_.library, name, supervisor);
        return {&classes_.at(of), paths_.at(of), interface_of(*of)};
    }

    std::string target(const std::string& name) const {
        if (name == kTerminate) return "Plan::kTerminate";
        return name == kIgnore ? "Plan::kIgnore" : actors_.at(name);
    }

    // ---- the parts of the file ----

    std::string write_includes() const {
        std::string text;
        for (const std::string& toolbox : toolboxes_) {
            text += fmt::format("#include <vagus/templates/{}.hpp>\n", toolbox);
        }
        for (const std::string& toolbox : own_toolboxes_) {
            text += fmt::format("#include \"{}.hpp\"\n", toolbox);
        }
        for (const std::string& file : sub_plans_) {
            if (file != names_of(plan_).file) text += fmt::format("#include \"{}.hpp\"\n", file);
        }
        return text + "\n";
    }

    std::string write_usings(const std::string& body) const {
        std::string text = "    using vagus::embed::Plan;\n";
        for (const std::string_view one : {"Access", "Type"}) {
            if (body.find(fmt::format(" {}::", one)) == std::string::npos) continue;
            text += fmt::format("    using vagus::embed::{};\n", one);
        }
        std::set<std::string> toolboxes = toolboxes_;
        toolboxes.insert(own_toolboxes_.begin(), own_toolboxes_.end());
        for (const std::string& toolbox : toolboxes) {
            text += fmt::format("    namespace {0} = vagus::templates::{0};\n", toolbox);
        }
        return text;
    }

    MarkedText write_actors() const {
        MarkedText text;
        text += "\n    // ---- actors ----\n";
        for (const Actor& actor : plan_.actors) {
            text.add(write_object(actor, actors_.at(actor.name)), keys_of(actor));
        }
        return text;
    }

    MarkedText write_supervisors() const {
        MarkedText text;
        each_supervisor([this, &text](const Supervisor& supervisor, const Actor* of) {
            if (text.text().empty()) text += "\n    // ---- supervisors ----\n";
            const std::string& name = supervisors_.at(supervisor.name);
            std::string lines = write_object(supervisor, name);
            if (supervisor.period_ms) {
                lines +=
                    fmt::format("    {}.period_ms({});\n", name, supervisor.period_ms->integer());
            }
            text.add(lines, keys_of(supervisor, of));
        });
        return text;
    }

    // One object with its entries, in the order of declaration.
    template <typename Element>
    std::string write_object(const Element& element, const std::string& name) const {
        const Class of = class_of(element);
        std::vector<std::string> in, out;
        for (const Input& input : of.face.inputs) {
            for (const Entry& entry : element.in) {
                if (entry.name != input.name) continue;
                in.push_back(fmt::format(".{} = {}", of.names->inputs.at(input.name),
                                         cpp_string(entry_text(entry))));
            }
        }
        for (const OutputDeclaration& declared : of.face.outputs) {
            for (const Output& output : element.out) {
                if (output.name != declared.name) continue;
                out.push_back(fmt::format(".{} = {}", of.names->outputs.at(output.name),
                                          cpp_string(output.variable)));
            }
        }
        std::vector<std::string> arguments = {cpp_string(element.name)};
        if (!in.empty() || !out.empty()) arguments.push_back(braces(in));
        if (!out.empty()) arguments.push_back(braces(out));
        return call(fmt::format("{} {}", of.path, name), arguments) +
               write_order(element.out, of.face, name);
    }

    static std::string braces(const std::vector<std::string>& list) {
        return fmt::format("{{{}}}", fmt::join(list, ", "));
    }

    // Only where the outputs are written in another order than that of their declaration (P17a).
    static std::string write_order(const std::vector<Output>& outputs, const Interface& face,
                                   const std::string& object) {
        std::vector<size_t> places;
        std::vector<std::string> names;
        for (const Output& output : outputs) {
            names.push_back(cpp_string(output.name));
            for (size_t i = 0; i < face.outputs.size(); ++i) {
                if (face.outputs[i].name == output.name) places.push_back(i);
            }
        }
        if (std::is_sorted(places.begin(), places.end())) return "";
        return fmt::format("    {}.writes_in_order({});\n", object, braces(names));
    }

    MarkedText write_configuration() const {
        std::string toolboxes;
        for (const ToolboxName& toolbox : plan_.toolboxes) {
            toolboxes +=
                fmt::format("{}{}", toolboxes.empty() ? "" : ", ", cpp_string(toolbox.name));
        }
        MarkedText text;
        text += "\n    // ---- the plan ----\n";
        std::vector<std::string> arguments = {cpp_string(plan_.name)};
        if (!toolboxes.empty()) arguments.push_back("{" + toolboxes + "}");
        text += call("Plan plan", arguments);
        if (!plan_.help.empty()) text += fmt::format("    plan.help({});\n", in_lines(plan_.help));
        for (const Variable& variable : plan_.configuration) {
            text.add(write_variable(variable), {"configuration", variable.name});
        }
        return text;
    }

    static std::string write_variable(const Variable& variable) {
        std::vector<std::string> options;
        if (variable.initial) {
            options.push_back(fmt::format(".initial = {}", constant_text(*variable.initial)));
        }
        if (variable.access != Access::Local) {
            options.push_back(fmt::format(".access = {}", access_text(*variable.access)));
        }
        if (!variable.unit.empty()) {
            options.push_back(fmt::format(".unit = {}", cpp_string(variable.unit)));
        }
        if (!variable.help.empty()) {
            options.push_back(fmt::format(".help = {}", cpp_string(variable.help)));
        }
        std::vector<std::string> arguments = {cpp_string(variable.name),
                                              std::string(type_text(*variable.type))};
        if (!options.empty()) arguments.push_back(braces(options));
        return call("plan.variable", arguments);
    }

    MarkedText write_start() const {
        MarkedText text;
        text.add(call("plan.start_with", {actors_.at(*plan_.start_actor)}), {"start"});
        for (const Supervisor& supervisor : plan_.globals) {
            text.add(write_events("plan.always", {}, supervisor), keys_of(supervisor, nullptr));
        }
        return text;
    }

    std::string write_events(std::string_view head, const std::vector<std::string>& before,
                             const Supervisor& supervisor) const {
        std::string text;
        const Class of = class_of(supervisor);
        std::vector<std::string> known = before;
        known.push_back(supervisors_.at(supervisor.name));
        if (supervisor.events.empty()) return call(head, known);
        for (const Rule& rule : supervisor.events) {
            std::vector<std::string> arguments = known;
            arguments.push_back(fmt::format("{}::{}", of.path, of.names->outcomes.at(rule.name)));
            arguments.push_back(target(rule.target));
            text += call(head, arguments);
        }
        return text;
    }

    MarkedText write_rules() const {
        MarkedText text;
        for (const Actor& actor : plan_.actors) {
            text += "\n";
            text.add(write_states(actor), keys_of(actor));
            for (const Supervisor& supervisor : actor.supervisors) {
                text.add(write_events("plan.during", {actors_.at(actor.name)}, supervisor),
                         keys_of(supervisor, &actor));
            }
        }
        text += "\n";
        return text;
    }

    std::string write_states(const Actor& actor) const {
        const std::string& object = actors_.at(actor.name);
        std::string text = fmt::format("    // {}\n", actor.name);
        const Class of = class_of(actor);
        for (const Rule& rule : actor.states) {
            text += call("plan.after",
                         {object, fmt::format("{}::{}", of.path, of.names->outcomes.at(rule.name)),
                          target(rule.target)});
        }
        if (actor.states.empty() && actor.supervisors.empty()) text += call("plan.add", {object});
        return text;
    }

    const Checked& checked_;
    const Plan& plan_;
    const std::vector<PlanNames>& plan_names_;
    const OwnToolboxes& own_;
    CppNames names_{"plan", "Plan", "Type", "Access", kNamespace};
    std::map<std::string, std::string> actors_;       // a name in the plan to that in C++
    std::map<std::string, std::string> supervisors_;  // likewise
    std::map<const Template*, CppClass> classes_;
    std::map<const Template*, std::string> paths_;  // of their classes: core::Wait
    std::set<std::string> toolboxes_;               // namespaces
    std::set<std::string> own_toolboxes_;           // likewise
    std::set<std::string> sub_plans_;               // files
};

std::string write_header(const Plan& plan, const PlanNames& names, bool is_sub_plan) {
    std::string text = fmt::format(
        "// The plan {}.\n#pragma once\n\n#include <vagus/embed/plan_code.hpp>\n\n"
        "namespace {} {{\n\nvagus::embed::Plan {}();\n",
        plan.name, kNamespace, names.make);
    if (is_sub_plan) {
        text += "\n// As an actor of another plan.\n";
        text += generate_sub_plan_class(plan, names.as_actor, names.make);
    }
    return text + fmt::format("\n}}  // namespace {}\n", kNamespace);
}

std::string write_main(const PlanNames& names, const std::vector<const Toolbox*>& own) {
    std::string toolboxes;
    for (const Toolbox* toolbox : own) {
        toolboxes += fmt::format("// The toolbox \"{}\" is given with --toolbox.\n", toolbox->name);
    }
    return fmt::format(
        "// Runs the plan, with the options of `vagus plan run`.\n{}"
        "#include <vagus/embed/command_line.hpp>\n\n#include \"{}.hpp\"\n\n"
        "int main(int argc, char** argv) {{\n"
        "    return vagus::embed::run_main(&{}::{}, argc, argv);\n}}\n",
        toolboxes, names.file, kNamespace, names.make);
}

// Those of `own` that the plans list.
std::vector<const Toolbox*> listed(const Checked& checked, const OwnToolboxes& own) {
    std::set<std::string> names;
    for (const Plan& plan : checked.plans) {
        for (const ToolboxName& toolbox : plan.toolboxes) names.insert(toolbox.name);
    }
    std::vector<const Toolbox*> toolboxes;
    for (const std::string& name : names) {
        if (own.contains(name)) toolboxes.push_back(checked.library->find(name));
    }
    return toolboxes;
}

std::string write_cmake(const std::vector<PlanNames>& names) {
    const std::string& target = names.front().file;
    std::string text = fmt::format(
        "cmake_minimum_required(VERSION 3.25)\nproject({0} LANGUAGES CXX)\n\n"
        "find_package(Vagus REQUIRED)\n\nadd_executable({0}\n  main.cpp",
        target);
    for (const PlanNames& one : names) text += fmt::format("\n  {}.cpp", one.file);
    return text + fmt::format(")\ntarget_link_libraries({} PRIVATE Vagus::embed)\n", target);
}

}  // namespace

MarkedText generate_code(const Checked& checked, const OwnToolboxes& own) {
    assert(checked.ok());
    const std::vector<PlanNames> names = name_plans(checked);
    return CodeWriter(checked, checked.plans.front(), names, own).write();
}

std::map<std::string, std::string> generate(const Checked& checked, const OwnToolboxes& own) {
    assert(checked.ok());
    const std::vector<PlanNames> names = name_plans(checked);
    std::set<const Plan*> sub_plans;
    for (const Plan& plan : checked.plans) {
        for (const Actor& actor : plan.actors) sub_plans.insert(checked.sub_plan(plan, actor));
    }
    std::map<std::string, std::string> files;
    for (size_t i = 0; i < names.size(); ++i) {
        const Plan& plan = checked.plans[i];
        files[names[i].file + ".hpp"] = write_header(plan, names[i], sub_plans.contains(&plan));
        files[names[i].file + ".cpp"] = CodeWriter(checked, plan, names, own).write().text();
    }
    const std::vector<const Toolbox*> toolboxes = listed(checked, own);
    for (const Toolbox* toolbox : toolboxes) {
        files[cpp_namespace(*toolbox) + ".hpp"] = generate_toolbox_header(*toolbox);
    }
    files["main.cpp"] = write_main(names.front(), toolboxes);
    files["CMakeLists.txt"] = write_cmake(names);
    return files;
}

}  // namespace vagus::plan
