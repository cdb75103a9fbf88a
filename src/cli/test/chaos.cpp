#include "cli/test/chaos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "base/shell_word.hpp"
#include "base/text.hpp"
#include "cli/output.hpp"
#include "cli/test/pool.hpp"
#include "cli/test/seed_job.hpp"
#include "plan/value.hpp"
#include "sim/chaos_file.hpp"
#include "trial/shrink.hpp"
#include "trial/with_chaos.hpp"

namespace vagus::cli {

namespace {

namespace fs = std::filesystem;

constexpr char kSurvived = '=', kBroken = '#', kUnfit = '!';  // what a process begins its text with

// The set of that number, of one test.
struct Try {
    const trial::TestResult* result = nullptr;
    uint64_t set = 1;
    uint64_t seed = 1;
    Time end{};  // of the run in which nothing breaks
};

// What came of it.
struct Tried {
    bool broken = false;
    trial::Outcome outcome = {};
    std::string trouble = {};
    double seconds = 0;  // of wall clock
};

bool takes_part(const trial::TestResult& result) {
    return !result.test.world.empty() && result.test.chaos.faults.empty() &&
           std::ranges::all_of(result.seeds, [](const auto& one) { return as_expected(one); });
}

std::string words_of(const Try& one, const ChaosTries& tries) {
    std::string kinds;
    for (const sim::ChaosKind kind : tries.kinds) {
        kinds += (kinds.empty() ? ":" : ",") + std::string(sim::name_of(kind));
    }
    const uint64_t faults = (one.set - 1) % kChaosInSet + 1;
    const double seconds = seconds_of(std::max(one.end, sim::kPoseEvery));
    return fmt::format("random:{}:{}:{}{}", faults, one.set, plan::text_of(seconds), kinds);
}

std::vector<Try> tries_of(const std::vector<trial::TestResult>& results, const ChaosTries& tries) {
    std::vector<Try> all;
    for (const trial::TestResult& result : results) {
        if (!takes_part(result)) continue;
        for (uint64_t set = 1; set <= tries.sets; ++set) {
            const trial::SeedResult& seed = result.seeds[(set - 1) % result.seeds.size()];
            all.push_back({&result, set, seed.seed, seed.outcome.end});
        }
    }
    return all;
}

// ---- in processes of their own ----

std::string run_try(const Try& one, const ChaosTries& tries) {
    const auto outcome =
        trial::run_trial(one.result->test, one.seed, {.chaos = words_of(one, tries)});
    if (!outcome.ok()) return kUnfit + outcome.error().what;
    return (outcome.value().as_expected() ? kSurvived : kBroken) +
           trial::format_outcome(outcome.value());
}

// Shrinks, records, writes the test; what is to be told.
class Shrinking {
public:
    Shrinking(const Try& one, const trial::Outcome& outcome, std::string stem)
        : try_(one), outcome_(outcome), stem_(std::move(stem)) {}

    std::string run() {
        const trial::Breaks breaks = [this](const trial::Faults& faults) -> std::optional<Time> {
            const auto again = run_with(faults, "");
            if (!again.ok() || again.value().as_expected()) return std::nullopt;
            return again.value().failed_at();
        };
        const trial::Shrunk least = trial::shrink(outcome_.faults, outcome_.failed_at(), breaks);
        std::string text = fmt::format("  {} of {} left, after {} runs:\n", count(least.faults),
                                       outcome_.faults.size(), least.runs);
        for (const sim::ChaosFault& fault : least.faults) text += line_of(fault);
        const Status written = write(least, text);
        if (!written.ok()) text += "  " + written.error().what + "\n";
        return text;
    }

private:
    Result<trial::Outcome> run_with(const trial::Faults& faults, const std::string& record) const {
        return trial::run_trial(try_.result->test, try_.seed,
                                {.record = record, .chaos = sim::format_chaos(faults)});
    }

    static std::string count(const trial::Faults& faults) {
        return faults.size() == 1 ? "1 fault" : fmt::format("{} faults", faults.size());
    }

    static std::string seconds(Time at) { return plan::text_of(seconds_of(at)) + " s"; }

    static std::string line_of(const sim::ChaosFault& fault) {
        const std::string until = fault.until ? " to " + seconds(*fault.until) : "";
        return fmt::format("    {}{}: {}\n", seconds(fault.from), until,
                           sim::began_sentence(fault));
    }

    Status write(const trial::Shrunk& least, std::string& text) const {
        const std::string file = stem_ + std::string(trial::kTestEnding);
        const std::string recording = stem_ + ".mcap";
        std::error_code error;
        fs::create_directories(fs::path(stem_).parent_path(), error);
        const auto again = TRY(run_with(least.faults, recording));
        const trial::SeedResult seed{.seed = try_.seed, .outcome = again};
        text += trial::describe_failure(try_.result->test, seed) + "\n";
        text += fmt::format("  vagus replay {} --until {}\n", shell_word(recording),
                            plan::text_of(seconds_of(again.failed_at())));
        const std::string test = TRY(read_file(try_.result->test.path));
        const std::string made =
            TRY(trial::with_chaos(try_.result->test, test, {try_.seed, least.faults}, file));
        TRY(write_file(file, made));
        text += fmt::format("  vagus test {}\n", shell_word(file));
        return Status::done();
    }

    const Try& try_;
    const trial::Outcome& outcome_;
    std::string stem_;
};

Tried read_tried(JobResult result) {
    Tried tried;
    tried.trouble = std::move(result.trouble);
    tried.seconds = result.seconds;
    const std::string& text = result.text;
    if (tried.trouble.empty() && text.starts_with(kUnfit)) tried.trouble = text.substr(1);
    if (tried.trouble.empty() && text.empty()) tried.trouble = "its process said nothing";
    tried.broken = !tried.trouble.empty() || text.starts_with(kBroken);
    if (tried.trouble.empty()) tried.outcome = trial::read_outcome(text.substr(1));
    return tried;
}

void keep(const std::vector<Try>& all, const std::vector<Tried>& tried, const ChaosTries& tries,
          std::vector<trial::TestResult>& results) {
    for (size_t i = 0; i < all.size(); ++i) {
        results[static_cast<size_t>(all[i].result - results.data())].faults.push_back(
            {.words = words_of(all[i], tries),
             .result = {.seed = all[i].seed,
                        .outcome = tried[i].outcome,
                        .trouble = tried[i].trouble,
                        .seconds = tried[i].seconds}});
    }
}

}  // namespace

Result<ChaosTries> parse_chaos_tries(const std::string& text) {
    const size_t colon = text.find(':');
    const auto sets = decimal_number(text.substr(0, colon));
    if (!sets || *sets < 1 || *sets > kChaosSetsMax) {
        return Error{Code::BadInput,
                     fmt::format("--chaos {}: expected how many sets of faults to try, 1 to {}, "
                                 "and perhaps their kinds, as --chaos 20 or --chaos 20:lost,hung",
                                 text, kChaosSetsMax)};
    }
    ChaosTries tries{.sets = *sets};
    if (colon == std::string::npos) return tries;
    auto kinds = sim::parse_chaos_kinds(std::string_view(text).substr(colon + 1));
    if (!kinds.ok()) {
        return Error{kinds.error().code, fmt::format("--chaos {}: {}", text, kinds.error().what)};
    }
    tries.kinds = std::move(kinds.value());
    return tries;
}

std::string result_stem(const std::vector<trial::TestResult>& all, const trial::TestFile& test,
                        const std::string& folder) {
    const auto name_of = [](const trial::TestFile& one) {
        const std::string file = fs::path(one.path).filename().string();
        return file.ends_with(trial::kTestEnding)
                   ? file.substr(0, file.size() - trial::kTestEnding.size())
                   : file;
    };
    const std::string name = name_of(test);
    const auto same = std::ranges::count_if(
        all, [&](const trial::TestResult& one) { return name_of(one.test) == name; });
    const std::string prefix =
        same > 1 ? fs::absolute(test.path).parent_path().filename().string() + "-" : "";
    return (fs::path(folder) / (prefix + name)).string();
}

size_t try_chaos(std::vector<trial::TestResult>& results, const ChaosTries& tries) {
    const std::vector<Try> all = tries_of(results, tries);
    std::vector<Tried> tried(all.size());
    const bool all_tried = run_jobs(
        all.size(), tries.at_once, [&](size_t i) { return run_try(all[i], tries); },
        [&](size_t i, JobResult result) {
            tried[i] = read_tried(std::move(result));
            return true;
        });
    if (!all_tried) return 0;
    keep(all, tried, tries, results);
    // Of each test the first that it did not survive.
    std::vector<size_t> firsts;
    for (size_t i = 0; i < all.size(); ++i) {
        const bool another = firsts.empty() || all[firsts.back()].result != all[i].result;
        if (tried[i].broken && another) firsts.push_back(i);
    }
    const auto stem_of = [&](size_t first) {
        const Try& one = all[firsts[first]];
        return fmt::format("{}.chaos-{}", result_stem(results, one.result->test, tries.results),
                           one.set);
    };
    std::vector<std::string> told(firsts.size());
    const bool all_told = run_jobs(
        firsts.size(), tries.at_once,
        [&](size_t i) {
            const Try& one = all[firsts[i]];
            if (!tried[firsts[i]].trouble.empty()) return "  " + tried[firsts[i]].trouble + "\n";
            return Shrinking(one, tried[firsts[i]].outcome, stem_of(i)).run();
        },
        [&](size_t i, JobResult result) {
            told[i] = result.trouble.empty() ? result.text : "  " + result.trouble + "\n";
            return true;
        });
    if (!all_told) {
        for (size_t i = 0; i < firsts.size(); ++i) delete_half_recording(stem_of(i) + ".mcap");
        return 0;
    }
    size_t next = 0;
    for (size_t i = 0; i < all.size(); i += tries.sets) {
        const auto begin = tried.begin() + static_cast<std::ptrdiff_t>(i);
        const auto broken = std::count_if(begin, begin + static_cast<std::ptrdiff_t>(tries.sets),
                                          [](const Tried& one) { return one.broken; });
        print(fmt::format("{} {}: survives {} of {} sets of faults\n",
                          broken == 0 ? "ok    " : "FAILED", all[i].result->test.path,
                          tries.sets - static_cast<uint64_t>(broken), tries.sets));
        if (broken == 0) continue;
        const Try& first = all[firsts[next]];
        print(fmt::format("  set {}, with seed {}; by hand --seed {} --chaos {}\n", first.set,
                          first.seed, first.seed, words_of(first, tries)));
        print(told[next++]);
    }
    return firsts.size();
}

}  // namespace vagus::cli
