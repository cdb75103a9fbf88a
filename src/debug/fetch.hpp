// Reads a range of a node's memory: asks in pieces that fit a reply, puts together what comes in
// any number of Variables messages (wireless nodes split theirs, wire spec 1.3), asks again for
// what is missing.
#pragma once

#include <cstdint>
#include <vector>

#include "debug/outbox.hpp"

namespace vagus::debug {

constexpr int kFetchTriesMax = 3;
constexpr Duration kFetchRetry = std::chrono::milliseconds(1000);  // 3 tries: kAnswerWithin

class Fetch {
public:
    Fetch(uint16_t start, uint16_t count) : start_(start), values_(count), arrived_(count) {}

    // Asks for all that is missing. False: kFetchTriesMax are used up.
    bool ask(Outbox& out, NodeId id);
    void receive(const wire::Variables& reply);

    bool complete() const { return have_ == values_.size(); }
    Time deadline() const { return deadline_; }
    const std::vector<int16_t>& values() const { return values_; }

private:
    uint16_t start_;
    std::vector<int16_t> values_;
    std::vector<bool> arrived_;
    size_t have_ = 0;
    int tries_ = 0;
    Time deadline_{};
};

}  // namespace vagus::debug
