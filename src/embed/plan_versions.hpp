// The versions of a plan that runs (docs/plans.md, P31), as its files are saved: reads and checks
// them again, and keeps each that took over, since the trace of the run names what is in it.
//
//     PlanVersions versions(plan, "WallFollow.plan.json");
//     const auto made = versions.read({"WallFollow.plan.json"});   // it was saved
//     if (made.plan.ok()) versions.hand_in(made), debugger.post(run::TakeVersion{made.next});
//     versions.took(graph);                  // once it has been accepted; else refused(graph)
#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "embed/loaded_plan.hpp"

namespace vagus::embed {

class PlanVersions {
public:
    // `path`: that of the outermost plan, as it was loaded.
    PlanVersions(LoadedPlan first, std::string path);

    // The plan or one inside it, as it runs or as a version that was not taken names them.
    bool is_part(const std::string& file) const;
    std::vector<std::string> files() const;

    struct Made {
        LoadedPlan plan;  // not ok(): its findings say why
        plan::NewVersion next = {};
    };
    // What is on the disk, after these files were saved. Files whose version was refused before
    // count as saved, too.
    Made read(const std::vector<std::string>& saved);
    // The same if these files had these texts.
    Made with(const std::map<std::string, std::string>& texts) const;

    // It is on its way to the run …
    void hand_in(Made made) { handed_in_.push_back(std::move(made)); }
    // … which has accepted it; gives what it was made of. Can be told twice.
    const std::vector<plan::Plan>& took(const plan::Graph& graph);
    void refused(const plan::Graph& graph);

private:
    Made made_of(LoadedPlan plan, const std::set<std::string>& saved) const;

    std::string path_;
    std::vector<LoadedPlan> taken_;  // the first, and what took over from it
    std::vector<Made> handed_in_;
    std::set<std::string> waiting_;  // saved and not taken yet; normal paths
    std::set<std::string> named_;    // plan files of a version that waits
};

constexpr size_t kErrorsToldMax = 100;

// The errors of a version, a line each, without its warnings; of more than kErrorsToldMax the last
// line says how many.
std::vector<std::string> errors_of(const LoadedPlan& plan);

}  // namespace vagus::embed
