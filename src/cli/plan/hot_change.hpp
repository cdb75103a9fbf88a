// `vagus plan run --watch`: a plan file that is saved while the plan runs takes over
// (docs/plans.md, P31). What is in its way is said, and the plan runs on as it was.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cli/file_watch.hpp"
#include "cli/plan/run.hpp"
#include "embed/plan_versions.hpp"
#include "run/debugger.hpp"

namespace vagus::cli {

// Its run must have its debugger. All but the constructor is for one other thread: that which
// looks whether files are saved.
class HotChange {
public:
    // Borrowed. `say` is told lines for people.
    HotChange(const TerminalRun& run, const std::string& file,
              std::function<void(const std::string&)> say);

    run::Debugger& debugger() { return debugger_; }
    // Whether it was made of these files, and nothing but plans is among them.
    bool is_for(const std::vector<std::string>& saved) const;
    // Plan files that the version names are watched, too, from now on. False: no run goes on that
    // could take it.
    bool hand_in(const std::vector<std::string>& saved, FileWatch& watch);

private:
    void refuse(const std::vector<std::string>& reasons);

    embed::PlanVersions versions_;
    run::Debugger debugger_;
    std::function<void(const std::string&)> say_;
};

}  // namespace vagus::cli
