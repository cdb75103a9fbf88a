// How an actor's code talks with the nodes that work for it: each event carries the token of this
// activation, so what belongs to an earlier one is not heard (P14 over a bus on which messages
// cross). For templates in C++ and for those of toolbox files alike.
//
//     BusTalk range(context, parts, {{"range"}}, {"range.measured"});
//     range.say("range.look", {450});
//     while (!range.hear(run::kNever)) {}
//
// A node that is not there, or leaves, is a CodeError that names it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "run/code.hpp"
#include "toolbox/parts.hpp"

namespace vagus::toolbox {

// The token of a running number: its low 15 bits.
int16_t token_of(uint64_t number);

// Names of nodes that can do the same work: the first that is on the bus does it.
using NodeNames = std::vector<std::string>;

// The first of `nodes` that is on the bus (just the first, if nobody knows the bus). The CodeError
// says which are there.
std::string find_node(const NodeNames& nodes, const Parts& parts);

// "the node "drive", which does the work, has left the bus"
std::string has_left(std::string_view node);

class BusTalk {
public:
    // The code works on all of `nodes` and hears the events `hears`. Both are borrowed until the
    // code ends.
    BusTalk(run::ActorContext& context, const Parts& parts, const std::vector<NodeNames>& nodes,
            std::vector<std::string> hears);

    // Emits the event with the token and these words behind it.
    void say(const std::string& event, const std::vector<int16_t>& words = {});
    // The next event for this activation, without its token; nothing when the time is over first,
    // or perhaps before. Throws Stop.
    std::optional<run::BusEvent> hear(Duration at_most);
    // When Stop has been thrown: tells a node to stop, and waits for its answer while the grace
    // time lasts; the executor judges whether that was in time (P27a).
    void stop(const std::string& event, const std::string& answer, Duration grace);

private:
    std::optional<std::string> leaver(const run::BusEvent& event) const;
    bool is_mine(const run::BusEvent& event) const;

    run::ActorContext& context_;
    int16_t token_;
    std::vector<std::string> working_;  // the nodes that were found
};

}  // namespace vagus::toolbox
