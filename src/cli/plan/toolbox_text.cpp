#include "cli/plan/toolbox_text.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/json.hpp"
#include "plan/value.hpp"

namespace vagus::cli {

using plan::Template;

namespace {

std::string_view type_text(const std::optional<plan::Type>& type) {
    return type ? plan::name_of(*type) : "any";
}

// As a person would write it in a formula.
std::string default_text(const plan::Value& value) {
    const Result<std::string> text = plan::text_of(value);
    if (!text.ok()) return "";
    return value.type() == plan::Type::String ? "\"" + text.value() + "\"" : text.value();
}

// ---- text ----

using Row = std::vector<std::string>;

// Columns as wide as their widest word, two spaces apart; the last is as long as it is.
std::string table(const std::vector<Row>& rows, std::string_view indent) {
    std::vector<size_t> widths;
    for (const Row& row : rows) {
        widths.resize(std::max(widths.size(), row.size()));
        for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    }
    std::string text;
    for (const Row& row : rows) {
        std::string line(indent);
        for (size_t i = 0; i < row.size(); ++i) {
            if (widths[i] > 0) line += fmt::format("{:<{}}  ", row[i], widths[i]);
        }
        line.resize(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

std::string inputs_text(const Template& of) {
    std::vector<Row> rows;
    for (const plan::Input& input : of.inputs) {
        std::string range;
        if (input.low && input.high) {
            range = fmt::format("{} to {}", plan::text_of(*input.low), plan::text_of(*input.high));
        }
        rows.push_back(
            {rows.empty() ? "in" : "", input.name, std::string(type_text(input.type)), input.unit,
             input.fallback ? "default " + default_text(*input.fallback) : "", range, input.help});
    }
    return table(rows, "  ");
}

std::string outputs_text(const Template& of) {
    std::vector<Row> rows;
    for (const plan::OutputDeclaration& output : of.outputs) {
        rows.push_back({rows.empty() ? "out" : "", output.name, std::string(type_text(output.type)),
                        output.unit, output.help});
    }
    return table(rows, "  ");
}

std::string outcomes_text(const Template& of) {
    const std::string word = of.kind == plan::Kind::Supervisor ? "events" : "states";
    std::vector<Row> rows;
    for (const plan::Outcome& outcome : of.outcomes) {
        rows.push_back({rows.empty() ? word : "", outcome.name, outcome.help});
    }
    return table(rows, "  ");
}

std::string period_text(const Template& of) {
    if (of.kind != plan::Kind::Supervisor) return "";
    if (of.period_ms == 0) return "  period  none: it waits for events\n";
    return fmt::format("  period  {} ms\n", of.period_ms);
}

std::string template_text(const plan::Toolbox& toolbox, const Template& of) {
    std::string text =
        fmt::format("{}  {} of {}\n  {}\n", of.name, plan::name_of(of.kind), toolbox.name, of.help);
    text += inputs_text(of) + outputs_text(of) + outcomes_text(of) + period_text(of);
    if (!of.bus.events.empty()) {
        text += fmt::format("  bus  {}\n", fmt::join(of.bus.events, ", "));
    }
    return text + fmt::format("  icon  {}\n", of.icon);
}

// ---- JSON ----

JsonValue json_number(double number) {
    JsonValue json;
    json.kind = JsonKind::Float;
    json.number = number;
    json.text = plan::text_of(number);
    return json;
}

JsonValue json_value(const plan::Value& value) {
    JsonValue json;
    switch (value.type()) {
        case plan::Type::Bool:
            json.kind = JsonKind::Bool;
            json.boolean = value.boolean();
            return json;
        case plan::Type::Int:
            return json_integer(value.integer());
        case plan::Type::Float:
            return json_number(value.number());
        case plan::Type::String:
            return json_string(value.string());
        case plan::Type::Object:
            break;
    }
    return json;  // null
}

JsonValue input_json(const plan::Input& input) {
    std::vector<JsonMember> members = {
        json_member("name", input.name), json_member("type", type_text(input.type)),
        json_member("unit", input.unit), json_member("help", input.help)};
    if (input.fallback) members.push_back(json_member("default", json_value(*input.fallback)));
    if (input.low && input.high) {
        members.push_back(
            json_member("range", json_array({json_number(*input.low), json_number(*input.high)})));
    }
    return json_object(std::move(members));
}

JsonValue output_json(const plan::OutputDeclaration& output) {
    return json_object({json_member("name", output.name),
                        json_member("type", type_text(output.type)),
                        json_member("unit", output.unit), json_member("help", output.help)});
}

JsonValue outcome_json(const plan::Outcome& outcome) {
    return json_object({json_member("name", outcome.name), json_member("help", outcome.help)});
}

template <typename List, typename Make>
JsonValue array_of(const List& list, Make make) {
    std::vector<JsonValue> items;
    for (const auto& one : list) items.push_back(make(one));
    return json_array(std::move(items));
}

JsonValue template_json(const Template& of, Detail detail) {
    const bool supervisor = of.kind == plan::Kind::Supervisor;
    std::vector<JsonMember> members = {json_member("name", of.name),
                                       json_member("kind", plan::name_of(of.kind)),
                                       json_member("help", of.help)};
    if (detail == Detail::Names) return json_object(std::move(members));
    members.push_back(json_member("icon", of.icon));
    members.push_back(json_member("in", array_of(of.inputs, input_json)));
    members.push_back(json_member("out", array_of(of.outputs, output_json)));
    members.push_back(
        json_member(supervisor ? "events" : "states", array_of(of.outcomes, outcome_json)));
    if (supervisor) members.push_back(json_member("period_ms", json_integer(of.period_ms)));
    members.push_back(json_member(
        "bus_events", array_of(of.bus.events, [](const auto& one) { return json_string(one); })));
    return json_object(std::move(members));
}

}  // namespace

std::string list_text(const std::vector<ShownToolbox>& shown) {
    std::string text;
    for (const ShownToolbox& one : shown) {
        std::vector<Row> rows;
        for (const Template* of : one.templates) {
            rows.push_back({of->name, std::string(plan::name_of(of->kind)), of->help});
        }
        text += fmt::format("{}{}: {}\n", text.empty() ? "" : "\n", one.toolbox->name,
                            one.toolbox->help);
        text += table(rows, "  ");
    }
    return text;
}

std::string show_text(const std::vector<ShownToolbox>& shown) {
    std::string text;
    for (const ShownToolbox& one : shown) {
        for (const Template* of : one.templates) {
            text += (text.empty() ? "" : "\n") + template_text(*one.toolbox, *of);
        }
    }
    return text;
}

std::string toolboxes_json(const std::vector<ShownToolbox>& shown, Detail detail) {
    return format_json(array_of(shown, [detail](const ShownToolbox& one) {
        return json_object(
            {json_member("name", one.toolbox->name), json_member("help", one.toolbox->help),
             json_member("templates", array_of(one.templates, [detail](const Template* of) {
                             return template_json(*of, detail);
                         }))});
    }));
}

}  // namespace vagus::cli
