#include "embed/loaded_plan.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/file.hpp"

namespace vagus::embed {

namespace {

class Disk final : public plan::Files {
public:
    Result<std::string> read(const std::string& path) const override { return read_file(path); }
};

// One file whose text is here; the others are on the disk.
class TextAndDisk final : public plan::Files {
public:
    TextAndDisk(std::string path, std::string text)
        : path_(std::move(path)), text_(std::move(text)) {}
    Result<std::string> read(const std::string& path) const override {
        return path == path_ ? Result<std::string>(text_) : read_file(path);
    }

private:
    std::string path_;
    std::string text_;
};

}  // namespace

LoadedPlan::LoadedPlan(const plan::Checked& checked, const run::CodeLibrary& library)
    : findings_(checked.findings), library_(&library) {
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
    return LoadedPlan(plan::check(path, Disk(), library.templates()), library);
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

namespace {

// One line, and nothing that a terminal would obey: names of a wrong file may hold anything.
std::string visible(std::string_view text) {
    std::string shown;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x20 || byte == 0x7f) {
            shown += fmt::format("\\u{:04x}", byte);
        } else {
            shown += c;
        }
    }
    return shown;
}

}  // namespace

std::string format_findings(const plan::Findings& findings) {
    std::string lines;
    for (const plan::Finding& finding : findings) {
        const bool error = finding.severity == plan::Severity::Error;
        const std::string element = finding.element.empty() ? "" : finding.element + ": ";
        lines += fmt::format("{}:{}: {}: {} [{}]\n", finding.file, finding.line,
                             error ? "error" : "warning", visible(element + finding.message),
                             finding.rule);
    }
    return lines;
}

}  // namespace vagus::embed
