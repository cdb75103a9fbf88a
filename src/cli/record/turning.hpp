// `vagus why FILE --turning-point CONDITION`: when something was decided (turning_search.hpp).
//
//     CLI::Option* const turning = add_turning_options(verb, options);
//     exit_code = tell_turning(options);
#pragma once

#include <optional>
#include <string>

#include "cli/record/turning_search.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vagus::cli {

struct TurningOptions {
    TurningSearch search;
    std::string condition;
    std::optional<double> until;  // s; empty: the end of the recording
    bool json = false;
};

// Gives --turning-point, which the others need.
CLI::Option* add_turning_options(CLI::App& verb, TurningOptions& options);

// Gives the exit code.
int tell_turning(const TurningOptions& options);

}  // namespace vagus::cli
