#include "cli/record/turning.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <thread>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/test/pool.hpp"
#include "net/end_signal.hpp"
#include "trial/turning_text.hpp"

namespace vagus::cli {

namespace {

namespace fs = std::filesystem;

// What a line of a process begins with: how a continuation ended, what is wrong with the question,
// how the process of one ended instead.
constexpr char kAnswer = '=', kWrong = '!', kFailed = '?';

// Runs continuations in processes that begin as copies of this one: at an instant a process goes on
// in a copy of itself for each seed.
class Asker {
public:
    Asker(trial::Continued& continued, const TurningOptions& options) : continued_(continued) {
        const size_t processors = std::max(1u, std::thread::hardware_concurrency());
        at_once_ = options.at_once > 0 ? static_cast<size_t>(options.at_once)
                                       : std::min<size_t>(processors, kJobsAtOnceMax);
    }

    Result<trial::RunEnd> as_it_was() {
        const auto work = [this](size_t) { return text_of(continued_.as_it_was()); };
        return TRY(run(1, work)).front().front();
    }

    Result<std::vector<bool>> ask(const std::vector<trial::Continuation>& all) {
        const std::vector<Part> parts = parts_of(all);
        const auto ends = TRY(run(parts.size(), [&](size_t i) { return work(parts[i]); }));
        std::vector<bool> came;
        for (size_t i = 0; i < parts.size(); ++i) {
            if (ends[i].size() != parts[i].seeds.size()) {
                return Error{
                    Code::Unavailable,
                    fmt::format("of the {} continuations from {} s, {} were told",
                                parts[i].seeds.size(), seconds_text(parts[i].at), ends[i].size())};
            }
            for (const trial::RunEnd& end : ends[i]) came.push_back(end.came.has_value());
        }
        return came;
    }

    Status record(const trial::Continuation& start, const std::string& file) {
        const auto work = [&](size_t) {
            const Status done = continued_.record(start, file);
            return done.ok() ? std::string() : wrong(done.error());
        };
        (void)TRY(run(1, work));
        return Status::done();
    }

private:
    // Continuations from one instant, in one process up to there.
    struct Part {
        Time at{};
        std::vector<uint64_t> seeds = {};
    };

    // In their order. Of few instants each has several parts, so that all processors work.
    std::vector<Part> parts_of(const std::vector<trial::Continuation>& all) const {
        const bool few = all.front().at == all.back().at;
        const size_t seeds_max = few ? (all.size() + at_once_ - 1) / at_once_ : all.size();
        std::vector<Part> parts;
        for (const trial::Continuation& one : all) {
            const bool same = !parts.empty() && parts.back().at == one.at;
            if (!same || parts.back().seeds.size() >= seeds_max) parts.push_back({.at = one.at});
            parts.back().seeds.push_back(one.seed);
        }
        return parts;
    }

    // Each line: how one continuation ended, or what is wrong.
    static std::string text_of(const Result<trial::RunEnd>& end) {
        if (!end.ok()) return wrong(end.error());
        return kAnswer + trial::format_run_end(end.value()) + "\n";
    }
    static std::string wrong(const Error& error) { return kWrong + error.what; }

    std::string work(const Part& part) {
        std::string trouble;
        const auto split = [&trouble] { return trouble.empty() && continue_in_copy(trouble); };
        const auto end = continued_.from_each(part.at, part.seeds, split);
        if (!end.ok()) return wrong(end.error());
        if (end.value()) return text_of(*end.value());  // in a copy
        return trouble.empty() ? "" : kFailed + trouble;
    }

    using Ends = std::vector<trial::RunEnd>;
    Result<std::vector<Ends>> run(size_t count, const std::function<std::string(size_t)>& work) {
        std::vector<Ends> ends(count);
        Status state = Status::done();
        const auto done = [&](size_t i, const JobResult& result) {
            state = take(result, ends[i]);
            return state.ok();
        };
        if (!run_jobs(count, static_cast<int>(at_once_), work, done)) {
            return Error{Code::Refused, "ended by " + net::end_asked_by()};
        }
        TRY(state);
        return ends;
    }

    static Status take(const JobResult& result, Ends& ends) {
        const std::string what = "a continuation of the run: ";
        if (!result.trouble.empty()) return Error{Code::Unavailable, what + result.trouble};
        for (std::string_view rest = result.text; !rest.empty();) {
            const std::string said(rest.substr(1));
            if (rest.front() == kFailed) return Error{Code::Unavailable, what + said};
            if (rest.front() == kWrong) return Error{Code::BadInput, said};
            const std::string_view line = rest.substr(0, rest.find('\n'));
            ends.push_back(trial::read_run_end(line.substr(1)));
            rest.remove_prefix(std::min(rest.size(), line.size() + 1));
        }
        return Status::done();
    }

    trial::Continued& continued_;
    size_t at_once_ = 1;
};

// One with it and one without it, as far as there are any.
Status keep_recordings(Asker& asker, const TurningOptions& options, trial::TurningTold& told) {
    const trial::Turn& turn = *told.turning.turn;
    std::error_code error;
    fs::create_directories(options.results, error);
    const fs::path stem = fs::path(options.results) / fs::path(options.file).stem();
    const auto keep = [&](const std::optional<trial::Continuation>& start, const char* ending,
                          std::string& file) -> Status {
        if (!start) return Status::done();
        file = stem.string() + ending;
        return asker.record(*start, file);
    };
    TRY(keep(turn.with, ".with.mcap", told.with));
    return keep(turn.without, ".without.mcap", told.without);
}

Result<trial::TurningTold> find(Asker& asker, const trial::Continued& continued,
                                const mcap::Reader& reader, const TurningOptions& options) {
    trial::TurningTold told{
        .file = options.file, .robot = options.robot, .condition = continued.condition().text()};
    told.run = TRY(asker.as_it_was());
    told.question = {.end = told.run.came.value_or(told.run.end),
                     .came = told.run.came.has_value(),
                     .tries = static_cast<int>(options.tries)};
    told.turning = TRY(trial::find_turning(
        told.question, [&asker](const auto& continuations) { return asker.ask(continuations); }));
    if (!told.turning.turn) return told;
    const trial::Turn& turn = *told.turning.turn;
    told.there = TRY(record::moment(reader, turn.before.at, turn.after.at, options.robot));
    TRY(keep_recordings(asker, options, told));
    return told;
}

}  // namespace

CLI::Option* add_turning_options(CLI::App& verb, TurningOptions& options) {
    CLI::Option* const turning =
        verb.add_option("--turning-point", options.condition,
                        "instead of a question: when it was decided that this condition comes "
                        "about, or does not");
    turning->type_name("CONDITION");
    CLI::Option* const tries =
        verb.add_option("--tries", options.tries,
                        fmt::format("with --turning-point: continuations from each instant ({})",
                                    trial::kTriesUsual));
    takes_whole_number(*tries, 1, trial::kTriesMax);
    CLI::Option* const until =
        verb.add_option("--until", options.until,
                        "with --turning-point: until when the condition is waited for (the end of "
                        "the recording)");
    until->type_name("S");
    CLI::Option* const at_once = verb.add_option(
        "-j", options.at_once,
        "with --turning-point: continuations that run at once (one for each processor)");
    takes_whole_number(*at_once, 1, kJobsAtOnceMax);
    CLI::Option* const results =
        verb.add_option("--results", options.results,
                        "with --turning-point: where the two continuations go (turning-point)");
    results->type_name("FOLDER");
    for (CLI::Option* const one : {tries, until, at_once, results}) one->needs(turning);
    return turning;
}

namespace {

// All that it holds, a folder of files among it, is gone when this returns.
int tell(const TurningOptions& options) {
    const auto file = MappedFile::open(options.file);
    if (!file.ok()) return complain(file.error(), kExitUsage);
    const auto reader = mcap::Reader::open(file.value().bytes(), options.file);
    if (!reader.ok()) return complain(reader.error(), kExitUsage);
    if (options.until && !(*options.until > 0)) {
        return complain(
            fmt::format("--until {}: expected seconds above 0, as --until 60", *options.until),
            kExitUsage);
    }
    std::optional<Time> until;
    if (options.until) until = from_seconds(*options.until);
    const auto continued =
        trial::Continued::open(reader.value(), options.condition, until, options.robot);
    if (!continued.ok()) return complain(continued.error(), kExitUsage);
    Asker asker(*continued.value(), options);
    const auto told = find(asker, *continued.value(), reader.value(), options);
    if (net::end_asked()) return kExitFailed;
    if (!told.ok()) {
        return complain(told.error(),
                        told.error().code == Code::BadInput ? kExitUsage : kExitFailed);
    }
    print(options.json ? trial::format_turning_json(told.value())
                       : trial::format_turning(told.value()));
    return kExitDone;
}

}  // namespace

int tell_turning(const TurningOptions& options) {
    net::watch_for_end();
    const int exit_code = tell(options);
    return net::end_asked() ? net::end_as_asked(exit_code) : exit_code;
}

}  // namespace vagus::cli
