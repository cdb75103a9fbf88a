// What the server and the process that looks for a turning point for it (`vagus turning-host`) say
// to each other, as JSON.
//
//     child.pipe().send(kTurningAsked, format_turning_asked({.file = "run-3.mcap", …}));
//     // {"stage":"curve","done":40,"of":640}, now and then, and then either
//     // {"sentence":"it turned …","found":{…}}, as of `vagus why --turning-point --json`, or
//     // {"error":"…"}
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace vagus::serve {

constexpr char kTurningAsked = 1;     // to it, once
constexpr char kTurningProgress = 2;  // from it
constexpr char kTurningAnswered = 3;  // from it, once, last

struct TurningAsked {
    std::string file = {};  // the recording
    std::string condition = {};
    int tries = 0;
    std::string results = {};  // the folder for the recordings of two continuations
};
std::string format_turning_asked(const TurningAsked& asked);
// Nothing: it is no question.
std::optional<TurningAsked> read_turning_asked(const std::string& text);

// The run as it was; the curve; the instant at which it turned; two continuations are recorded.
constexpr std::string_view kTurningStages[] = {"run", "curve", "narrowing", "recordings"};
struct TurningProgress {
    std::string_view stage = kTurningStages[0];
    size_t done = 0, of = 0;  // continuations
};
std::string format_progress(const TurningProgress& progress);

struct TurningFound {
    std::string sentence = {};
    std::string json = {};  // an object
};
std::string format_turning_found(const TurningFound& found);
std::string format_turning_refused(const std::string& why);

}  // namespace vagus::serve
