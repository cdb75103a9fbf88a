// What happens to a node during a run of `vagus exec`, and in the golden cases
// (testdata/golden/aesl/README.md): variables are set, events arrive.
//
//     { "stimuli": [{ "event": "tick" }, { "set": { "sensor.prox": [9, 0, 9, 9] } }] }
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace vagus::aesl {

constexpr size_t kStimuliMax = 100'000;

struct Assignment {
    std::string variable;
    std::vector<int16_t> words;
};

// Applied in this order: variables are set, then the event happens.
struct Stimulus {
    std::vector<Assignment> set;
    std::string event;               // empty: none
    std::vector<int16_t> arguments;  // to the first words of the third variable, the rest stays
    std::optional<int16_t> source;   // to the second variable
};

// Reads `stimuli` of an object; a whole expected file of the golden cases will do. None is no
// stimuli.
Result<std::vector<Stimulus>> parse_stimuli(std::string_view text, std::string_view file);

}  // namespace vagus::aesl
