// One run on two tapes: recorded, and compared with what it was.
//
//     BothTapes both(compared, *file);
//     TRY(rerun->run(both));
#pragma once

#include <utility>
#include <vector>

#include "record/topics.hpp"

namespace vagus::record {

class BothTapes final : public Tape {
public:
    // Borrowed.
    BothTapes(Tape& first, Tape& second) : first_(first), second_(second) {}

    uint16_t declare(const Topic& topic) override {
        numbers_.emplace_back(first_.declare(topic), second_.declare(topic));
        return static_cast<uint16_t>(numbers_.size());
    }
    void put(uint16_t topic, Time at, std::string_view data) override {
        const auto [first, second] = numbers_[topic - 1u];
        first_.put(first, at, data);
        second_.put(second, at, data);
    }
    // Worded at once: both need it.
    void put_later(uint16_t topic, Time at, size_t, Word word) override { put(topic, at, word()); }

private:
    Tape& first_;
    Tape& second_;
    std::vector<std::pair<uint16_t, uint16_t>> numbers_;  // of a topic there
};

}  // namespace vagus::record
