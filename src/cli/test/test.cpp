// vagus test: runs tests of behaviour over their seeds, and tells what was not as expected.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <thread>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "base/shell_word.hpp"
#include "base/temporary_folder.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/test/chaos.hpp"
#include "cli/test/pool.hpp"
#include "cli/test/seed_job.hpp"
#include "cli/verbs.hpp"
#include "embed/loaded_plan.hpp"
#include "net/end_signal.hpp"
#include "session/toolboxes.hpp"
#include "trial/drawing.hpp"
#include "trial/from_recording.hpp"
#include "trial/kept_run.hpp"
#include "trial/recorded_runs.hpp"
#include "trial/report.hpp"

namespace vagus::cli {

namespace {

namespace fs = std::filesystem;

constexpr size_t kTestsMax = 10'000;   // files of one command
constexpr size_t kFailuresShown = 10;  // of one test; all are in the JUnit file

struct TestOptions {
    std::vector<std::string> files = {"."};
    std::vector<std::string> recordings = {};  // of `files`: those that are counted only
    int64_t at_once = 0;                       // 0: as many as there are processors
    std::string seeds;
    std::string junit;
    std::string coverage;
    std::string results = "test-results";
    std::string chaos;  // as typed; empty: nothing breaks but what tests say
    ChaosTries tries = {};
    bool signals = false;
};

// ---- which tests ----

bool is_recording(const std::string& path) {
    return path.ends_with(".mcap");
}

bool is_test(const fs::path& path) {
    return path.filename().string().ends_with(trial::kTestEnding);
}

Result<std::vector<std::string>> tests_in(const std::string& folder) {
    std::vector<std::string> found;
    std::error_code error;
    auto entry = fs::recursive_directory_iterator(folder, error);
    for (; !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
        const bool hidden = entry->path().filename().string().starts_with('.');
        if (hidden && entry->is_directory(error)) {
            entry.disable_recursion_pending();
        } else if (is_test(entry->path())) {
            found.push_back(entry->path().lexically_normal().string());
        }
        if (found.size() <= kTestsMax) continue;
        return Error{Code::Limit, fmt::format("{}: has more than {} tests; name a part of it",
                                              folder, kTestsMax)};
    }
    if (error) {
        return Error{Code::Unavailable,
                     fmt::format("{}: cannot be looked through: {}", folder, error.message())};
    }
    if (found.empty()) {
        return Error{Code::NotFound, fmt::format("{}: there is no test, no file NAME{}, in this "
                                                 "folder; docs/testing.md shows one",
                                                 folder, trial::kTestEnding)};
    }
    std::sort(found.begin(), found.end());
    return found;
}

Result<std::vector<trial::TestFile>> read_tests(const TestOptions& options) {
    std::vector<std::string> paths;
    for (const std::string& given : options.files) {
        if (!fs::is_directory(given)) {
            paths.push_back(given);
            continue;
        }
        const auto found = TRY(tests_in(given));
        paths.insert(paths.end(), found.begin(), found.end());
    }
    std::vector<trial::TestFile> tests;
    for (const std::string& path : paths) {
        const std::string text = TRY(read_file(path));
        tests.push_back(TRY(trial::read_test(text, path)));
        if (!options.seeds.empty()) tests.back().seeds = TRY(trial::parse_seeds(options.seeds));
    }
    return tests;
}

// ---- recordings, which are counted with the runs of tests ----

Result<trial::RecordedRuns> count_recordings(const std::vector<std::string>& recordings,
                                             const trial::Coverage& beside) {
    trial::RecordedRuns counted;
    const auto know = [&counted](const std::string& path) {
        const auto text = read_file(path);
        if (text.ok()) counted.know(path, text.value());
    };
    for (const auto& [path, plan] : beside.plans) know(path);
    for (const auto& [path, script] : beside.scripts) know(path);
    for (const std::string& path : recordings) {
        const MappedFile file = TRY(MappedFile::open(path));
        const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), path));
        const trial::CountedRun one = TRY(counted.add(reader));
        print(fmt::format("counted {}: {} s of {}{}{}\n", path, seconds_text(one.end), one.plan,
                          one.of_bus ? " on a real bus" : "",
                          one.changed ? ", up to where another version of it took over" : ""));
    }
    return counted;
}

// ---- files that are written ----

// A file of ours; what else has its name was typed in the wrong place.
struct FileKind {
    const char* what;
    std::string_view begins;
};
constexpr FileKind kJunit{"a report of JUnit", trial::kJunitBegins};
constexpr FileKind kLcov{"a tracefile of lcov", trial::kLcovBegins};
constexpr FileKind kDrawing{"a drawing of coverage", trial::kDrawingBegins};
constexpr const char* kScriptsFile = "scripts.info";

Status check_replaceable(const std::string& path, const FileKind& kind) {
    if (!is_file_of_another_kind(path, kind.begins)) return Status::done();
    return Error{Code::Refused, fmt::format("{}: is there already, and is not {}, which would be "
                                            "written there; name another place",
                                            path, kind.what)};
}

Status replace_file(const std::string& path, const FileKind& kind, const std::string& content) {
    TRY(check_replaceable(path, kind));
    return write_file(path, content);
}

// Before any test runs, so that nobody waits for nothing.
Status check_places(const TestOptions& options) {
    if (!options.junit.empty()) TRY(check_replaceable(options.junit, kJunit));
    if (options.coverage.empty()) return Status::done();
    const fs::path folder(options.coverage);
    std::error_code ignored;
    if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored)) {
        return Error{Code::Refused, fmt::format("{}: is a file; --coverage expects a folder, which "
                                                "is made if there is none",
                                                options.coverage)};
    }
    return check_replaceable((folder / kScriptsFile).string(), kLcov);
}

// ---- running ----

class Session {
public:
    Session(TestOptions options, std::vector<trial::TestFile> tests)
        : options_(std::move(options)) {
        for (trial::TestFile& test : tests) {
            for (uint64_t seed = test.seeds.first;; ++seed) {
                jobs_.push_back({results_.size(), seed});
                if (seed == test.seeds.last) break;
            }
            results_.push_back({.test = std::move(test), .seeds = {}});
        }
    }

    int run() {
        outcomes_.resize(jobs_.size());
        const bool all = run_jobs(
            jobs_.size(), at_once(), [this](size_t i) { return work(jobs_[i]); },
            [this](size_t i, JobResult result) { return take(i, std::move(result)); });
        if (!all) return end_early();
        if (!invalid_.empty()) return complain(invalid_, kExitUsage);
        for (size_t i = 0; i < jobs_.size(); ++i) {
            results_[jobs_[i].test].seeds.push_back(std::move(outcomes_[i]));
        }
        return report();
    }

private:
    int at_once() const {
        const size_t processors = std::max(1u, std::thread::hardware_concurrency());
        return static_cast<int>(options_.at_once > 0 ? static_cast<size_t>(options_.at_once)
                                                     : processors);
    }

    struct Job {
        size_t test = 0;
        uint64_t seed = 0;
    };

    // Two tests of one name have the folder in the names of their recordings.
    std::string recording_of(const Job& job) const {
        return fmt::format("{}.seed-{}.mcap",
                           result_stem(results_, results_[job.test].test, options_.results),
                           job.seed);
    }

    std::string work(const Job& job) const {
        return work_seed(results_[job.test].test, job.seed,
                         {.scripts = !options_.coverage.empty(), .recording = recording_of(job)});
    }

    bool take(size_t index, JobResult job) {
        SeedDone done = read_seed_work(jobs_[index].seed, std::move(job));
        outcomes_[index] = std::move(done.result);
        invalid_ = std::move(done.refused);
        return invalid_.empty();
    }

    int end_early() const {
        for (const Job& job : jobs_) delete_half_recording(recording_of(job));
        return kExitFailed;
    }

    // ---- telling ----

    int report() {
        size_t failed = 0, runs = 0;
        trial::Coverage coverage;
        for (const trial::TestResult& result : results_) {
            failed += tell(result);
            runs += result.seeds.size();
            for (const trial::SeedResult& seed : result.seeds) coverage.add(seed.outcome.coverage);
        }
        const auto recorded = count_recordings(options_.recordings, coverage);
        if (!recorded.ok()) return complain(recorded.error(), kExitUsage);
        coverage.add(recorded.value().coverage());
        const std::string table = trial::format_table(coverage);
        if (!table.empty()) print("\n" + table);
        if (runs > 0) print(fmt::format("\n{} of {} runs as expected\n", runs - failed, runs));
        const Status written = write_files(coverage, recorded.value().plans());
        if (!written.ok()) return complain(written.error());
        if (options_.tries.sets > 0) failed += break_things();
        if (net::end_asked()) return kExitFailed;
        // Again, now that it has the sets of faults, too.
        const Status told = options_.tries.sets > 0 ? write_junit() : Status::done();
        if (!told.ok()) return complain(told.error());
        return failed == 0 ? kExitDone : kExitFailed;
    }

    // How many tests did not survive it.
    size_t break_things() {
        ChaosTries tries = options_.tries;
        tries.at_once = at_once();
        tries.results = options_.results;
        print("\n");
        return try_chaos(results_, tries);
    }

    // How many seeds of it failed.
    static size_t tell(const trial::TestResult& result) {
        const auto failed = static_cast<size_t>(std::ranges::count_if(
            result.seeds, [](const auto& one) { return !trial::as_expected(one); }));
        print(fmt::format("{} {}: {} of {} seeds\n", failed == 0 ? "ok    " : "FAILED",
                          result.test.path, result.seeds.size() - failed, result.seeds.size()));
        size_t shown = 0;
        for (const trial::SeedResult& seed : result.seeds) {
            if (trial::as_expected(seed)) continue;
            if (++shown > kFailuresShown) {
                print(fmt::format("  and {} more\n", failed - kFailuresShown));
                break;
            }
            print(trial::describe_failure(result.test, seed) + "\n");
            if (!seed.recording.empty()) print(commands_for(seed));
        }
        return failed;
    }

    static std::string commands_for(const trial::SeedResult& seed) {
        const Time first = seed.outcome.failed_at();
        return fmt::format("  vagus replay {} --until {}\n", shell_word(seed.recording),
                           plan::text_of(seconds_of(first)));
    }

    Status write_junit() const {
        if (options_.junit.empty()) return Status::done();
        return replace_file(options_.junit, kJunit, trial::format_junit(results_));
    }

    Status write_files(const trial::Coverage& coverage,
                       const std::vector<plan::Plan>& recorded) const {
        TRY(write_junit());
        if (options_.coverage.empty()) return Status::done();
        const fs::path folder(options_.coverage);
        std::error_code error;
        fs::create_directories(folder, error);
        std::string text = trial::format_table(coverage);
        for (const auto& [file, plan] : coverage.plans) {
            const std::string missing = trial::format_missing(plan);
            if (!missing.empty()) text += "\nnever, " + file + ":\n" + missing;
        }
        for (const auto& [file, script] : coverage.scripts) {
            if (!script.only_told) continue;
            text += "\nas far as frames tell, " + file + ":\n" + trial::format_told(script);
        }
        TRY(write_file((folder / "coverage.txt").string(), text));
        TRY(replace_file((folder / kScriptsFile).string(), kLcov, trial::format_lcov(coverage)));
        std::vector<plan::Plan> plans = TRY(plans_of_tests());
        plans.insert(plans.end(), recorded.begin(), recorded.end());
        return draw_plans(coverage, plans, folder);
    }

    Result<std::vector<plan::Plan>> plans_of_tests() const {
        std::vector<plan::Plan> plans;
        for (const trial::TestResult& result : results_) {
            if (result.test.plan.empty()) continue;
            toolbox::Parts parts;
            run::CodeLibrary library;
            TRY(session::add_toolboxes(library, parts, result.test.toolboxes));
            const auto loaded = embed::LoadedPlan::from_file(result.test.plan, library);
            plans.insert(plans.end(), loaded.plans().begin(), loaded.plans().end());
        }
        return plans;
    }

    // Of two files with one name the second is NAME-2.svg.
    static Status draw_plans(const trial::Coverage& coverage, const std::vector<plan::Plan>& plans,
                             const fs::path& folder) {
        std::set<std::string> drawn;
        std::map<std::string, int> named;
        for (const plan::Plan& plan : plans) {
            const auto counted = coverage.plans.find(plan.file);
            if (counted == coverage.plans.end() || !drawn.insert(plan.file).second) continue;
            const int number = ++named[plan.name];
            const std::string name =
                plan.name + (number > 1 ? fmt::format("-{}", number) : "") + ".svg";
            TRY(replace_file((folder / name).string(), kDrawing,
                             trial::draw_coverage(plan, counted->second)));
        }
        return Status::done();
    }

    TestOptions options_;
    std::vector<trial::TestResult> results_;
    std::vector<Job> jobs_;
    std::vector<trial::SeedResult> outcomes_;  // of each job
    std::string invalid_;
};

int test(TestOptions options) {
    if (options.signals) {
        print(trial::describe_signals());
        return kExitDone;
    }
    if (!options.chaos.empty()) {
        auto tries = parse_chaos_tries(options.chaos);
        if (!tries.ok()) return complain(tries.error(), kExitUsage);
        options.tries = std::move(tries.value());
    }
    const auto tests_end =
        std::stable_partition(options.files.begin(), options.files.end(),
                              [](const std::string& path) { return !is_recording(path); });
    options.recordings.assign(tests_end, options.files.end());
    options.files.erase(tests_end, options.files.end());
    const Status places = check_places(options);
    if (!places.ok()) return complain(places.error(), kExitUsage);
    auto tests = read_tests(options);
    if (!tests.ok()) return complain(tests.error(), kExitUsage);
    net::watch_for_end();
    return net::end_as_asked(Session(options, std::move(tests.value())).run());
}

// ---- vagus test new ----

// run.mcap: run.test.json, beside it.
std::string test_beside(const std::string& recording) {
    fs::path path(recording);
    return path.replace_extension(trial::kTestEnding).string();
}

// `vagus sim` lets time pass while it loads scripts, and a test does not: their runs are not the
// same to the bit. So a test of scripts is run once, and passes.
Result<trial::KeptRun> draft_of(const mcap::Reader& reader, const std::string& to) {
    trial::Draft drafted = TRY(trial::draft_test(reader));
    if (!drafted.plan.empty()) return trial::KeptRun{std::move(drafted)};
    const TemporaryFolder scratch = TRY(TemporaryFolder::make("kept"));
    return trial::keep_run(reader, {.test = to, .scratch = scratch.path() + "/run.mcap"});
}

int draft(const std::string& recording, const std::string& to) {
    if (!is_test(to)) {
        return complain(to + ": a test is called NAME" + std::string(trial::kTestEnding),
                        kExitUsage);
    }
    if (fs::exists(to)) return complain(to + ": is there already; choose another name", kExitUsage);
    const auto file = MappedFile::open(recording);
    if (!file.ok()) return complain(file.error(), kExitUsage);
    const auto reader = mcap::Reader::open(file.value().bytes(), recording);
    if (!reader.ok()) return complain(reader.error(), kExitUsage);
    const auto made = draft_of(reader.value(), to);
    if (!made.ok()) return complain(made.error(), kExitUsage);
    const trial::Draft& drafted = made.value().draft;
    const Status written = write_file(to, drafted.text);
    if (!written.ok()) return complain(written.error());
    if (made.value().differs) {
        say(to + ": your files do otherwise from the beginning; it expects that\n");
    }
    for (const std::string& hint : drafted.hints) say(to + ": " + hint + "\n");
    for (const std::string& name : {drafted.plan, drafted.world}) {
        const fs::path path = fs::path(to).parent_path() / name;
        if (name.empty() || fs::exists(path)) continue;
        say(fmt::format("{}: {} is not found from there; correct its path in the test\n", to,
                        name));
    }
    print(to + "\n");
    return kExitDone;
}

void add_new(CLI::App& test, int& exit_code) {
    struct Options {
        std::string recording, to;
    };
    CLI::App* verb = test.add_subcommand("new", "writes a test from the recording of a run");
    auto options = std::make_shared<Options>();  // owners: CLI11's options and the callback
    takes_file(*verb->add_option("RECORDING", options->recording,
                                 "of a run of a plan, or of scripts in a world")
                    ->required(),
               {".mcap"});
    takes_file(*verb->add_option(
                   "FILE", options->to,
                   "the test, beside its plan or world (beside the recording, named as that)"),
               {std::string(trial::kTestEnding)});
    verb->footer(
        "The order in which actors first came, by when the last of them had, and how the run "
        "ended, with a quarter of room: trim it. Without a plan it is that nothing touched the "
        "robot, the first events, and where it was at the end.\n\nExample:\n"
        "  vagus test new run.mcap follow-wall/Wall.test.json\n"
        "  vagus test new seen.mcap thymio/Seen.test.json");
    verb->callback([options, &exit_code] {
        const std::string& to = options->to;
        exit_code = draft(options->recording, to.empty() ? test_beside(options->recording) : to);
    });
}

}  // namespace

void add_test(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("test", "runs tests of behaviour, NAME.test.json");
    auto options = std::make_shared<TestOptions>();  // owners: CLI11's options and the callback
    takes_file(*verb->add_option("FILE", options->files,
                                 "tests, or folders with tests in them and below (.); recordings "
                                 "of plans, also of real robots, are counted with their runs"),
               {std::string(trial::kTestEnding), ".mcap"});
    takes_whole_number(
        *verb->add_option("-j", options->at_once, "runs at once (one for each processor)"), 1,
        kJobsAtOnceMax);
    verb->add_option("--seeds", options->seeds, "these instead of those of the tests")
        ->type_name("A..B");
    takes_file(*verb->add_option("--junit", options->junit, "writes what came of each run, as XML"),
               {".xml"});
    verb->add_option("--coverage", options->coverage,
                     "writes into this folder what the runs went through: plans as drawings, "
                     "scripts for lcov")
        ->type_name("FOLDER");
    verb->add_option("--results", options->results,
                     "where recordings of runs go that failed (test-results)")
        ->type_name("FOLDER");
    verb->add_option("--chaos", options->chaos,
                     "then breaks things: so many random sets of faults (20, or 20:lost,hung of "
                     "these kinds) for each test that has a world; the first that it does not "
                     "survive is shrunk to the smallest, and written as a test")
        ->type_name("SETS");
    verb->add_flag("--signals", options->signals, "lists what conditions can name, and ends");
    verb->footer(
        "Runs each test with each of its seeds, in virtual time, and tells what was not as "
        "expected: seed, instant and values, and the command that shows it. The table tells what "
        "the runs went through.\n"
        "Exit codes: 0 all as expected, 1 something was not, 2 not valid.\n\nExample:\n"
        "  vagus test examples/follow-wall --junit junit.xml --coverage coverage\n"
        "  vagus test examples/follow-wall real.mcap --coverage coverage\n"
        "  vagus test Wall.test.json --seeds 7\n"
        "  vagus test Wall.test.json --chaos 20:lost,delayed,slow\n"
        "  vagus test --signals");
    add_new(*verb, exit_code);
    verb->callback([verb, options, &exit_code] {
        if (verb->get_subcommands().empty()) exit_code = test(*options);
    });
}

}  // namespace vagus::cli
