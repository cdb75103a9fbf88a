#include "toolbox/shadowed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/text.hpp"

namespace vagus::toolbox {

namespace {

constexpr std::string_view kRule =
    "toolbox";  // of the findings: they belong to no rule of plans.md

bool is_same(const plan::Template& a, const plan::Template& b) {
    return a.name == b.name &&
           (a.kind == plan::Kind::Supervisor) == (b.kind == plan::Kind::Supervisor);
}

// "mine.toolbox.json:7", or "built in".
std::string place_of(const plan::Toolbox& toolbox, const plan::Template& one) {
    if (toolbox.file.empty()) return "built in";
    return one.line > 0 ? fmt::format("{}:{}", toolbox.file, one.line) : toolbox.file;
}

// What of `later` the toolbox before it replaces: "\"Forward\" (mine.toolbox.json:7; drive: built
// in)".
std::vector<std::string> taken(const plan::Toolbox& before, const plan::Toolbox& later) {
    std::vector<std::string> names;
    for (const plan::Template& one : later.templates) {
        const auto other =
            std::find_if(before.templates.begin(), before.templates.end(),
                         [&one](const plan::Template& each) { return is_same(each, one); });
        if (other == before.templates.end()) continue;
        names.push_back(fmt::format("\"{}\" ({}; {}: {})", one.name, place_of(later, one),
                                    before.name, place_of(before, *other)));
    }
    return names;
}

}  // namespace

plan::Findings find_shadowed(const std::vector<plan::Plan>& plans, const plan::Library& library) {
    plan::Findings findings;
    for (const plan::Plan& plan : plans) {
        std::vector<const plan::Toolbox*> before;
        for (const plan::ToolboxName& listed : plan.toolboxes) {
            const plan::Toolbox* toolbox = library.find(listed.name);
            if (!toolbox || std::find(before.begin(), before.end(), toolbox) != before.end()) {
                continue;
            }
            for (const plan::Toolbox* earlier : before) {
                // Nobody who draws a plan can rename these, and what they share means the same.
                if (earlier->file.empty() && toolbox->file.empty()) continue;
                const std::vector<std::string> names = taken(*earlier, *toolbox);
                if (names.empty()) continue;
                findings.push_back(
                    {plan::Severity::Warning, std::string(kRule), plan.file, plan.name, "",
                     listed.line.line,
                     fmt::format("of the toolbox {} this plan can never use {}, for {} is listed "
                                 "before it; change the order, or rename them",
                                 toolbox->name, list_of({names.begin(), names.end()}),
                                 earlier->name),
                     listed.line.column});
            }
            before.push_back(toolbox);
        }
    }
    return findings;
}

}  // namespace vagus::toolbox
