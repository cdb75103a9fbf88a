// The events that a plan may use on a bus: those that the projects of its nodes declare, for only a
// project gives an event its number (docs/formats.md, "Numbers of events").
//
//     const BusNames names(project.common, "arm.aesl");
//     report(names.check(plans, library));                       // before the run
//     options.may_emit = [names](const run::BusEvent& event) { return names.may_emit(event); };
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/target.hpp"
#include "base/result.hpp"
#include "plan/finding.hpp"
#include "plan/model.hpp"
#include "plan/template.hpp"
#include "run/code.hpp"

namespace vagus::session {

class BusNames {
public:
    // `source` is what declares them, for sentences: "the scripts of arena.world.json".
    BusNames(aesl::CommonDefinitions common, std::string source)
        : common_(std::move(common)), source_(std::move(source)) {}

    // The Error names the event, a near one, and how to fix it.
    Status may_emit(const run::BusEvent& event) const;
    // Errors for events that plans name outright (in `Send`, `Receive`, `OnEvent`), or by which
    // their templates work, and that no project declares; what a formula makes of variables is
    // known only in the run.
    plan::Findings check(const std::vector<plan::Plan>& plans, const plan::Library& library) const;

private:
    Status known(std::string_view event) const;
    std::string near(std::string_view event) const;
    Status all_known(const plan::Template& of) const;
    const aesl::GlobalEvent* find(std::string_view event) const;

    aesl::CommonDefinitions common_;
    std::string source_;
};

// Whether the plans use a bus at all: those templates of `core` do, and those of other toolboxes.
bool uses_bus(const std::vector<plan::Plan>& plans, const plan::Library& library);

// Whether they send events of their own (`Send`): then nobody knows on which nodes they work.
bool sends_events(const std::vector<plan::Plan>& plans);

// Events that the plans wait for, as far as they contain their names; those by which a template
// works are among them, whichever way they go.
std::set<std::string> events_heard(const std::vector<plan::Plan>& plans,
                                   const plan::Library& library);
// Events by which the templates of a library end their work on nodes.
std::set<std::string> stop_events(const plan::Library& library);

}  // namespace vagus::session
