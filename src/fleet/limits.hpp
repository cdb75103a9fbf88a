// The numbers of a fleet (docs/fleet.md): what a member sends, keeps and waits for at most.
#pragma once

#include <cstddef>
#include <cstdint>

#include "base/time.hpp"

namespace vagus::fleet {

using namespace std::chrono_literals;

// ---- names and messages ----
constexpr size_t kNameBytesMax = 64;         // of a fleet, robot, group or event, before escaping
constexpr size_t kTopicBytesMax = 1024;      // of any topic
constexpr size_t kPayloadBytesMax = 65'536;  // of any message
constexpr size_t kWordsMax = 258;            // arguments of an event (as on the bus)
constexpr size_t kGroupsMax = 32;            // of a robot
constexpr size_t kEventsMax = 256;           // in `send`; the same in `hear`
constexpr size_t kTellMax = 64;              // variables in `tell`
constexpr size_t kProblemsMax = 10;          // in a state
constexpr size_t kLineBytesMax = 1000;       // of a sentence
constexpr size_t kNodesMax = 128;            // in a description, in an answer

// ---- a roll-out ----
constexpr Duration kHealthyFor = 3s;             // without a fault after its start: it is well
constexpr Duration kHealthyForMax = 30s;         // that a project's own condition must last
constexpr Duration kConditionEvery = 100ms;      // it is looked at
constexpr Duration kConditionToldEvery = 1s;     // what it lacks is told, at most
constexpr size_t kConditionBytesMax = 500;       // of its text
constexpr size_t kConditionWordsMax = kTellMax;  // variables of nodes in it

// ---- connection ----
constexpr Duration kBrokerLostAfter = 5s;   // then a robot does what its project says
constexpr Duration kNameAnswerWithin = 3s;  // who has a name answers within this
constexpr size_t kNameAskersMax = 256;      // who asked for a name that is to be certain first
constexpr Duration kNameAskAgain = 10s;     // of one that stays out, to be known of
constexpr Duration kNameWantedFor = 25s;    // it is said to whom a name is that was asked for
constexpr Duration kNameSettles = 1s;     // of several that claim a name, all but one are out then
constexpr int kKeepAliveSeconds = 5;      // a broker misses us after one and a half of it
constexpr uint32_t kSessionSeconds = 10;  // a broker keeps what comes for us so long

// ---- events ----
constexpr int64_t kEventsASecond = 20;       // of a name, sent or heard; more are counted
constexpr Duration kEventAgeMax = 10s;       // one that could not be sent by then is dropped
constexpr uint32_t kEventAgeSeconds = 10;    // the same, for the broker
constexpr size_t kOutboxMax = 256;           // events that wait; the oldest is dropped
constexpr size_t kEarlyMax = 256;            // heard while a member asks for its name
constexpr size_t kInFlightMax = 20;          // events that were sent and not acknowledged
constexpr size_t kNumbersRemembered = 1024;  // of each robot and epoch
constexpr size_t kSendersRemembered = 2048;  // robots and epochs
constexpr size_t kRatesRemembered = 4096;    // names of events, of all senders

// ---- state and commands ----
constexpr Duration kStateEveryMin = 200ms;  // at most 5 a second
constexpr Duration kStateEveryMax = 2s;     // also if nothing has changed
constexpr Duration kStale = 6s;             // a state that is older says nothing any more
constexpr Duration kVariableEveryMin = 200ms;
constexpr Duration kTellFor = 60s;           // a variable that somebody asked for
constexpr Duration kCommandWithin = 3s;      // a command that comes later is refused
constexpr Duration kDeadlineAheadMax = 10s;  // a deadline further ahead is no deadline
constexpr size_t kCommandsRemembered = 1024;
constexpr Duration kAskAgainEvery = 500ms;  // Stop, until it is answered

}  // namespace vagus::fleet
