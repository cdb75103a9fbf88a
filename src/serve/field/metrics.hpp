// What /metrics shows: the text form of Prometheus (exposition format 0.0.4).
#pragma once

#include <string>

#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

// What the service counts beside the workbench.
struct ServiceFigures {
    std::string version;    // of the program
    bool ready = false;     // everything runs
    size_t missing = 0;     // nodes that are waited for
    double late_worst = 0;  // seconds by which the server itself came late, since the last text
    uint32_t deployed = 0;  // the version that runs; 0: the folder as it was given
    uint64_t deployments = 0, refused = 0, rolled_back = 0;
};

std::string metrics_text(const Figures& figures, const ServiceFigures& service);

}  // namespace vagus::serve
