// The options of `vagus plan run`, of `plan debug` and of generated programs: one table, from which
// each command line is made, and the words that were given.
//
//     RunWords words;
//     for (const RunOption& option : run_options()) …     // name, help, where its value goes
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"

namespace vagus::embed {

// As they are on the command line; empty: not given.
struct RunWords {
    std::vector<std::string> toolboxes = {};
    std::vector<std::string> set = {};
    std::string from = {};   // the actor that it begins with, instead of the plan's start
    std::string clock = {};  // real or virtual (real)
    std::string seed = {};   // of the plan (1) and of the world (that of its file)
    std::string max_time = {};
    std::string answers = {};  // a JSON file: how code answers instead of working
    std::string trace = {};    // a file, or - for stdout
    std::string world = {};
    std::string robot = {};  // of the world
    std::vector<std::string> poses = {};
    std::string chaos = {};      // what breaks in the world: read_chaos_words()
    std::string threads = {};    // that sense and run the scripts of the world
    std::string trace_all = {};  // the trace with what happens in the world
    std::string listen = {};     // where the bus of the world is open for others
    std::string bus = {};        // a target (docs/formats.md)
    std::string project = {};    // an .aesl: names of events for `bus`

    // Then stdout is for the trace alone, and all else is said on stderr: it is for one reader.
    bool traces_on_stdout() const { return trace == "-" || trace_all == "-"; }
};

struct RunOption {
    std::string_view name;   // "--clock"
    std::string_view value;  // what stands for its value in help: "NAME=VALUE"
    std::string_view help;
    std::string RunWords::*one = nullptr;  // where its value goes; the last one holds …
    std::vector<std::string> RunWords::*many = nullptr;  // … or all
    std::vector<std::string> choices = {};               // it is one of these
    std::vector<std::string> endings = {};               // of the file that it names
};

const std::vector<RunOption>& run_options();

// The Error names two words that do not go together.
Status check_words(const RunWords& words);

// A line for each, for the help of a program.
std::string describe_run_options();

}  // namespace vagus::embed
