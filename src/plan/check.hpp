// Checks a plan and the sub-plans it names (docs/plans.md, section 5). With any error a plan does
// not run; without one, what this gives can be turned into a Graph (graph.hpp).
//
//     const Checked checked = check("WallFollow.plan.json", files, library);
//     for (const Finding& finding : checked.findings) print(finding);
//     if (checked.ok()) run(make_graph(checked));
#pragma once

#include <map>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "plan/finding.hpp"
#include "plan/model.hpp"
#include "plan/template.hpp"

namespace vagus::plan {

constexpr size_t kPlanFilesMax = 1000;  // sub-plans of sub-plans, together

// Where plan files come from. Tests have them in a map.
class Files {
public:
    virtual ~Files() = default;
    virtual Result<std::string> read(const std::string& path) const = 0;
};

// What an actor or supervisor is an instance of, found in the library.
const Template* find_template(const Plan& plan, const Library& library, std::string_view name,
                              bool supervisor);

// The path of a sub-plan, seen from the file that names it.
std::string path_of_sub_plan(const std::string& file, const std::string& named);

struct Checked {
    std::vector<Plan> plans;           // the outermost first; only files without a P0 finding
    std::map<std::string, int> files;  // path to index in `plans`; -1: unreadable
    std::map<std::string, Error> unreadable;  // sub-plan files, by path, and why
    Findings findings;                        // sorted by line in each file, the outermost's first
    const Library* library = nullptr;         // borrowed

    bool ok() const { return !has_error(findings); }
    // The plan that an actor uses, or nullptr.
    const Plan* sub_plan(const Plan& plan, const Actor& actor) const;
};

Checked check(const std::string& path, const Files& files, const Library& library);

// The same for plans that a program has made, the outermost first; each has a `file` of its own.
// `found` is what making them found already.
Checked check(std::vector<Plan> plans, Findings found, const Library& library);

}  // namespace vagus::plan
