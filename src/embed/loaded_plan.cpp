#include "embed/loaded_plan.hpp"

#include <filesystem>

#include "base/file.hpp"
#include "base/project_border.hpp"
#include "toolbox/shadowed.hpp"

namespace vagus::embed {

namespace {

// One file whose text is here; the others are on the disk.
class TextAndDisk final : public plan::Files {
public:
    TextAndDisk(const std::string& path, std::string text)
        : path_(path), text_(std::move(text)), disk_(path) {}
    Result<std::string> read(const std::string& path) const override {
        return path == path_ ? Result<std::string>(text_) : disk_.read(path);
    }

private:
    std::string path_;
    std::string text_;
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
    const std::string normal = std::filesystem::path(path).lexically_normal().string();
    const TextAndDisk files(normal, std::move(text));
    return LoadedPlan(plan::check(normal, files, library.templates()), library);
}

LoadedPlan LoadedPlan::from_code(MakePlan make, const run::CodeLibrary& library) {
    Assembly assembly = assemble(make);
    return LoadedPlan(
        plan::check(std::move(assembly.plans), std::move(assembly.findings), library.templates()),
        library);
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
