#include "embed/loaded_plan.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/file.hpp"
#include "base/nearest.hpp"
#include "base/project_border.hpp"
#include "toolbox/shadowed.hpp"

namespace vagus::embed {

namespace {

// Files whose texts are here; the others are on the disk.
class TextsAndDisk final : public plan::Files {
public:
    TextsAndDisk(const std::string& path, const std::map<std::string, std::string>& texts)
        : texts_(texts), disk_(path) {}
    Result<std::string> read(const std::string& path) const override {
        const auto found = texts_.find(normal(path));
        return found != texts_.end() ? Result<std::string>(found->second) : disk_.read(path);
    }

    static std::string normal(const std::string& path) {
        return std::filesystem::path(path).lexically_normal().string();
    }

private:
    const std::map<std::string, std::string>& texts_;  // by normal path
    PlanDisk disk_;
};

}  // namespace

PlanDisk::PlanDisk(const std::string& path)
    : first_(std::filesystem::path(path).lexically_normal().string()),
      border_(project_border(path)) {}

Result<std::string> PlanDisk::read(const std::string& path) const {
    if (path != first_) TRY(check_inside(border_, path));
    return read_file(path);
}

LoadedPlan::LoadedPlan(const plan::Checked& checked, const run::CodeLibrary& library)
    : findings_(checked.findings), library_(&library) {
    const plan::Findings shadowed = toolbox::find_shadowed(checked.plans, library.templates());
    findings_.insert(findings_.end(), shadowed.begin(), shadowed.end());
    if (!checked.ok()) return;
    graph_ = std::make_shared<const plan::Graph>(plan::make_graph(checked));
    plans_ = std::make_shared<const std::vector<plan::Plan>>(checked.plans);
    for (const plan::Variable& variable : checked.plans.front().configuration) {
        const bool input = plan::is_input(*variable.access);
        const bool output = plan::is_output(*variable.access);
        if (!input && !output) continue;
        parameters_.push_back({.name = variable.name,
                               .input = input,
                               .output = output,
                               .has_default = input && variable.initial.has_value()});
    }
}

LoadedPlan LoadedPlan::from_file(const std::string& path, const run::CodeLibrary& library) {
    return LoadedPlan(plan::check(path, PlanDisk(path), library.templates()), library);
}

LoadedPlan LoadedPlan::from_text(std::string text, const std::string& path,
                                 const run::CodeLibrary& library) {
    const std::string normal = TextsAndDisk::normal(path);
    return from_texts(normal, {{normal, std::move(text)}}, library);
}

LoadedPlan LoadedPlan::from_texts(const std::string& path,
                                  const std::map<std::string, std::string>& texts,
                                  const run::CodeLibrary& library) {
    std::map<std::string, std::string> by_path;
    for (const auto& [file, text] : texts) by_path.emplace(TextsAndDisk::normal(file), text);
    const TextsAndDisk files(path, by_path);
    return LoadedPlan(plan::check(path, files, library.templates()), library);
}

LoadedPlan LoadedPlan::from_code(MakePlan make, const run::CodeLibrary& library) {
    Assembly assembly = assemble(make);
    return LoadedPlan(
        plan::check(std::move(assembly.plans), std::move(assembly.findings), library.templates()),
        library);
}

Result<LoadedPlan> LoadedPlan::starting_at(const std::string& actor) const {
    auto graph = std::make_shared<plan::Graph>(*graph_);
    plan::GraphPlan& plan = graph->plans.front();
    const int start = plan::find_actor(plan, actor);
    if (start < 0) {
        std::vector<std::string> known;
        for (const plan::GraphActor& one : plan.actors) known.push_back(one.name);
        const std::string near = nearest(actor, known);
        return Error{Code::NotFound,
                     fmt::format("the plan {} has no actor \"{}\"; {}", plan.name, actor,
                                 near.empty() ? fmt::format("it has {}", fmt::join(known, ", "))
                                              : fmt::format("did you mean {}?", near))};
    }
    plan.start = start;
    LoadedPlan other = *this;
    other.graph_ = std::move(graph);
    return other;
}

std::string LoadedPlan::report() const {
    return format_findings(findings_);
}

std::string format_findings(const plan::Findings& findings) {
    std::string lines;
    for (const plan::Finding& finding : findings) {
        const std::string element = finding.element.empty() ? "" : finding.element + ": ";
        lines += text_of(Diagnostic{.severity = finding.severity,
                                    .file = finding.file,
                                    .at = {finding.line, finding.column},
                                    .sentence = element + finding.message,
                                    .code = finding.rule,
                                    .source = {}}) +
                 "\n";
    }
    return lines;
}

}  // namespace vagus::embed
