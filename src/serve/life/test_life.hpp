// For tests: a life of a run with everything around it scripted.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "serve/life/life.hpp"

namespace vagus::test {}

namespace vagus::serve::test {

using namespace vagus::test;  // what tests of all modules have
using namespace life;         // of tests only
using State = Life::State;

inline std::string word(const Action& action) {
    static constexpr const char* kWords[] = {
        "open-runner", "connect", "load",        "let-go", "begin",    "continue",   "step",
        "pause",       "rest",    "pause-nodes", "count",  "end-plan", "stop-nodes", "make-safe",
        "disconnect",  "leaving", "answer",      "stood",  "tell",     "end-runner", "scripts"};
    return kWords[action.index()];
}

// A life with everything around it scripted: runners open and nodes answer when they are told to.
struct Bench {
    Life life;
    Time now{};
    CallNumber calls = 0;
    std::map<CallNumber, int> answers;  // of each command
    std::map<CallNumber, Answer> said;
    std::vector<End> ends;
    uint64_t load = 0, go = 0, stop = 0;  // what was asked for last
    bool runner = false;
    bool asked = true;  // somebody wants that something runs
    std::string did;    // words of what was done since the last look

    std::string take(const Input& input) {
        std::string all;
        for (const Action& action : life.take(input, now)) all += note(action);
        return all;
    }
    std::string pass(Duration time, bool silent = false) {
        now += time;
        std::string all;
        for (const Action& action : life.tick(now, silent)) all += note(action);
        return all;
    }
    CallNumber call() {
        answers[++calls] = 0;
        return calls;
    }
    // A start of the scripts in a world, to its end.
    void run_world(bool plan = false) {
        take(Start{call(), plan, true});
        take(Opened{});
        take(Described{});
        take(Loaded{load});
        ASSERT_EQ(life.state(), State::Running);
    }
    void run_bus_plan() {
        take(Joined{});
        take(Start{call(), true});
        take(Stopped{stop, {{{1, "drive", StopNode::State::Stopped}}}});
        take(Loaded{load});
        take(Opened{});
        take(Went{go});
        ASSERT_EQ(life.state(), State::Running);
    }

    std::string note(const Action& action) {
        if (const auto* answer = std::get_if<Answer>(&action)) {
            ++answers[answer->call];
            said[answer->call] = *answer;
        }
        if (const auto* stood = std::get_if<AnswerStop>(&action)) ++answers[stood->call];
        if (const auto* leaving = std::get_if<GoOnLeaving>(&action)) ++answers[leaving->call];
        if (const auto* told = std::get_if<Tell>(&action)) {
            if (!told->again) ends.push_back(told->end);
        }
        if (const auto* loads = std::get_if<LoadNodes>(&action)) load = loads->start;
        if (const auto* goes = std::get_if<LetNodesGo>(&action)) go = goes->start;
        if (const auto* stops = std::get_if<StopNodes>(&action)) stop = stops->number;
        if (const auto* safe = std::get_if<MakeSafe>(&action); safe && safe->number != 0) {
            stop = safe->number;
        }
        if (std::holds_alternative<OpenRunner>(action)) runner = true;
        if (std::holds_alternative<Disconnect>(action)) runner = false;
        return word(action) + " ";
    }
};

inline StopReport stood() {
    return {{{1, "drive", StopNode::State::Stopped}}};
}

}  // namespace vagus::serve::test
