#include "toolbox/bus_talk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "toolbox/bus.hpp"

namespace vagus::toolbox {

using run::BusEvent;
using run::CodeError;

namespace {

// So much longer than its grace time code waits for an answer: it must not stop waiting first.
constexpr Duration kBeyondGrace = std::chrono::milliseconds(100);

std::string has_ended(const std::vector<std::string>& nodes) {
    return fmt::format(
        "the node \"{}\" has ended the work by itself: its script was stopped, "
        "paused or loaded again, another command took its place, or it heard no sign of life for "
        "too long; "
        "start the plan again",
        fmt::join(nodes, "\" or \""));
}

}  // namespace

int16_t token_of(uint64_t number) {
    return static_cast<int16_t>(number & 0x7fff);
}

std::string find_node(const NodeNames& nodes, const Parts& parts) {
    if (!parts.bus) return nodes.front();
    for (const std::string& node : nodes) {
        if (parts.bus->has(node)) return node;
    }
    const std::string there = parts.bus->list();
    throw CodeError(fmt::format("the node \"{}\", which does the work, is not on the bus; {}",
                                fmt::join(nodes, "\" or \""),
                                there.empty() ? "no node is" : "there are: " + there));
}

std::string has_left(std::string_view node) {
    return fmt::format("the node \"{}\", which does the work, has left the bus", node);
}

std::string was_stopped(std::string_view node) {
    return fmt::format(
        "the node \"{}\", which does the work, was stopped by somebody else (stop, pause or "
        "reset), or by a fault of its script, and nobody has let it run again for {} s; find out "
        "why, and start the plan again",
        node, std::chrono::duration_cast<std::chrono::seconds>(kStoppedMax).count());
}

BusTalk::BusTalk(run::ActorContext& context, const Parts& parts,
                 const std::vector<NodeNames>& nodes, std::vector<std::string> hears,
                 std::string ended)
    : context_(context), token_(token_of(context.number())), ended_(std::move(ended)) {
    for (const NodeNames& names : nodes) {
        working_.push_back(find_node(names, parts));
        for (const auto& name : {node_left, node_stopped, node_runs}) {
            hears.push_back(name(working_.back()));
        }
    }
    if (!ended_.empty()) hears.push_back(ended_);
    context.listen(std::move(hears));
    // What was told before that is not heard any more; what is told twice does no harm.
    for (const std::string& node : working_) {
        if (parts.bus && parts.bus->is_stopped(node)) note_stopped(node);
    }
}

void BusTalk::say(const std::string& event, const std::vector<int16_t>& words) {
    BusEvent said{event, {token_}};
    said.arguments.insert(said.arguments.end(), words.begin(), words.end());
    context_.emit(std::move(said));
}

std::optional<BusEvent> BusTalk::hear(Duration at_most) {
    std::optional<BusEvent> event = context_.next_event(std::min(at_most, patience()));
    if (patience() <= Duration{}) throw CodeError(was_stopped(*stopped_.begin()));
    if (!event) return std::nullopt;
    if (const auto left = leaver(*event)) throw CodeError(has_left(*left));
    note_state(*event);
    if (ends(*event)) throw CodeError(has_ended(working_));
    if (!is_mine(*event)) return std::nullopt;
    event->arguments.erase(event->arguments.begin());
    return event;
}

void BusTalk::stop(const std::string& event, const std::string& answer, Duration grace) {
    say(event);
    const Time end = context_.now() + grace + kBeyondGrace;
    while (stopped_.size() < working_.size()) {
        const std::optional<BusEvent> heard = context_.linger_event(end - context_.now());
        if (!heard || ends(*heard) || (heard->name == answer && is_mine(*heard))) return;
        if (const auto left = leaver(*heard)) context_.log(has_left(*left));
        note_state(*heard);
    }
}

void BusTalk::note_state(const BusEvent& event) {
    for (const std::string& node : working_) {
        if (event.name == node_stopped(node)) note_stopped(node);
        if (event.name == node_runs(node)) stopped_.erase(node);
    }
}

void BusTalk::note_stopped(const std::string& node) {
    if (stopped_.empty()) stopped_at_ = context_.now();
    stopped_.insert(node);
}

// How long a stopped node is still waited for.
Duration BusTalk::patience() const {
    return stopped_.empty() ? run::kNever : stopped_at_ + kStoppedMax - context_.now();
}

std::optional<std::string> BusTalk::leaver(const BusEvent& event) const {
    for (const std::string& node : working_) {
        if (event.name == node_left(node)) return node;
    }
    return std::nullopt;
}

bool BusTalk::ends(const BusEvent& event) const {
    if (ended_.empty() || event.name != ended_ || event.arguments.empty()) return false;
    return event.arguments.front() == token_ || event.arguments.front() == kForgottenToken;
}

bool BusTalk::is_mine(const BusEvent& event) const {
    return !event.arguments.empty() && event.arguments.front() == token_;
}

}  // namespace vagus::toolbox
