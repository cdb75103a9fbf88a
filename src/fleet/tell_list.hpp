// The variables that a robot tells: those of its project, and for a minute those that somebody
// asked for.
//
//     TellList list(project.tell);
//     if (list.add({"thymio-II", "speed"}, now)) tell(list.all());   // false: too many
//     if (list.forget_old(now)) tell(list.all());                    // true: it is another one
#pragma once

#include <utility>
#include <vector>

#include "base/time.hpp"
#include "fleet/project_part.hpp"

namespace vagus::fleet {

class TellList {
public:
    explicit TellList(std::vector<Tells> project) : project_(std::move(project)) {}

    // At most kTellMax are asked for at once, beside those of the project.
    bool add(const Tells& variable, Time now);
    bool forget_old(Time now);
    std::vector<Tells> all() const;
    Time next() const;

private:
    const std::vector<Tells> project_;
    std::vector<std::pair<Tells, Time>> asked_;  // until then
};

}  // namespace vagus::fleet
