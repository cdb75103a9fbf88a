// Notices a plan that does nothing but fire: one supervisor raises the same event again and again,
// and no actor gets on with its work in between. Made of the lines of the trace alone, so that
// every kind of run can have one; the trace stays as it is.
//
//     Firing firing;
//     if (const auto sentence = firing.see(event)) tell(*sentence);   // once in a run
#pragma once

#include <map>
#include <optional>
#include <string>
#include <tuple>

#include "base/time.hpp"
#include "plan/trace.hpp"

namespace vagus::run {

constexpr int kFiringsMax = 100;  // of one event; then it is said
// An actor that has run for longer has done something. (One that is a plan counts by its actors.)
constexpr Duration kFiringWorkMin = std::chrono::milliseconds(100);

class Firing {
public:
    // The sentence names the supervisor, the event and the ways out.
    std::optional<std::string> see(const plan::TraceEvent& event);

private:
    struct Running {
        Time since{};
        bool is_plan = false;
        bool worked = false;  // so it was noted at an event while it ran
    };
    using Event = std::tuple<std::string, std::string, std::string>;  // plan, supervisor, event

    void note_work(Time now);
    std::optional<std::string> count(const plan::TraceEvent& line, const plan::EventRaised& raised);

    std::map<std::string, Running> running_;  // by the path of its plan
    std::map<Event, int> counts_;             // since an actor has done something
    bool said_ = false;
};

}  // namespace vagus::run
