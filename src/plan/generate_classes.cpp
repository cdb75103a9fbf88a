#include "plan/generate_classes.hpp"

#include <fmt/format.h>

#include "plan/cpp_text.hpp"
#include "plan/interface.hpp"

namespace vagus::plan {

namespace {

template <typename List>
std::map<std::string, std::string> give_names(CppNames& names, const List& list) {
    std::map<std::string, std::string> given;
    for (const auto& one : list) given[one.name] = names.give(one.name);
    return given;
}

CppClass class_of(const Interface& face, std::string name) {
    // What the base classes have to offer keeps its names.
    CppNames members({name, "In", "Out", "Place", "feed", "write", "period_ms", "writes_in_order"});
    CppNames inputs({"In"});
    CppNames outputs({"Out"});
    CppClass made;
    made.name = std::move(name);
    made.inputs = give_names(inputs, face.inputs);
    made.outputs = give_names(outputs, face.outputs);
    made.outcomes = give_names(members, face.outcomes);
    return made;
}

// A help text as one comment: in lines of its own, and with no `\` that would join the next line.
std::string comment(std::string_view help, std::string_view indent) {
    std::string text = fmt::format("{}// ", indent);
    for (const char c : help) {
        if (c == '\n' || c == '\r') {
            text += fmt::format("\n{}// ", indent);
        } else {
            text += c == '\\' ? '/' : c;
        }
    }
    return help.empty() ? std::string() : text + "\n";
}

struct Field {
    std::string name;
    std::string help;
};

std::string fields(std::string_view type, const std::vector<Field>& list) {
    if (list.empty()) return fmt::format("    struct {} {{}};\n", type);
    std::string text = fmt::format("    struct {} {{\n", type);
    for (const Field& field : list) {
        text += comment(field.help, "        ");
        text += fmt::format("        std::string {} = {{}};\n", field.name);
    }
    return text + "    };\n";
}

std::string with_unit(const std::string& help, const std::string& unit) {
    if (unit.empty()) return help;
    return help.empty() ? "in " + unit : fmt::format("{}, in {}", help, unit);
}

struct Kinds {
    std::string_view base;      // class to derive from
    std::string_view constant;  // of its states or events
    std::string made_from;      // arguments of the base behind the name
};

std::string constructors(const Interface& face, const CppClass& names, const Kinds& kinds) {
    const std::string& name = names.name;
    std::string text = fmt::format(
        "\n    explicit {0}(std::string name, Place at = Place::current())\n"
        "        : {0}(std::move(name), In(), Out(), at) {{}}\n"
        "    {0}(std::string name, const In& in, Place at = Place::current())\n"
        "        : {0}(std::move(name), in, Out(), at) {{}}\n"
        "    {0}(std::string name, [[maybe_unused]] const In& in,\n"
        "        [[maybe_unused]] const Out& out, Place at = Place::current())\n"
        "        : {1}(std::move(name), {2}, at) {{\n",
        name, kinds.base, kinds.made_from);
    for (const Input& input : face.inputs) {
        text += fmt::format("        feed({}, in.{});\n", cpp_string(input.name),
                            names.inputs.at(input.name));
    }
    for (const OutputDeclaration& output : face.outputs) {
        text += fmt::format("        write({}, out.{});\n", cpp_string(output.name),
                            names.outputs.at(output.name));
    }
    return text + "    }\n";
}

std::string class_text(const Interface& face, const CppClass& names, const Kinds& kinds) {
    std::vector<Field> inputs, outputs;
    for (const Input& input : face.inputs) {
        inputs.push_back({names.inputs.at(input.name), with_unit(input.help, input.unit)});
    }
    for (const OutputDeclaration& output : face.outputs) {
        outputs.push_back({names.outputs.at(output.name), with_unit(output.help, output.unit)});
    }
    std::string text = fmt::format(
        "class {} final : public {} {{\npublic:\n    using Place = std::source_location;\n",
        names.name, kinds.base);
    text += fields("In", inputs) + fields("Out", outputs);
    for (const Outcome& outcome : face.outcomes) {
        text += comment(outcome.help, "    ");
        text += fmt::format("    static constexpr {}<{}> {}{{{}}};\n", kinds.constant, names.name,
                            names.outcomes.at(outcome.name), cpp_string(outcome.name));
    }
    return text + constructors(face, names, kinds) + "};\n";
}

}  // namespace

std::string cpp_namespace(const Toolbox& toolbox) {
    return CppNames({}).give(toolbox.name);
}

std::vector<CppClass> cpp_classes(const Toolbox& toolbox) {
    CppNames names({"embed"});
    std::vector<CppClass> classes;
    for (const Template& one : toolbox.templates) {
        classes.push_back(class_of(interface_of(one), names.give(one.name)));
    }
    return classes;
}

CppClass cpp_class_of(const Plan& sub_plan, std::string name) {
    return class_of(interface_of(sub_plan), std::move(name));
}

std::string generate_toolbox_header(const Toolbox& toolbox) {
    std::string text = comment(toolbox.help, "");
    text += fmt::format(
        "// Made from the declarations of the toolbox \"{}\".\n#pragma once\n\n"
        "#include <source_location>\n#include <string>\n#include <utility>\n\n"
        "#include \"embed/plan_code.hpp\"\n\nnamespace vagus::templates::{} {{\n",
        toolbox.name, cpp_namespace(toolbox));
    const std::vector<CppClass> classes = cpp_classes(toolbox);
    for (size_t i = 0; i < classes.size(); ++i) {
        const Template& one = toolbox.templates[i];
        const bool supervisor = one.kind == Kind::Supervisor;
        text += "\n" + comment(one.help, "");
        text += class_text(interface_of(one), classes[i],
                           {supervisor ? "embed::SupervisorObject" : "embed::ActorObject",
                            supervisor ? "embed::Event" : "embed::State", cpp_string(one.name)});
    }
    return text + fmt::format("\n}}  // namespace vagus::templates::{}\n", cpp_namespace(toolbox));
}

std::string generate_sub_plan_class(const Plan& sub_plan, const CppClass& names,
                                    std::string_view make) {
    return class_text(
        interface_of(sub_plan), names,
        {"vagus::embed::SubPlanObject", "vagus::embed::State", fmt::format("&{}", make)});
}

}  // namespace vagus::plan
