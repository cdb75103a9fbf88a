// A run that is kept as a file, read into a history of its own without running anything: a trace
// (NAME.trace.jsonl), or what a recording says (NAME.mcap) of a run that cannot be run again here,
// as that of a real robot.
//
//     const auto opened = TRY(read_kept_run({.path = "a.trace.jsonl", .real = real}));
//     reply(opened->history.at({.t = 12}));
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "serve/history/history.hpp"

namespace vagus::serve {

constexpr size_t kTraceFileBytes = 32u << 20;                  // as much as a run keeps
constexpr uintmax_t kRecordingFileBytes = uintmax_t{1} << 30;  // of one that is opened as it is

bool is_recording_file(const std::string& path);

// The file, and what it is read with.
struct KeptFile {
    std::string path;  // in the project
    std::string real;  // on this computer
    std::filesystem::file_time_type written{};
    struct Plan {
        std::string real, text, doc;
    };
    std::vector<Plan> plans = {};  // of the project
    // Of a world whose robots have projects of their own: whose plan is shown; empty: that of the
    // first.
    std::string robot = {};
};
struct KeptRun {
    std::string path;
    std::filesystem::file_time_type written{};
    History history = {};
    size_t lines = 0, refused = 0;  // of the trace
    // False: it is of a plan that the project does not have.
    bool has_plan = false;
    std::vector<std::string> robots = {};  // that have projects of their own, of a recording
    std::string robot = {};                // the one of them whose plan it has
    Json scene = {};                       // as the topic scene; null: it is of no world
};
// Seconds, for a long one: uses nothing but the file. The Error names the file, and what in it
// cannot be shown.
Result<std::shared_ptr<KeptRun>> read_kept_run(const KeptFile& file);

}  // namespace vagus::serve
