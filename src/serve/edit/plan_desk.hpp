// What editors ask about plans: plan.check, plan.code.
#pragma once

#include "serve/edit/findings.hpp"
#include "serve/project/files.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

class PlanDesk {
public:
    // All borrowed.
    PlanDesk(Desk& desk, Files& files, Findings& findings);

private:
    void check(const Call& call);
    void code(const Call& call);

    Files& files_;
    Findings& findings_;
};

}  // namespace vagus::serve
