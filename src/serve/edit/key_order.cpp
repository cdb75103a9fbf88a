#include "serve/edit/key_order.hpp"

#include <algorithm>

#include "plan/keys.hpp"

namespace vagus::serve {

namespace {

constexpr std::string_view kWorld[] = {"format", "name",    "help",   "seed",     "size",  "open",
                                       "ground", "objects", "robots", "timeline", "fleet", "x"};
constexpr std::string_view kObject[] = {"id",     "kind",   "at",   "angle",  "size",
                                        "radius", "height", "mass", "colour", "x"};
constexpr std::string_view kRobot[] = {"name", "type", "at",     "angle",   "grid",  "spacing",
                                       "node", "port", "script", "project", "paint", "x"};
constexpr std::string_view kWorldFleet[] = {"latency", "jitter", "loss", "twice", "x"};
constexpr std::string_view kEntry[] = {"t",  "do",    "id",     "object", "robot",
                                       "at", "angle", "button", "on",     "x"};
constexpr std::string_view kProject[] = {"format",     "name",      "help",   "plan",  "scripts",
                                         "world",      "toolboxes", "target", "start", "safe_stop",
                                         "when_alone", "fleet",     "x"};
constexpr std::string_view kProjectStart[] = {"plan", "set", "x"};
constexpr std::string_view kFleet[] = {"name", "groups",      "send",    "hear",
                                       "tell", "broker_lost", "healthy", "x"};
constexpr std::string_view kHears[] = {"event", "from", "x"};
constexpr std::string_view kSafeStop[] = {"set", "read", "x"};
constexpr std::string_view kToolbox[] = {"format",    "name",      "help", "project",
                                         "templates", "safe_stop", "x"};
constexpr std::string_view kTemplate[] = {"kind",  "help", "icon",    "node",   "in",     "out",
                                          "start", "stop", "stopped", "states", "events", "x"};
constexpr std::string_view kSlot[] = {"type",  "unit",  "help",  "default",
                                      "range", "scale", "words", "x"};
constexpr std::string_view kOutcome[] = {"event", "out", "help", "x"};

// "*": any key.
struct Order {
    std::string_view language;
    std::vector<std::string_view> path;
    KeyOrder keys;
};

const std::vector<Order>& orders() {
    static const std::vector<Order> kOrders = {
        {"plan", {}, plan::kPlanKeys},
        {"plan", {"configuration", "*"}, plan::kVariableKeys},
        {"plan", {"start"}, plan::kStartKeys},
        {"plan", {"start", "supervisors", "*"}, plan::kSupervisorKeys},
        {"plan", {"actors", "*"}, plan::kActorKeys},
        {"plan", {"actors", "*", "supervisors", "*"}, plan::kSupervisorKeys},
        {"world", {}, kWorld},
        {"world", {"objects", "[]"}, kObject},
        {"world", {"robots", "[]"}, kRobot},
        {"world", {"timeline", "[]"}, kEntry},
        {"world", {"fleet"}, kWorldFleet},
        {"world", {"timeline", "[]", "object"}, kObject},
        {"project", {}, kProject},
        {"project", {"start"}, kProjectStart},
        {"project", {"safe_stop", "*"}, kSafeStop},
        {"project", {"fleet"}, kFleet},
        {"project", {"fleet", "hear", "[]"}, kHears},
        {"toolbox", {}, kToolbox},
        {"toolbox", {"safe_stop", "*"}, kSafeStop},
        {"toolbox", {"templates", "*"}, kTemplate},
        {"toolbox", {"templates", "*", "in", "*"}, kSlot},
        {"toolbox", {"templates", "*", "out", "*"}, kSlot},
        {"toolbox", {"templates", "*", "states", "*"}, kOutcome},
        {"toolbox", {"templates", "*", "events", "*"}, kOutcome},
    };
    return kOrders;
}

}  // namespace

KeyOrder key_order(std::string_view language, const std::vector<std::string>& path) {
    for (const Order& order : orders()) {
        if (order.language != language || order.path.size() != path.size()) continue;
        const bool fits = std::equal(path.begin(), path.end(), order.path.begin(),
                                     [](const std::string& step, std::string_view wanted) {
                                         return step == wanted || wanted == "*";
                                     });
        if (fits) return order.keys;
    }
    return {};
}

}  // namespace vagus::serve
