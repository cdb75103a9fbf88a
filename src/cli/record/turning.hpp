// `vagus why FILE --turning-point CONDITION`: when something was decided (turning_search.hpp).
//
//     CLI::Option* const turning = add_turning_options(verb, options);
//     exit_code = tell_turning(options);
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "trial/turning.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vagus::cli {

struct TurningOptions {
    std::string file;
    std::string condition;
    std::string robot;  // whose it is, where robots have projects of their own
    int64_t tries = trial::kTriesUsual;
    std::optional<double> until;  // s; empty: the end of the recording
    int64_t at_once = 0;          // 0: as many as there are processors
    std::string results = "turning-point";
    bool json = false;
};

// Gives --turning-point, which the others need.
CLI::Option* add_turning_options(CLI::App& verb, TurningOptions& options);

// Gives the exit code.
int tell_turning(const TurningOptions& options);

}  // namespace vagus::cli
