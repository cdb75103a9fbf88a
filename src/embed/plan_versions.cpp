#include "embed/plan_versions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace vagus::embed {

namespace {

std::string normal(const std::string& path) {
    return std::filesystem::path(path).lexically_normal().string();
}

}  // namespace

PlanVersions::PlanVersions(LoadedPlan first, std::string path) : path_(std::move(path)) {
    taken_.push_back(std::move(first));
}

std::vector<std::string> PlanVersions::files() const {
    std::set<std::string> files = named_;
    for (const plan::Plan& one : taken_.back().plans()) files.insert(one.file);
    return {files.begin(), files.end()};
}

bool PlanVersions::is_part(const std::string& file) const {
    const std::vector<std::string> all = files();
    return std::any_of(all.begin(), all.end(), [wanted = normal(file)](const std::string& one) {
        return normal(one) == wanted;
    });
}

PlanVersions::Made PlanVersions::read(const std::vector<std::string>& saved) {
    for (const std::string& file : saved) waiting_.insert(normal(file));
    Made made = made_of(LoadedPlan::from_file(path_, taken_.back().library()), waiting_);
    named_.clear();
    if (!made.plan.ok()) return made;
    for (const plan::Plan& one : made.plan.plans()) named_.insert(one.file);
    return made;
}

PlanVersions::Made PlanVersions::with(const std::map<std::string, std::string>& texts) const {
    std::set<std::string> saved = waiting_;
    for (const auto& [file, text] : texts) saved.insert(normal(file));
    return made_of(LoadedPlan::from_texts(path_, texts, taken_.back().library()), saved);
}

PlanVersions::Made PlanVersions::made_of(LoadedPlan plan,
                                         const std::set<std::string>& saved) const {
    Made made{std::move(plan), {}};
    if (!made.plan.ok()) return made;
    std::vector<std::string> files;
    for (const plan::Plan& one : made.plan.plans()) {
        if (saved.contains(normal(one.file))) files.push_back(one.file);
    }
    made.next = made.plan.as_version(std::move(files));
    return made;
}

const std::vector<plan::Plan>& PlanVersions::took(const plan::Graph& graph) {
    const auto is_it = [&graph](const Made& made) { return &made.plan.graph() == &graph; };
    const auto found = std::find_if(handed_in_.begin(), handed_in_.end(), is_it);
    if (found != handed_in_.end()) {
        for (const std::string& file : found->next.files) waiting_.erase(normal(file));
        taken_.push_back(std::move(found->plan));
        handed_in_.erase(found);
    }
    return taken_.back().plans();
}

void PlanVersions::refused(const plan::Graph& graph) {
    std::erase_if(handed_in_, [&graph](const Made& made) { return &made.plan.graph() == &graph; });
}

std::vector<std::string> errors_of(const LoadedPlan& plan) {
    std::vector<std::string> errors;
    for (const plan::Finding& finding : plan.findings()) {
        if (finding.severity != Severity::Error) continue;
        std::string line = format_findings({finding});
        line.pop_back();  // its newline
        errors.push_back(std::move(line));
    }
    if (errors.size() > kErrorsToldMax) {
        const size_t more = errors.size() - kErrorsToldMax;
        errors.resize(kErrorsToldMax);
        errors.push_back(fmt::format("and {} more; fix these first", more));
    }
    return errors;
}

}  // namespace vagus::embed
