// The parts of a test that is written from a recording (from_recording.hpp), of a plan's run and of
// a run of scripts alone.
//
//     std::vector<std::string> members = first_members("run.mcap");
//     members.push_back(seeds_member(seed_of(reader, run)));
//     members.push_back(expect_member({std::string(kUntouched), std::string(kTimeWasOver)}));
//     write(test_text(members));
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mcap/reader.hpp"
#include "record/run_file.hpp"

namespace vagus::trial {

// Expectations.
constexpr std::string_view kUntouched =
    R"({ "always": "contact == 0", "help": "touches nothing" })";
constexpr std::string_view kTimeWasOver = R"({ "ends": "MaxTime" })";

std::string last_part(const std::string& path);
// A file of the recording as a test beside that one names it.
std::string beside(const std::string& main, const std::string& name);
// With some room, 1 % of it or finer, so that the numbers are those that a person would write.
double round_up(double seconds);
std::string number(double value);
// Of the run, or of its world; empty: nobody says.
std::string seed_of(const mcap::Reader& reader, const record::RunFile& run);

// Members of the test, each without its comma.
std::vector<std::string> first_members(const std::string& recording);
void add_files(std::vector<std::string>& members, std::string_view key, const std::string& main,
               const std::vector<std::string>& files);
std::string seeds_member(const std::string& seed);
std::string expect_member(const std::vector<std::string>& expectations);
// The file.
std::string test_text(const std::vector<std::string>& members);

// What of the run a test does not do again; `inputs`: what people did.
std::vector<std::string> hints_of(const record::RunFile& run, size_t inputs);

}  // namespace vagus::trial
