// Examines a live node over its link: finds it, reads its description, makes all checks, one after
// the other. Nothing that a node does, or does not do, keeps this from ending.
//
//     const std::vector<uint16_t> there = TRY(who_is_there(line));
//     const aesl::Target target = TRY(describe(line, 3));
//     const Report report = examine(line, {.node = 3}, target);
//     print(summary_text(report));  // report_text.hpp
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "aesl/target.hpp"
#include "conformance/check.hpp"
#include "conformance/line.hpp"

namespace vagus::conformance {

// The first node answers ListNodes within the one, each further one within the other behind it:
// then all that are there have.
constexpr Duration kPresenceMost = std::chrono::seconds(5);
constexpr Duration kPresenceWithin = std::chrono::milliseconds(800);
// A description has 300 to 700 CAN frames, and serial lines are slow.
constexpr Duration kDescriptionWithin = std::chrono::seconds(20);
constexpr size_t kNodesMax = 1024;
// All checks take half a minute on a serial line; a node that is slow at each of them has this.
constexpr Duration kTimeLimit = std::chrono::minutes(10);

// The ids of the nodes that answer, in rising order.
Result<std::vector<uint16_t>> who_is_there(Line& line);
// Asks the node what it is.
Result<aesl::Target> describe(Line& line, uint16_t node);

struct Order {
    uint16_t node = 0;
    uint16_t nobody = 0;  // an id that no node has
    bool flash = false;   // also what overwrites the program that the node keeps over a restart
    bool sleep = false;   // also what sends a node to sleep that can
    // So long for all: the checks behind it are not made.
    Duration time_limit = kTimeLimit;
    std::string only;  // checks whose group or name has this in it
    std::function<void(const Row&)> tell = [](const Row&) {};  // each row as it is done
};

struct Report {
    uint16_t node = 0;
    aesl::Target target;
    std::vector<Row> rows;
    size_t foreign = 0;  // commands of another host to this node, heard meanwhile
    // Whether the node was left as Bench::clear() leaves it.
    bool left_clear = false;

    size_t count(Verdict verdict) const;
};

// Some check has this in its group or name.
bool is_any_check(const std::string& only);

Report examine(Line& line, const Order& order, const aesl::Target& target);

}  // namespace vagus::conformance
