// What a project says of its fleet (docs/formats.md, "fleet").
//
//     ProjectPart part = read_project_part(in, complaints);   // the key "fleet" of that object
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json_object.hpp"
#include "fleet/limits.hpp"

namespace vagus::fleet {

// An event that scripts hear: from robots of that group, or of all, if it is empty.
struct Hears {
    std::string event = {}, from = {};
    friend bool operator==(const Hears&, const Hears&) = default;
};
// A variable of a node that everybody may see.
struct Tells {
    std::string node = {}, name = {};
    friend auto operator<=>(const Tells&, const Tells&) = default;
};
// The project's own condition of being well after a roll-out, and how long it must be true.
struct Healthy {
    std::string condition = {};  // a plan::WordFormula: it was read once, without a mistake
    Duration lasts = kHealthyFor;
    friend bool operator==(const Healthy&, const Healthy&) = default;
};
// What a robot does when it has not been in the fleet for kBrokerLostAfter.
enum class BrokerLost { Stop, Continue };

struct ProjectPart {
    std::string name = {};  // of the fleet; empty: it is in no fleet by itself
    std::vector<std::string> groups = {}, send = {};
    std::vector<Hears> hear = {};
    std::vector<Tells> tell = {};
    BrokerLost broker_lost = BrokerLost::Stop;
    std::optional<Healthy> healthy = {};
    friend bool operator==(const ProjectPart&, const ProjectPart&) = default;
};

// Need not be there. What is wrong is complained of.
ProjectPart read_project_part(JsonObject& in, Complaints& complaints);

}  // namespace vagus::fleet
