// When was it decided? Finds the instant of a run at which the chance that a condition becomes true
// turned: from instants over the run it is continued again and again with other seeds, and counted
// in how many continuations it became true.
//
//     const TurningQuestion question{.end = came, .came = true, .tries = 20};
//     const Turning turning = TRY(find_turning(question, ask));   // ask: runs continuations
//     if (turning.turn) show(turning.turn->before, turning.turn->after);
//
// It knows no runs and no processes: `ask` is handed instants and seeds, and says in which of these
// continuations it became true. The same answers give the same turning.
//
// First a grid of at most kInstantsMax instants. Before a decision the share in which it becomes
// true is one, after it another: the grid is cut into steps of equal chance where the two sides of
// a cut differ significantly (Fisher's exact test, corrected by Bonferroni for the number of places
// to cut: kSignificance). The largest change between two steps is the turn. It is narrowed by
// halving: at the instant in the middle continuations are added until it is kOdds times as likely
// that they belong to one side than to the other (A. Wald, "Sequential tests of statistical
// hypotheses", Annals of Mathematical Statistics 16 (1945), pages 117 to 186), down to
// TurningQuestion::step. A chance that changes little by little is told by the interval within
// which that cannot be said.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "trial/shares.hpp"

namespace vagus::trial {

constexpr int kTriesUsual = 20;      // continuations from one instant
constexpr int kTriesMax = 1000;      // likewise, at most
constexpr size_t kInstantsMax = 33;  // of the grid, with the end
constexpr double kSignificance = 0.01;
constexpr double kOdds = 1000;
constexpr int kRoundsMax = 10;      // of `tries` continuations at one instant while it is narrowed
constexpr int kNarrowingsMax = 40;  // an hour has 22 of them down to a millisecond

struct TurningQuestion {
    Time end{};         // when it became true, or the end of the run
    bool came = false;  // in the run itself
    int tries = kTriesUsual;
    Duration step = std::chrono::milliseconds(1);  // instants are multiples of it
};

// A run that is as it was up to the end of this instant, and draws from that seed behind it.
struct Continuation {
    Time at{};
    uint64_t seed = 0;
    friend bool operator==(const Continuation&, const Continuation&) = default;
};
// In which of them it became true, in their order. The Error ends the search.
using Ask = std::function<Result<std::vector<bool>>(const std::vector<Continuation>&)>;

// One instant of the curve.
struct Point {
    Time at{};
    Share share = {};
    bool is_end = false;                   // nothing was continued there: all is known
    std::optional<uint64_t> with = {};     // the first seed with which it became true …
    std::optional<uint64_t> without = {};  // … and with which it did not
};

struct Turn {
    Point before = {}, after = {};  // the last instant at which it was open, the first at which
                                    // it was not
    Share early = {}, late = {};    // of the steps of the grid on its two sides
    bool narrowed = true;           // down to one step; else it changed little by little in between
    // The last continuations from before the turn with which it became true, and did not.
    std::optional<Continuation> with = {}, without = {};
};

struct Turning {
    std::vector<Point> curve;        // the grid, by time
    std::optional<Turn> turn = {};   // nothing: chance did not decide it
    std::vector<size_t> steps = {};  // of the curve: the points with which another chance begins
    int continuations = 0;           // how many there were in all

    // Of the whole curve but its end.
    Share all() const;
};

Result<Turning> find_turning(const TurningQuestion& question, const Ask& ask);

// The seed of a continuation: each instant and try has its own, and always the same.
uint64_t continuation_seed(Time at, int number);

// Where the curve is cut into steps: the points with which another one begins.
std::vector<size_t> find_steps(const std::vector<Point>& curve);

}  // namespace vagus::trial
