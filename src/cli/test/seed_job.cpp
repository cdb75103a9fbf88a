#include "cli/test/seed_job.hpp"

#include <filesystem>
#include <string_view>
#include <utility>

#include "base/file.hpp"
#include "cli/output.hpp"
#include "mcap/records.hpp"
#include "trial/trial.hpp"

namespace vagus::cli {

namespace {

constexpr char kDone = '=', kInvalid = '!';  // what a process begins its text with

}  // namespace

std::string work_seed(const trial::TestFile& test, uint64_t seed, const SeedWork& work) {
    const auto outcome = trial::run_trial(test, seed, {.scripts = work.scripts});
    if (!outcome.ok()) return kInvalid + outcome.error().what;
    std::string recording;
    if (!outcome.value().as_expected()) {
        std::error_code error;
        std::filesystem::create_directories(std::filesystem::path(work.recording).parent_path(),
                                            error);
        recording = work.recording;
        const auto again = trial::run_trial(test, seed, {.record = recording});
        if (!again.ok()) {
            complain(again.error());
            recording.clear();
        }
    }
    return kDone + recording + "\n" + trial::format_outcome(outcome.value());
}

void delete_half_recording(const std::string& path) {
    if (is_file_of_another_kind(path, mcap::kMagic)) return;
    {
        const auto file = MappedFile::open(path);
        if (!file.ok()) return;  // there is none
        const std::string_view bytes = file.value().bytes();
        if (bytes.size() > mcap::kMagic.size() && bytes.ends_with(mcap::kMagic)) return;
    }
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
}

SeedDone read_seed_work(uint64_t seed, JobResult job) {
    SeedDone done{.result = {.seed = seed, .trouble = std::move(job.trouble)}};
    trial::SeedResult& result = done.result;
    result.seconds = job.seconds;
    const std::string& text = job.text;
    if (!result.trouble.empty()) return done;
    if (text.starts_with(kInvalid)) {
        done.refused = text.substr(1);
        return done;
    }
    const size_t line = text.find('\n');
    if (!text.starts_with(kDone) || line == std::string::npos) {
        result.trouble = "its process said nothing";
        return done;
    }
    result.recording = text.substr(1, line - 1);
    result.outcome = trial::read_outcome(std::string_view(text).substr(line + 1));
    return done;
}

}  // namespace vagus::cli
