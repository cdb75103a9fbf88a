#include "cli/test/test_host.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <thread>
#include <vector>

#include "base/file.hpp"
#include "cli/host_verb.hpp"
#include "cli/output.hpp"
#include "cli/test/seed_job.hpp"
#include "serve/runner/one_answer.hpp"
#include "serve/workbench/test_talk.hpp"
#include "trial/told.hpp"

namespace vagus::cli {

namespace {

namespace fs = std::filesystem;

Result<trial::TestFile> test_of(const std::string& path) {
    const std::string text = TRY(read_file(path));
    return trial::read_test(text, path);
}

class TestHost {
public:
    TestHost(serve::Pipe& pipe, trial::TestOrder order) : pipe_(pipe), order_(std::move(order)) {}

    int run() {
        plan();
        const size_t processors = std::max(1u, std::thread::hardware_concurrency());
        run_jobs(
            jobs_.size(), static_cast<int>(processors), [this](size_t i) { return work(jobs_[i]); },
            [this](size_t i, JobResult job) { return tell(jobs_[i], std::move(job)); });
        return kExitDone;
    }

private:
    struct Job {
        size_t test = 0;
        uint64_t seed = 0;
    };

    void plan() {
        std::vector<trial::PlannedTest> planned;
        for (size_t i = 0; i < order_.tests.size(); ++i) {
            auto test = test_of(order_.tests[i]);
            if (!test.ok()) {
                tests_.emplace_back();
                planned.push_back({.refused = test.error().what});
                continue;
            }
            const trial::SeedRange seeds = test.value().seeds;
            planned.push_back({.seeds = seeds, .world = !test.value().world.empty()});
            tests_.push_back(std::move(test.value()));
            for (uint64_t seed = seeds.first;; ++seed) {
                jobs_.push_back({i, seed});
                if (seed == seeds.last) break;
            }
        }
        refused_.resize(tests_.size());
        send(serve::kTestsPlanned, trial::format_planned(planned));
    }

    // In a process of its own. What one seed is refused, the others are not asked.
    std::string work(const Job& job) const {
        if (refused_[job.test]) return {};
        const trial::TestFile& test = tests_[job.test];
        const std::string stem = fs::path(test.path).filename().replace_extension().stem().string();
        const fs::path file = fs::path(order_.results) / std::to_string(job.test + 1) /
                              fmt::format("{}.seed-{}.mcap", stem, job.seed);
        return work_seed(test, job.seed, {order_.scripts, file.string()});
    }

    bool tell(const Job& job, JobResult its) {
        SeedDone done = read_seed_work(job.seed, std::move(its));
        if (refused_[job.test]) return true;
        refused_[job.test] = !done.refused.empty();
        trial::SeedTold told{.test = job.test,
                             .seed = job.seed,
                             .refused = std::move(done.refused),
                             .trouble = std::move(done.result.trouble),
                             .recording = std::move(done.result.recording)};
        if (told.refused.empty() && told.trouble.empty()) {
            told.failures = trial::failures_of(tests_[job.test], done.result.outcome);
            told.coverage = std::move(done.result.outcome.coverage);
        }
        return send(serve::kSeedTold, trial::format_seed(told));
    }

    bool send(char kind, const std::string& text) { return serve::send_whole(pipe_, kind, text); }

    serve::Pipe& pipe_;
    const trial::TestOrder order_;
    std::vector<trial::TestFile> tests_;  // as ordered
    std::vector<bool> refused_;
    std::vector<Job> jobs_;
};

int run_tests(serve::Pipe pipe) {
    (void)!nice(kTestNice);
    const auto ordered = serve::wait_for_packet(pipe);
    if (!ordered || ordered->kind != serve::kTestsOrdered) return kExitUsage;
    return TestHost(pipe, trial::read_order(ordered->bytes)).run();
}

}  // namespace

void add_test_host(CLI::App& app, int& exit_code) {
    add_host_verb(app, {"test-host", "tests of behaviour for the studio"}, run_tests, exit_code);
}

}  // namespace vagus::cli
