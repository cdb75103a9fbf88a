// A plan on a bus runs in real time, on a thread of its own. What it does comes as values, to
// a caller that asks now and then.
//
//     BusRun running(prepared, debugger);
//     while (!running.over()) for (const plan::TraceEvent& event : running.take()) see(event);
#pragma once

#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "embed/prepared_run.hpp"
#include "plan/trace.hpp"
#include "run/debugger.hpp"
#include "serve/talk/news.hpp"

namespace vagus::serve {

class BusRun {
public:
    // Begins. Both are borrowed.
    BusRun(embed::PreparedRun& prepared, run::Debugger& debugger);
    // Waits for the end.
    ~BusRun();

    // Ask first, then take(): what is taken then is the last.
    bool over();
    std::vector<plan::TraceEvent> take();
    // What a person should know: of others on the bus, and why the plan could not run.
    struct Line {
        talk::LineKind kind;
        std::string text;
    };
    std::vector<Line> take_lines();

private:
    void say(talk::LineKind kind, const std::string& text);

    std::mutex mutex_;  // guards what follows
    std::vector<plan::TraceEvent> seen_;
    std::vector<Line> lines_;
    bool over_ = false;
    std::thread runner_;
};

}  // namespace vagus::serve
