// How an actor's code talks with the nodes that work for it: each event carries the token of this
// activation, so what belongs to an earlier one is not heard (P14 over a bus on which messages
// cross). For templates in C++ and for those of toolbox files alike.
//
//     BusTalk range(context, parts, {{"range"}}, {"range.measured"});
//     range.say("range.look", {450});
//     while (!range.hear(run::kNever)) {}
//
// A node that is not there, or leaves, is a CodeError that names it; so is one that says by the
// event `ended` that it does not do this work any more. A project need not declare that event.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "run/code.hpp"
#include "toolbox/parts.hpp"

namespace vagus::toolbox {

// In place of a token: a node was reset, and does not know any more whose work has ended.
constexpr int16_t kForgottenToken = -1;

// The token of a running number: its low 15 bits.
int16_t token_of(uint64_t number);

// Names of nodes that can do the same work: the first that is on the bus does it.
using NodeNames = std::vector<std::string>;

// The first of `nodes` that is on the bus (just the first, if nobody knows the bus). The CodeError
// says which are there.
std::string find_node(const NodeNames& nodes, const Parts& parts);

// "the node "drive", which does the work, has left the bus"
std::string has_left(std::string_view node);

// "the node "drive", which does the work, was stopped by somebody else, …"
std::string was_stopped(std::string_view node);

// A node whose program was stopped does no work. The host that stopped it may be about to stop the
// plan, too, or to let the node run again; after this nobody does. That it was stopped before the
// code began, BusNodes tells.
constexpr Duration kStoppedMax = std::chrono::seconds(3);

class BusTalk {
public:
    // The code works on all of `nodes` and hears the events `hears`, and `ended` if that is not
    // empty. All are borrowed until the code ends.
    BusTalk(run::ActorContext& context, const Parts& parts, const std::vector<NodeNames>& nodes,
            std::vector<std::string> hears, std::string ended = {});

    // Emits the event with the token and these words behind it.
    void say(const std::string& event, const std::vector<int16_t>& words = {});
    // The next event for this activation, without its token; nothing when the time is over first,
    // or perhaps before. Throws Stop; and a CodeError if a node has left, has ended the work by
    // itself, or is stopped for kStoppedMax.
    std::optional<run::BusEvent> hear(Duration at_most);
    // When Stop has been thrown: tells a node to stop, and waits for its answer while the grace
    // time lasts; the executor judges whether that was in time (P27a). A node whose program was
    // stopped has stopped, and cannot answer.
    void stop(const std::string& event, const std::string& answer, Duration grace);

private:
    std::optional<std::string> leaver(const run::BusEvent& event) const;
    bool is_mine(const run::BusEvent& event) const;
    void note_state(const run::BusEvent& event);
    void note_stopped(const std::string& node);
    Duration patience() const;
    bool ends(const run::BusEvent& event) const;

    run::ActorContext& context_;
    int16_t token_;
    std::string ended_;
    std::vector<std::string> working_;  // the nodes that were found
    std::set<std::string> stopped_;     // those of them whose programs were stopped
    Time stopped_at_{};                 // the first of those
};

}  // namespace vagus::toolbox
