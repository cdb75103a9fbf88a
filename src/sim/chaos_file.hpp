// Faults as JSON (docs/formats.md, "Faults"): a list, by itself or under the key "chaos" of another
// file, as a test file is one.
//
//     const Chaos chaos = TRY(read_chaos(text, "storm.chaos.json"));
//     const std::string list = format_chaos(chaos.faults);
//     Chaos of_a_test;
//     read_chaos(list_of_its_file, of_a_test, complaints);
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/json_object.hpp"
#include "base/result.hpp"
#include "sim/chaos.hpp"

namespace vagus::sim {

// The Error reads "FILE:LINE:COL: sentence". Whether the nodes and sensors are there, the world
// checks.
Result<Chaos> read_chaos(std::string_view text, const std::string& file);
// Of the list alone, whose file is read by others.
void read_chaos(const JsonValue& list, Chaos& into, Complaints& complaints);

// One line; what is as it is unless said is left out.
std::string format_chaos(const std::vector<ChaosFault>& faults);

}  // namespace vagus::sim
