// One run, in a process of its own: a world, its nodes, its bus and a plan on one clock that is
// paced by the wall clock. It hears what to do (serve/talk/orders.hpp), and tells all there is to
// see (serve/talk/news.hpp), over a socket pair.
//
//     vagus run-host      (not for people: the studio starts it)
#pragma once

#include <string>

#include "serve/process.hpp"

namespace vagus::serve {

constexpr int kExitNonsense = 2;  // what it was told is not what a server says

// How the process ends.
struct RunnerEnd {
    int status = 0;   // its exit status
    std::string why;  // one line for stderr; empty: the other end has closed, and all is well
};

// Until the other end closes, or sends what is no order: then the plan is ended, too.
RunnerEnd run_runner(Pipe pipe);

}  // namespace vagus::serve
