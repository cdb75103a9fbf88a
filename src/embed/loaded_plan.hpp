// A plan that has been read and checked, ready for any number of runs.
//
//     run::CodeLibrary library;
//     toolbox::add_core(library);                        // and toolboxes of your own: run/code.hpp
//     const LoadedPlan plan = LoadedPlan::from_file("Square.plan.json", library);
//     if (!plan.ok()) return complain(plan.report());    // FILE:LINE: error: sentence [RULE]
#pragma once

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "embed/plan_code.hpp"
#include "plan/change.hpp"
#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "run/code.hpp"

namespace vagus::embed {

// A variable through which callers give or get values (P5).
struct Parameter {
    std::string name;
    bool input = false;
    bool output = false;
    bool has_default = false;  // an input with `initial` (P5a)
};

// Plan files on the disk, for one plan and the sub-plans that it names: those do not lead out of
// its project.
class PlanDisk final : public plan::Files {
public:
    // `path`: the outermost plan, which was named by its path and may be anywhere.
    explicit PlanDisk(const std::string& path);
    Result<std::string> read(const std::string& path) const override;

private:
    std::string first_;
    std::string border_;
};

class LoadedPlan {
public:
    // The library is borrowed by the plan and by its runs. Sub-plans are found beside the file.
    static LoadedPlan from_file(const std::string& path, const run::CodeLibrary& library);
    // `path` is what findings call the text; sub-plans are found beside it.
    static LoadedPlan from_text(std::string text, const std::string& path,
                                const run::CodeLibrary& library);
    // The same with the texts of several files; those that are not among them are on the disk.
    static LoadedPlan from_texts(const std::string& path,
                                 const std::map<std::string, std::string>& texts,
                                 const run::CodeLibrary& library);
    // A plan written in C++ (plan_code.hpp).
    static LoadedPlan from_code(MakePlan make, const run::CodeLibrary& library);

    // No error was found: the plan can run.
    bool ok() const { return graph_ != nullptr; }
    const plan::Findings& findings() const { return findings_; }
    // Errors and warnings as lines for people; empty if there are none.
    std::string report() const;

    // Only if ok().
    const plan::Graph& graph() const { return *graph_; }
    // As a new version for a run of an earlier one (P31); `files` are those that it is about.
    plan::NewVersion as_version(std::vector<std::string> files) const {
        return {graph_, std::move(files)};
    }
    // The same plan, its run beginning at another actor of the outermost plan.
    Result<LoadedPlan> starting_at(const std::string& actor) const;
    const std::vector<plan::Plan>& plans() const { return *plans_; }  // what it was made of
    const std::vector<Parameter>& parameters() const { return parameters_; }
    const run::CodeLibrary& library() const { return *library_; }

private:
    LoadedPlan(const plan::Checked& checked, const run::CodeLibrary& library);

    plan::Findings findings_;
    std::vector<Parameter> parameters_;
    // Owners: all copies of this plan. Never changed, so that copies can run at the same time.
    std::shared_ptr<const plan::Graph> graph_;
    std::shared_ptr<const std::vector<plan::Plan>> plans_;
    const run::CodeLibrary* library_;
};

// As lines: FILE:LINE: error: ELEMENT: sentence [RULE]; without ELEMENT where it is the plan's own.
std::string format_findings(const plan::Findings& findings);

}  // namespace vagus::embed
