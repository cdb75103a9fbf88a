// Peer's variables: what is being read from the node and for whom.
#include <algorithm>

#include "debug/peer.hpp"
#include "debug/program_mark.hpp"

namespace vagus::debug {

Result<RequestId> Peer::may_read() const {
    const auto asked = [](const Reading& reading) { return reading.request != RequestId{}; };
    const auto waiting = std::count_if(readings_.begin(), readings_.end(), asked);
    if (static_cast<size_t>(waiting) < kRequestsMax) return out_.new_request();
    return Error{Code::Limit, who() + " has " + std::to_string(kRequestsMax) +
                                  " requests for variables waiting already: wait for its answers"};
}

Result<RequestId> Peer::get(const VariableRange& range) {
    const RequestId id = TRY(may_read());
    read({.purpose = Purpose::Get,
          .request = id,
          .range = range,
          .fetch = Fetch(range.address, range.count)});
    return id;
}

void Peer::write(const VariableRange& range, std::span<const int16_t> values) {
    for (size_t at = 0; at < values.size(); at += wire::kSetVariablesWordsMax) {
        auto write = message_to<wire::SetVariables>(view_.id);
        write.start = static_cast<uint16_t>(range.address + at);
        write.values.count = static_cast<uint16_t>(
            std::min<size_t>(values.size() - at, wire::kSetVariablesWordsMax));
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(at), write.values.count,
                    write.values.values);
        out_.send(write);
    }
}

// The node does not answer SetVariables; reading the same words shows that it got there.
Result<RequestId> Peer::set(const VariableRange& range, std::span<const int16_t> values) {
    const RequestId id = TRY(may_read());
    write(range, values);
    const auto count = static_cast<uint16_t>(values.size());
    read({.purpose = Purpose::Confirm,
          .request = id,
          .range = range,
          .fetch = Fetch(range.address, count)});
    return id;
}

Status Peer::watch(const VariableRange& range, Duration every) {
    if (watches_.size() >= kWatchesMax) {
        return Error{Code::Limit, who() + " has " + std::to_string(kWatchesMax) +
                                      " watched variables already: end one first"};
    }
    watches_.push_back(
        {.range = range, .every = std::max(every, kWatchEveryMin), .next = out_.now, .told = {}});
    tick_watches();
    return Status::done();
}

void Peer::unwatch(std::string_view name) {
    std::erase_if(watches_, [name](const Watch& watch) { return watch.range.name == name; });
}

void Peer::read(Reading reading) {
    reading.fetch.ask(out_, view_.id);
    readings_.push_back(std::move(reading));
}

void Peer::receive_variables(const wire::Variables& reply) {
    std::vector<Reading> waiting, done;
    for (Reading& reading : readings_) {
        reading.fetch.receive(reply);
        (reading.fetch.complete() ? done : waiting).push_back(std::move(reading));
    }
    readings_ = std::move(waiting);
    for (const Reading& reading : done) arrived(reading);
}

void Peer::arrived(const Reading& reading) {
    switch (reading.purpose) {
        case Purpose::Get:
            out_.tell(view_.id, VariablesArrived{reading.request, reading.range.name,
                                                 reading.range.first, reading.fetch.values()});
            return out_.tell(view_.id, RequestDone{reading.request, std::nullopt, ""});
        case Purpose::Confirm:
            return out_.tell(view_.id, RequestDone{reading.request, std::nullopt, ""});
        case Purpose::Watch:
            return watched(reading);
        case Purpose::Condition:
            return condition_word(reading);
        case Purpose::Program:
            return program_told(reading);
    }
}

void Peer::failed(const Reading& reading) {
    const Error error{Code::Timeout, who() +
                                         " did not answer when it was asked for its variables " +
                                         std::to_string(kFetchTriesMax) + " times"};
    switch (reading.purpose) {
        case Purpose::Get:
        case Purpose::Confirm:
            return out_.tell(view_.id, RequestDone{reading.request, error, ""});
        case Purpose::Program:
            if (reading.request == RequestId{}) return out_.tell(view_.id, ProgramUntold{});
            return out_.tell(view_.id, RequestDone{reading.request, error, ""});
        case Purpose::Watch:
            for (Watch& watch : watches_) {
                if (watch.range.name == reading.range.name) watch.asked = false;
            }
            return;
        case Purpose::Condition:
            if (reading.condition_number == condition_asked_) control_.condition_read(error);
            return;
    }
}

void Peer::watched(const Reading& reading) {
    for (Watch& watch : watches_) {
        if (watch.range.name != reading.range.name ||
            watch.range.address != reading.range.address) {
            continue;
        }
        watch.asked = false;
        watch.next = out_.now + watch.every;
        if (watch.told == reading.fetch.values()) continue;
        watch.told = reading.fetch.values();
        out_.tell(view_.id, VariableChanged{watch.range.name, watch.told});
    }
}

// ---- which program the node runs ----

Result<RequestId> Peer::ask_program() {
    if (!mark_address(view_.target)) {
        return Error{Code::NotFound, who() +
                                         " has no variable \"_program\": it cannot tell which "
                                         "program it runs; load it again if in doubt"};
    }
    const RequestId id = TRY(may_read());
    read_program(id);
    return id;
}

void Peer::read_program(RequestId request) {
    read({.purpose = Purpose::Program,
          .request = request,
          .range = {},
          .fetch = Fetch(*mark_address(view_.target), 2)});
}

void Peer::program_told(const Reading& reading) {
    const auto low = static_cast<uint16_t>(reading.fetch.values()[0]);
    const auto high = static_cast<uint16_t>(reading.fetch.values()[1]);
    const uint32_t mark = low | uint32_t{high} << 16;
    view_.told_program = mark;
    out_.tell(view_.id, ProgramTold{mark});
    if (reading.request == RequestId{}) return control_.returned_with(mark);
    out_.tell(view_.id, RequestDone{reading.request, std::nullopt, ""});
}

// An answer that is still to come may be of the program before.
bool Peer::forget_told_program() {
    view_.told_program.reset();
    const auto forgotten = std::erase_if(readings_, [](const Reading& reading) {
        return reading.purpose == Purpose::Program && reading.request == RequestId{};
    });
    return forgotten > 0;
}

// The node is paused at a breakpoint with a condition: its variables are read, each once.
void Peer::read_condition() {
    const Condition* condition = control_.wanted_condition();
    if (condition == nullptr || control_.condition_number() == condition_asked_) return;
    condition_asked_ = control_.condition_number();
    const std::vector<aesl::VariablePlace> variables = condition->variables();
    condition_values_.assign(variables.size(), {});
    condition_missing_ = variables.size();
    std::erase_if(readings_, [](const Reading& r) { return r.purpose == Purpose::Condition; });
    for (size_t i = 0; i < variables.size(); i++) {
        read({.purpose = Purpose::Condition,
              .range = {},
              .condition_number = condition_asked_,
              .variable = i,
              .fetch = Fetch(variables[i].address, variables[i].size)});
    }
}

void Peer::condition_word(const Reading& reading) {
    if (reading.condition_number != condition_asked_) return;
    condition_values_[reading.variable] = reading.fetch.values();
    if (--condition_missing_ == 0) control_.condition_read(condition_values_);
}

void Peer::tick_readings() {
    std::vector<Reading> waiting, lost;
    for (Reading& reading : readings_) {
        const bool hope = out_.now < reading.fetch.deadline() || reading.fetch.ask(out_, view_.id);
        (hope ? waiting : lost).push_back(std::move(reading));
    }
    readings_ = std::move(waiting);
    for (const Reading& reading : lost) failed(reading);
}

void Peer::tick_watches() {
    if (!view_.connected) return;
    for (Watch& watch : watches_) {
        if (watch.asked || out_.now < watch.next) continue;
        watch.asked = true;
        read({.purpose = Purpose::Watch,
              .range = watch.range,
              .fetch = Fetch(watch.range.address, watch.range.count)});
    }
}

}  // namespace vagus::debug
