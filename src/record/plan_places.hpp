// Where the elements of a recorded run are written: "follow-wall/WallFollow.plan.json:61".
#pragma once

#include <string>
#include <string_view>

#include "plan/model.hpp"
#include "record/replay.hpp"

namespace vagus::record {

class PlanPlaces {
public:
    // Both borrowed; a plan of the rerun, or nullptr.
    PlanPlaces(const Rerun& rerun, const embed::LoadedPlan* plan) : rerun_(rerun), plan_(plan) {}

    // An actor or a supervisor of the plan with that instance path ("Rooms/enter"; empty: the
    // outermost). Empty if there is none.
    std::string element(const std::string& path, std::string_view name) const;
    // Its key `start`.
    std::string plan(const std::string& path) const;
    // A variable of its configuration.
    std::string variable(const std::string& path, std::string_view name) const;
    // An entry of the timeline of the world, by its index in the order of time.
    std::string timeline(size_t entry) const;

private:
    const plan::Plan* find(const std::string& path) const;
    std::string place(const plan::Plan& plan, Place at) const;

    const Rerun& rerun_;
    const embed::LoadedPlan* plan_;
};

}  // namespace vagus::record
