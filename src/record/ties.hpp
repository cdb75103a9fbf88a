// Who lost against an event of a supervisor: others that would have raised one at the same instant,
// and the actor that would have ended then (docs/plans.md, P21).
//
// The trace tells only who won. So the run is run again up to that instant, where the event is
// passed over; whatever ends the activation then is a loser, is passed over, too, and so on.
//
//     for (const Loser& loser : TRY(losers(reader, causes.bus(0), index))) print(loser.name);
#pragma once

#include <string>
#include <vector>

#include "mcap/reader.hpp"
#include "record/causes.hpp"

namespace vagus::record {

struct Loser {
    std::string name;     // of the supervisor, or of the actor
    std::string outcome;  // the event that it would have raised, or the state
    bool actor = false;
    std::string place = {};  // "follow-wall/WallFollow.plan.json:47"
    friend bool operator==(const Loser&, const Loser&) = default;
};

// Against the event of that line of the trace of the plan on that bus, in the order of P21. One
// whose event was taken after it, at the same instant, has not lost.
Result<std::vector<Loser>> losers(const mcap::Reader& reader, const BusCauses& bus, size_t index);

// "won against sonarNear, which raised NearWall at the same instant".
std::string won_against(const std::vector<Loser>& losers);

}  // namespace vagus::record
