// What the server and the process that runs tests for it (`vagus test-host`) say to each other:
// kinds of packets, whose bytes are those of trial/told.hpp.
//
//     child.pipe().send(kTestsOrdered, trial::format_order(order));
//     for (const Packet& packet : child.pipe().receive())
//         if (packet.kind == kSeedTold) take(trial::read_seed(packet.bytes));
//
// The process ends when all seeds are told.
#pragma once

namespace vagus::serve {

constexpr char kTestsOrdered = 1;  // to it, once: TestOrder
constexpr char kTestsPlanned = 2;  // from it, once, first: of each test
constexpr char kSeedTold = 3;      // from it, for each seed as it ends

}  // namespace vagus::serve
