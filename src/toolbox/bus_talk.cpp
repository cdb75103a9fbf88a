#include "toolbox/bus_talk.hpp"

#include <fmt/format.h>

#include "toolbox/bus.hpp"

namespace vagus::toolbox {

using run::BusEvent;
using run::CodeError;

namespace {

// So much longer than its grace time code waits for an answer: it must not give up first.
constexpr Duration kBeyondGrace = std::chrono::milliseconds(100);

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

BusTalk::BusTalk(run::ActorContext& context, const Parts& parts,
                 const std::vector<NodeNames>& nodes, std::vector<std::string> hears)
    : context_(context), token_(token_of(context.number())) {
    for (const NodeNames& names : nodes) {
        working_.push_back(find_node(names, parts));
        hears.push_back(node_left(working_.back()));
    }
    context.listen(std::move(hears));
}

void BusTalk::say(const std::string& event, const std::vector<int16_t>& words) {
    BusEvent said{event, {token_}};
    said.arguments.insert(said.arguments.end(), words.begin(), words.end());
    context_.emit(std::move(said));
}

std::optional<BusEvent> BusTalk::hear(Duration at_most) {
    std::optional<BusEvent> event = context_.next_event(at_most);
    if (!event) return std::nullopt;
    if (const auto left = leaver(*event)) throw CodeError(has_left(*left));
    if (!is_mine(*event)) return std::nullopt;
    event->arguments.erase(event->arguments.begin());
    return event;
}

void BusTalk::stop(const std::string& event, const std::string& answer, Duration grace) {
    say(event);
    const Time end = context_.now() + grace + kBeyondGrace;
    for (;;) {
        const std::optional<BusEvent> heard = context_.linger_event(end - context_.now());
        if (!heard || (heard->name == answer && is_mine(*heard))) return;
        if (const auto left = leaver(*heard)) context_.log(has_left(*left));
    }
}

std::optional<std::string> BusTalk::leaver(const BusEvent& event) const {
    for (const std::string& node : working_) {
        if (event.name == node_left(node)) return node;
    }
    return std::nullopt;
}

bool BusTalk::is_mine(const BusEvent& event) const {
    return !event.arguments.empty() && event.arguments.front() == token_;
}

}  // namespace vagus::toolbox
