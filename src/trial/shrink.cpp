#include "trial/shrink.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "sim/chaos_file.hpp"

namespace vagus::trial {

namespace {

constexpr Duration kGrid = std::chrono::milliseconds(10);  // times that people can read

Duration half_of(Duration span) {
    return std::max(span / 2 / kGrid * kGrid, kGrid);
}

class Shrinker {
public:
    Shrinker(const Breaks& breaks, size_t runs_max) : breaks_(breaks), runs_max_(runs_max) {}

    Shrunk shrink(Faults faults, Time failed_at) {
        keep(std::move(faults), failed_at);
        remove_faults();
        for (size_t i = 0; i < least_.faults.size(); ++i) {
            shorten(i);
            weaken(i);
        }
        return least_;
    }

private:
    // What cannot have mattered goes without a run.
    void keep(Faults faults, Time failed_at) {
        std::erase_if(faults, [failed_at](const auto& one) { return one.from > failed_at; });
        for (sim::ChaosFault& one : faults) {
            const Time behind = (failed_at / kGrid + 1) * kGrid;
            if (!sim::is_instant(one.kind))
                one.until = std::min(one.until.value_or(behind), behind);
        }
        least_.faults = std::move(faults);
        least_.failed_at = failed_at;
    }

    // Whether it still fails; then it is the least one so far.
    bool try_with(Faults faults) {
        if (least_.runs >= runs_max_) return false;
        if (!tried_.insert(sim::format_chaos(faults)).second) return false;
        ++least_.runs;
        const std::optional<Time> failed_at = breaks_(faults);
        if (failed_at) keep(std::move(faults), *failed_at);
        return failed_at.has_value();
    }

    // Delta debugging (Zeller and Hildebrandt 2002): a part alone, or all but a part; the latest
    // first, for what broke last is the likeliest.
    void remove_faults() {
        size_t parts = 2;
        while (least_.faults.size() >= 2 && parts <= least_.faults.size()) {
            if (try_parts(parts, Which::Alone)) {
                parts = 2;
            } else if (parts > 2 && try_parts(parts, Which::Without)) {
                parts = std::max<size_t>(parts - 1, 2);
            } else if (parts == least_.faults.size()) {
                return;
            } else {
                parts = std::min(parts * 2, least_.faults.size());
            }
        }
    }

    enum class Which : uint8_t { Alone, Without };
    bool try_parts(size_t parts, Which which) {
        const Faults all = least_.faults;
        for (size_t part = parts; part-- > 0;) {
            const size_t first = all.size() * part / parts;
            const size_t end = all.size() * (part + 1) / parts;
            Faults some;
            for (size_t i = 0; i < all.size(); ++i) {
                const bool inside = i >= first && i < end;
                if (inside == (which == Which::Alone)) some.push_back(all[i]);
            }
            if (try_with(std::move(some))) return true;
        }
        return false;
    }

    // What a fault does at an instant does not hang on when it began: so the end is found by
    // halving, then the beginning.
    void shorten(size_t index) {
        if (index >= least_.faults.size() || sim::is_instant(least_.faults[index].kind)) return;
        Time too_short = least_.faults[index].from;
        while (is_there(index) && *least_.faults[index].until - too_short > kShortestFault) {
            const Time middle = too_short + half_of(*least_.faults[index].until - too_short);
            Faults shorter = least_.faults;
            shorter[index].until = middle;
            if (!try_with(std::move(shorter))) too_short = middle;
        }
        if (!is_there(index)) return;
        Time too_late = *least_.faults[index].until;
        while (is_there(index) && too_late - least_.faults[index].from > kShortestFault) {
            const Time middle =
                least_.faults[index].from + half_of(too_late - least_.faults[index].from);
            Faults later = least_.faults;
            later[index].from = middle;
            if (!try_with(std::move(later))) too_late = middle;
        }
    }

    bool is_there(size_t index) const { return index < least_.faults.size(); }

    void weaken(size_t index) {
        for (int i = 0; i < kHalvingsMax; ++i) {
            if (index >= least_.faults.size()) return;
            Faults weaker = least_.faults;
            sim::ChaosFault& fault = weaker[index];
            if (fault.by <= 0) return;
            const double least = fault.kind == sim::ChaosKind::Noisy ? 1 : 0.001;
            fault.by = std::round(fault.by / 2 / least) * least;
            if (fault.by < least || !try_with(std::move(weaker))) return;
        }
    }

    const Breaks& breaks_;
    size_t runs_max_;
    Shrunk least_;
    std::set<std::string> tried_;
};

}  // namespace

Shrunk shrink(Faults faults, Time failed_at, const Breaks& breaks, size_t runs_max) {
    return Shrinker(breaks, runs_max).shrink(std::move(faults), failed_at);
}

}  // namespace vagus::trial
