#include "embed/bus_check.hpp"

#include <string>

namespace vagus::embed {

plan::Findings missing_names(const session::BusNames& names, const LoadedPlan& plan) {
    return names.check(plan.plans(), plan.library().templates());
}

Status check_names(const session::BusNames& names, const LoadedPlan& plan, std::string_view whose) {
    const plan::Findings findings = missing_names(names, plan);
    if (findings.empty()) return Status::done();
    std::string lines = format_findings(findings);
    lines.pop_back();  // the last newline
    return Error{Code::BadInput,
                 std::string(whose) + " plan names events that its bus does not have\n" + lines};
}

}  // namespace vagus::embed
