#include "cli/record/turning_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <thread>

#include "base/seconds.hpp"
#include "cli/test/pool.hpp"
#include "net/end_signal.hpp"

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
    Asker(trial::Continued& continued, int64_t at_once, const TellSearch& told)
        : continued_(continued), told_(told) {
        const size_t processors = std::max(1u, std::thread::hardware_concurrency());
        at_once_ = at_once > 0 ? static_cast<size_t>(at_once)
                               : std::min<size_t>(processors, kJobsAtOnceMax);
    }

    Result<trial::RunEnd> as_it_was() {
        const auto work = [this](size_t) { return text_of(continued_.as_it_was()); };
        return TRY(run(1, work)).front().front();
    }

    Result<std::vector<bool>> ask(const std::vector<trial::Continuation>& all) {
        const std::vector<Part> parts = parts_of(all);
        begin(began_ ? SearchStage::Narrowing : SearchStage::Curve, all.size());
        began_ = true;
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
        begin(SearchStage::Recordings, 0);
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

    void begin(SearchStage stage, size_t of) {
        progress_ = {.stage = stage, .done = 0, .of = of};
        (void)tell();
    }
    bool tell() { return goes_on_ = goes_on_ && told_(progress_); }

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
            progress_.done += ends[i].size();
            return state.ok() && tell();
        };
        if (!run_jobs(count, static_cast<int>(at_once_), work, done)) {
            return Error{Code::Refused, "ended by " + net::end_asked_by()};
        }
        TRY(state);
        if (!goes_on_) return Error{Code::Refused, "nobody waits for it any more"};
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
    const TellSearch& told_;
    size_t at_once_ = 1;
    SearchProgress progress_;
    bool began_ = false;   // the curve is known
    bool goes_on_ = true;  // somebody waits for it
};

// One with it and one without it, as far as there are any.
Status keep_recordings(Asker& asker, const TurningSearch& search, trial::TurningTold& told) {
    const trial::Turn& turn = *told.turning.turn;
    std::error_code error;
    fs::create_directories(search.results, error);
    const fs::path stem = fs::path(search.results) / fs::path(search.file).stem();
    const auto keep = [&](const std::optional<trial::Continuation>& start, const char* ending,
                          std::string& file) -> Status {
        if (!start) return Status::done();
        file = stem.string() + ending;
        return asker.record(*start, file);
    };
    TRY(keep(turn.with, ".with.mcap", told.with));
    return keep(turn.without, ".without.mcap", told.without);
}

}  // namespace

Result<trial::TurningTold> find_turning_point(trial::Continued& continued,
                                              const mcap::Reader& reader,
                                              const TurningSearch& search, const TellSearch& told) {
    Asker asker(continued, search.at_once, told);
    trial::TurningTold found{
        .file = search.file, .robot = search.robot, .condition = continued.condition().text()};
    found.run = TRY(asker.as_it_was());
    found.question = {.end = found.run.came.value_or(found.run.end),
                      .came = found.run.came.has_value(),
                      .tries = static_cast<int>(search.tries)};
    found.turning = TRY(trial::find_turning(
        found.question, [&asker](const auto& continuations) { return asker.ask(continuations); }));
    if (!found.turning.turn) return found;
    const trial::Turn& turn = *found.turning.turn;
    found.there = TRY(record::moment(reader, turn.before.at, turn.after.at, search.robot));
    TRY(keep_recordings(asker, search, found));
    return found;
}

}  // namespace vagus::cli
