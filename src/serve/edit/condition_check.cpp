#include "serve/edit/condition_check.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/json.hpp"
#include "base/nearest.hpp"
#include "plan/file.hpp"
#include "plan/word_formula.hpp"
#include "serve/project/paths.hpp"
#include "session/project_file.hpp"

namespace vagus::serve {

namespace {

using FormulaName = plan::WordFormula::Name;

class ConditionCheck {
public:
    ConditionCheck(Files& files, Scripts& scripts, const session::ProjectFile& project,
                   const std::string& path)
        : texts_(files), scripts_(scripts), project_(project), path_(path) {}

    // Each sentence without its place.
    std::vector<std::string> mistakes(const plan::WordFormula& formula);
    CheckedTexts& texts() { return texts_; }

private:
    void read_plan();
    std::optional<plan::Type> type_of(const FormulaName& name);
    void no_such_variable(const std::string& name);
    void check_word(const FormulaName& name);
    bool take_words(const ScriptPart& part, const FormulaName& name,
                    std::vector<std::string>& known);

    CheckedTexts texts_;
    Scripts& scripts_;
    const session::ProjectFile& project_;
    const std::string path_;
    std::optional<plan::Plan> plan_;  // none: there is none, or none that can be read
    std::vector<std::string> mistakes_;
};

void ConditionCheck::read_plan() {
    if (project_.plan.empty()) return;
    const std::string path = path_from(path_, project_.plan);
    const auto text = texts_.read(path);
    if (!text.ok()) return;
    plan::PlanFile file = plan::parse_plan(text.value(), path);
    if (file.readable) plan_ = std::move(file.plan);
}

void ConditionCheck::no_such_variable(const std::string& name) {
    if (project_.plan.empty()) {
        return mistakes_.push_back(fmt::format(
            "\"{}\" is no word of a node, and the project has no plan; write node(\"NODE\", "
            "\"{}\")",
            name, name));
    }
    std::vector<std::string> known;
    for (const plan::Variable& one : plan_->configuration) known.push_back(one.name);
    mistakes_.push_back(fmt::format("there is no \"{}\" in the plan {}; {}", name, plan_->name,
                                    known_instead(name, known)));
}

// Nothing: nobody knows; perhaps a mistake that was told.
std::optional<plan::Type> ConditionCheck::type_of(const FormulaName& name) {
    if (name.of == FormulaName::Of::Word) {
        check_word(name);
        return plan::Type::Int;
    }
    if (!plan_ && !project_.plan.empty()) return std::nullopt;
    const int at = plan_ ? plan::find_variable(*plan_, name.variable) : -1;
    if (at >= 0) return plan_->configuration[static_cast<size_t>(at)].type;
    no_such_variable(name.variable);
    return std::nullopt;
}

// Whether what the script declares, or the node it is for, has the word.
bool ConditionCheck::take_words(const ScriptPart& part, const FormulaName& name,
                                std::vector<std::string>& known) {
    const CompiledScript* const script = scripts_.compiled(part.doc);
    if (script == nullptr || script->target.variables.empty()) return true;
    const auto has = [&](const auto& variables) {
        return std::ranges::any_of(variables, [&](const auto& one) {
            known.push_back(one.name);
            return one.name == name.variable && name.element < one.size;
        });
    };
    if (has(script->target.variables)) return true;
    // One with mistakes may declare it.
    return !script->result.ok() || has(script->result.program.variables);
}

void ConditionCheck::check_word(const FormulaName& name) {
    std::vector<std::string> nodes, known;
    bool there = false, has = false;
    for (const ScriptPart& part : scripts_.parts()) {
        if (!part.node.empty()) nodes.push_back(part.node);
        if (part.node != name.node) continue;
        (void)texts_.read(part.file);  // the check holds as long as it is the same
        there = true;
        has = has || take_words(part, name, known);
    }
    if (there && !has) {
        const std::string element = name.element == 0 ? "" : fmt::format("[{}]", name.element);
        return mistakes_.push_back(fmt::format("{}: the node \"{}\" has no variable \"{}{}\"; {}",
                                               name.shown, name.node, name.variable, element,
                                               known_instead(name.variable, known)));
    }
    const std::string near = there ? "" : nearest(name.node, nodes);
    if (near.empty()) return;
    mistakes_.push_back(fmt::format("{}: no script is for a node \"{}\"; did you mean {}?",
                                    name.shown, name.node, near));
}

std::vector<std::string> ConditionCheck::mistakes(const plan::WordFormula& formula) {
    read_plan();
    std::vector<plan::Type> types;
    for (const FormulaName& name : formula.names()) {
        const auto type = type_of(name);
        if (type) types.push_back(*type);
    }
    if (!mistakes_.empty() || types.size() < formula.names().size()) return mistakes_;
    const auto type = formula.type(types);
    if (!type.ok()) mistakes_.push_back(type.error().what);
    return mistakes_;
}

Place place_of_condition(std::string_view text, const std::string& path) {
    const auto json = parse_json(text, path);
    const JsonValue* at = json.ok() ? &json.value() : nullptr;
    for (const char* const key : {"fleet", "healthy", "condition"}) {
        at = at == nullptr ? nullptr : at->find(key);
    }
    return at == nullptr ? Place{} : at->at;
}

}  // namespace

Checkup check_condition(Files& files, Scripts& scripts, const std::string& project_file) {
    Checkup checkup;
    CheckedTexts reading(files);
    const auto text = reading.read(project_file);
    checkup.read = reading.take_read();
    if (!text.ok()) return checkup;
    const auto project = session::read_project_file(text.value(), project_file);
    if (!project.ok() || !project.value().fleet.healthy) return checkup;
    const auto formula = plan::WordFormula::parse(project.value().fleet.healthy->condition);
    if (!formula.ok()) return checkup;
    ConditionCheck check(files, scripts, project.value(), project_file);
    const Place place = place_of_condition(text.value(), project_file);
    for (const std::string& one : check.mistakes(formula.value())) {
        checkup.findings.push_back(finding_of_sentence(
            project_file, text.value(), Severity::Error, "project",
            at_place(project_file, place, "\"condition\" of \"healthy\": " + one)));
    }
    checkup.read.merge(check.texts().take_read());
    return checkup;
}

}  // namespace vagus::serve
