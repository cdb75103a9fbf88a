// How an actor's code waits for the keeper of its fleet.
//
//     Talk talk(context, parts);
//     const auto reply = talk.ask(keeper::Take{"pick", 10s});   // nothing: nobody answered
#pragma once

#include <optional>
#include <string>

#include "run/code.hpp"
#include "toolbox/fleet/fleet.hpp"
#include "toolbox/parts.hpp"

namespace vagus::toolbox {

constexpr Duration kAskKeeperAgain = std::chrono::seconds(1);  // where it had nothing to give

class Talk {
public:
    // Throws CodeError if there is no fleet.
    Talk(run::ActorContext& context, const Parts& parts);

    Fleet& fleet() { return fleet_; }
    // Waits for the reply; nothing: no keeper answered within keeper::kAskAtMost. Throws Stop; the
    // question is cancelled then.
    std::optional<keeper::Reply> ask(keeper::Request request);
    // The same again every kAskKeeperAgain, as long as it has nothing to give and `at_most` is not
    // over.
    std::optional<keeper::Reply> ask_until(const keeper::Request& request, Duration at_most);
    // Waits until `holds`, looking at each news of the fleet; false: the time was over first.
    template <typename Holds>
    bool wait_until(const Holds& holds, Duration at_most) {
        const Time end = end_of(at_most);
        while (!holds()) {
            if (context_.now() >= end) return false;
            (void)context_.wait_event(kFleetNews, end - context_.now());
        }
        return true;
    }

private:
    Time end_of(Duration at_most) const;

    run::ActorContext& context_;
    Fleet& fleet_;
};

// The fleet, or a CodeError that says what to do without one.
Fleet& fleet_of(const Parts& parts);

// Texts as the JSON that the keeper keeps, and back; what is no text is given as it is written.
std::string json_of_text(const std::string& text);
std::string text_of_json(const std::string& json);

}  // namespace vagus::toolbox
