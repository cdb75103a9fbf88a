#include "trial/turning.hpp"

#include <algorithm>
#include <cmath>

#include "base/rng.hpp"

namespace vagus::trial {

namespace {

Share sum_of(const std::vector<Point>& curve, size_t begin, size_t end) {
    Share sum;
    for (size_t i = begin; i < end; ++i) sum = sum + curve[i].share;
    return sum;
}

// Cuts the points from `begin` to `end` where two chances explain them best, if they do better than
// one; and then the parts.
void cut(const std::vector<Point>& curve, size_t begin, size_t end, std::vector<size_t>& steps) {
    size_t best = begin;
    double gain = 0;
    for (size_t i = begin + 1; i < end; ++i) {
        const double here = gain_of_two(sum_of(curve, begin, i), sum_of(curve, i, end));
        if (here <= gain) continue;
        gain = here;
        best = i;
    }
    if (best == begin) return;
    const double same = chance_of_same(sum_of(curve, begin, best), sum_of(curve, best, end));
    if (same * static_cast<double>(curve.size() - 1) >= kSignificance) return;
    cut(curve, begin, best, steps);
    steps.push_back(best);
    cut(curve, best, end, steps);
}

class Search {
public:
    Search(const TurningQuestion& question, const Ask& ask) : question_(question), ask_(ask) {}

    Result<Turning> run() {
        TRY(look());
        turning_.steps = find_steps(turning_.curve);
        if (turning_.steps.empty()) return turning_;
        turning_.turn = largest();
        TRY(narrow(*turning_.turn));
        choose(*turning_.turn);
        return turning_;
    }

private:
    // The curve over the grid. At the end itself everything is known: the condition has been met,
    // or no longer can be.
    Status look() {
        const auto steps = static_cast<size_t>(question_.end / question_.step);
        const size_t intervals = std::min(kInstantsMax - 1, steps);
        std::vector<Continuation> all;
        for (size_t i = 0; i < intervals; ++i) {
            const Time at = question_.step * static_cast<int64_t>(steps * i / intervals);
            turning_.curve.push_back({.at = at});
            add(all, at, 0);
        }
        const std::vector<bool> came = TRY(answer(all));
        const auto tries = static_cast<size_t>(question_.tries);
        for (size_t i = 0; i < all.size(); ++i) {
            count(turning_.curve[i / tries], all[i], came[i]);
        }
        const int known = question_.came ? question_.tries : 0;
        turning_.curve.push_back(
            {.at = question_.end, .share = {known, question_.tries}, .is_end = true});
        return Status::done();
    }

    void add(std::vector<Continuation>& all, Time at, int first) const {
        for (int i = first; i < first + question_.tries; ++i) {
            all.push_back({at, continuation_seed(at, i)});
        }
    }

    // None where it came true at the beginning: there is no instant before it.
    Result<std::vector<bool>> answer(const std::vector<Continuation>& all) {
        if (all.empty()) return std::vector<bool>();
        turning_.continuations += static_cast<int>(all.size());
        return ask_(all);
    }

    static void count(Point& point, const Continuation& one, bool came) {
        ++point.share.of;
        if (came) ++point.share.came;
        auto& seed = came ? point.with : point.without;
        if (!seed) seed = one.seed;
    }

    // Where the chances of two neighbouring steps differ most.
    Turn largest() const {
        const std::vector<size_t>& steps = turning_.steps;
        Turn turn;
        double change = -1;
        for (size_t i = 0; i < steps.size(); ++i) {
            const size_t begin = i == 0 ? 0 : steps[i - 1];
            const size_t end = i + 1 < steps.size() ? steps[i + 1] : turning_.curve.size();
            const Share early = sum_of(turning_.curve, begin, steps[i]);
            const Share late = sum_of(turning_.curve, steps[i], end);
            const double here = std::abs(early.value() - late.value());
            if (here <= change) continue;
            change = here;
            turn = {turning_.curve[steps[i] - 1], turning_.curve[steps[i]], early, late};
        }
        return turn;
    }

    Status narrow(Turn& turn) {
        for (int i = 0; i < kNarrowingsMax; ++i) {
            const Duration half = (turn.after.at - turn.before.at) / 2;
            const Time middle = turn.before.at + half / question_.step * question_.step;
            if (middle == turn.before.at) return Status::done();
            Point point{.at = middle};
            const double in_favour = TRY(weigh(turn, point));
            if (std::abs(in_favour) < std::log(kOdds)) break;
            (in_favour > 0 ? turn.before : turn.after) = point;
            narrowed_.push_back(point);
        }
        turn.narrowed = false;
        return Status::done();
    }

    void choose(Turn& turn) const {
        const auto later = [](std::optional<Continuation>& chosen, const Point& point,
                              const std::optional<uint64_t>& seed) {
            if (seed && (!chosen || point.at > chosen->at)) chosen = {point.at, *seed};
        };
        const auto look = [&](const std::vector<Point>& points) {
            for (const Point& point : points) {
                if (point.at > turn.before.at) continue;
                later(turn.with, point, point.with);
                later(turn.without, point, point.without);
            }
        };
        look(turning_.curve);
        look(narrowed_);
    }

    // How much more likely it is that this instant belongs to what was before.
    Result<double> weigh(const Turn& turn, Point& point) {
        double in_favour = 0;
        for (int i = 0; i < kRoundsMax && std::abs(in_favour) < std::log(kOdds); ++i) {
            std::vector<Continuation> all;
            add(all, point.at, i * question_.tries);
            const std::vector<bool> came = TRY(answer(all));
            for (size_t k = 0; k < all.size(); ++k) count(point, all[k], came[k]);
            in_favour = in_favour_of(turn.early, turn.late, point.share);
        }
        return in_favour;
    }

    const TurningQuestion& question_;
    const Ask& ask_;
    Turning turning_;
    std::vector<Point> narrowed_;  // besides the curve
};

}  // namespace

Share Turning::all() const {
    return sum_of(curve, 0, curve.size() - 1);
}

Result<Turning> find_turning(const TurningQuestion& question, const Ask& ask) {
    return Search(question, ask).run();
}

uint64_t continuation_seed(Time at, int number) {
    SplitMix64 of_instant(static_cast<uint64_t>(at.count()));
    return SplitMix64(of_instant.next() ^ static_cast<uint64_t>(number)).next() >> 1;
}

std::vector<size_t> find_steps(const std::vector<Point>& curve) {
    std::vector<size_t> steps;
    cut(curve, 0, curve.size(), steps);
    return steps;
}

}  // namespace vagus::trial
