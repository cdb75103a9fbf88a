#include "serve/edit/template_list.hpp"

#include <algorithm>

#include "plan/formula_words.hpp"
#include "plan/value.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/json.hpp"
#include "serve/plan_value.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kToolboxesMax = 200;
constexpr size_t kTemplatesMax = 1000;     // of a toolbox
constexpr size_t kTemplatePartsMax = 256;  // inputs, outputs, outcomes of a template
constexpr size_t kStartsMax = 64;          // events that begin its work on nodes
constexpr size_t kTemplateNameMax = 128;
constexpr size_t kUnitMax = 32;
constexpr size_t kHelpMax = 1000;
constexpr size_t kIconMax = 8192;

template <typename List, typename Make>
Json list_of(const List& from, size_t most, Make make) {
    Json list = Json::array();
    for (const auto& one : from) {
        if (list.size() < most) list.push_back(make(one));
    }
    return list;
}

std::string_view type_of(const std::optional<plan::Type>& type) {
    return type ? plan::name_of(*type) : "any";
}

Json input_of(const plan::Input& input) {
    Json json = {{"name", line_of(input.name, kTemplateNameMax)},
                 {"type", type_of(input.type)},
                 {"unit", line_of(input.unit, kUnitMax)},
                 {"help", line_of(input.help, kHelpMax)}};
    if (input.fallback) json["default"] = json_of(*input.fallback);
    if (input.low) json["low"] = *input.low;
    if (input.high) json["high"] = *input.high;
    return json;
}

Json output_of(const plan::OutputDeclaration& output) {
    return {{"name", line_of(output.name, kTemplateNameMax)},
            {"type", type_of(output.type)},
            {"unit", line_of(output.unit, kUnitMax)},
            {"help", line_of(output.help, kHelpMax)}};
}

Json outcome_of(const plan::Outcome& outcome) {
    return {{"name", line_of(outcome.name, kTemplateNameMax)},
            {"help", line_of(outcome.help, kHelpMax)}};
}

Json template_of(const plan::Template& of) {
    return {{"name", line_of(of.name, kTemplateNameMax)},
            {"kind", plan::name_of(of.kind)},
            {"help", line_of(of.help, kHelpMax)},
            // One that is too long is none: half a drawing would be a wrong one.
            {"icon", of.icon.size() <= kIconMax ? of.icon : ""},
            {"inputs", list_of(of.inputs, kTemplatePartsMax, input_of)},
            {"outputs", list_of(of.outputs, kTemplatePartsMax, output_of)},
            {"outcomes", list_of(of.outcomes, kTemplatePartsMax, outcome_of)},
            {"period_ms", of.period_ms},
            {"starts", list_of(of.bus.starts, kStartsMax, [](const std::string& event) {
                 return line_of(event, kTemplateNameMax);
             })}};
}

Json word_of(std::string_view name, std::string_view is, std::string_view form,
             std::string_view help) {
    return {{"name", name}, {"is", is}, {"form", form}, {"help", help}};
}

Json formula_words() {
    Json words = Json::array();
    for (const plan::FormulaFunction& one : plan::formula_functions()) {
        words.push_back(word_of(one.name, "function", one.form, one.help));
    }
    for (const plan::FormulaOperator& one : plan::formula_operators()) {
        words.push_back(word_of(one.text, "operator", one.form, one.help));
    }
    const auto is_operator = [](std::string_view word) {
        return std::ranges::any_of(plan::formula_operators(),
                                   [word](const auto& one) { return one.text == word; });
    };
    for (const std::string_view word : plan::reserved_words()) {
        if (!is_operator(word)) words.push_back(word_of(word, "constant", word, ""));
    }
    return words;
}

}  // namespace

Json template_list(const plan::Library& of) {
    return {{"toolboxes", list_of(of.toolboxes(), kToolboxesMax,
                                  [](const plan::Toolbox& toolbox) {
                                      return Json{
                                          {"name", line_of(toolbox.name, kTemplateNameMax)},
                                          {"help", line_of(toolbox.help, kHelpMax)},
                                          {"templates",
                                           list_of(toolbox.templates, kTemplatesMax, template_of)}};
                                  })},
            {"formulas", formula_words()}};
}

}  // namespace vagus::serve
