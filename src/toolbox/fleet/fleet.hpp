// What templates of the toolbox `fleet` reach the other robots through: the keeper's answers and
// leases, values that all share, who is online. Who has the link to the fleet implements it; the
// templates know no broker.
//
//     const uint64_t number = fleet.ask(keeper::Take{"pick", 10s});
//     run.hear({std::string(kFleetNews), {}});           // something has changed: look again
//     if (const auto over = fleet.answer(number)) …
//
// Called on the thread of the template's code; news may come from any thread.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "keeper/leases.hpp"

namespace vagus::toolbox {

// What a run hears when there is something new to ask for. No event of a bus is called so: names of
// events have no `@`.
constexpr std::string_view kFleetNews = "@fleet";

// The name of what a run hears, beside the event itself, when it comes from a robot of the fleet.
inline std::string fleet_event(std::string_view event, std::string_view from) {
    return "@fleet " + std::string(event) + " " + std::string(from);
}

class Fleet {
public:
    Fleet() = default;
    Fleet(const Fleet&) = delete;
    Fleet& operator=(const Fleet&) = delete;
    virtual ~Fleet() = default;

    // Asks the keeper; 0: too many questions at once.
    virtual uint64_t ask(keeper::Request request) = 0;
    // How the question has ended, once; nothing: it has not.
    virtual std::optional<keeper::Over> answer(uint64_t number) = 0;
    // Nobody waits for it any more.
    virtual void cancel(uint64_t number) = 0;
    // Whether the lease of that term is this robot's, by its own clock, now.
    virtual bool holds(keeper::Term term) const = 0;
    // As the fleet told it last; nothing: nobody has written it.
    virtual std::optional<keeper::Shared> shared(const std::string& key) const = 0;
    // Robots that are online, this one among them: "r2" before "r10".
    virtual std::vector<std::string> online() const = 0;
    virtual std::string me() const = 0;
    // To all who watch this robot: the value of a variable of its plan.
    virtual void tell(const std::string& name, std::vector<int16_t> values) = 0;
};

}  // namespace vagus::toolbox
