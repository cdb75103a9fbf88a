#include "sim/chaos.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "base/nearest.hpp"
#include "base/rng.hpp"
#include "base/text.hpp"

namespace vagus::sim {

namespace {

struct Word {
    ChaosKind kind;
    std::string_view name;
};

// The one list of kinds, as they are drawn.
constexpr Word kWords[] = {{ChaosKind::Lost, "lost"},
                           {ChaosKind::Doubled, "doubled"},
                           {ChaosKind::Delayed, "delayed"},
                           {ChaosKind::Reordered, "reordered"},
                           {ChaosKind::Reset, "reset"},
                           {ChaosKind::Hung, "hung"},
                           {ChaosKind::Unplugged, "unplugged"},
                           {ChaosKind::Stuck, "stuck"},
                           {ChaosKind::Noisy, "noisy"},
                           {ChaosKind::Dead, "dead"},
                           {ChaosKind::Slow, "slow"}};

bool is_main(std::string_view where) {
    return where.empty() || where == kMainComputer || where.ends_with("/main");
}

std::string link_of(const ChaosFault& fault) {
    if (!is_main(fault.where)) return "the link of " + fault.where;
    return fault.where.ends_with("/main") ? "the link of " + fault.where
                                          : "the link of the main computer";
}

std::string computer_of(const ChaosFault& fault) {
    return fault.where.ends_with("/main") ? fault.where : "the main computer";
}

std::string share_of(const ChaosFault& fault) {
    return fault.chance >= 1 ? "all of its frames"
                             : fmt::format("{:.4g} % of its frames", fault.chance * 100);
}

}  // namespace

std::string_view name_of(ChaosKind kind) {
    for (const Word& word : kWords) {
        if (word.kind == kind) return word.name;
    }
    return "";
}

const std::vector<ChaosKind>& chaos_kinds() {
    static const std::vector<ChaosKind> kKinds = [] {
        std::vector<ChaosKind> kinds;
        for (const Word& word : kWords) kinds.push_back(word.kind);
        return kinds;
    }();
    return kKinds;
}

Result<std::vector<ChaosKind>> parse_chaos_kinds(std::string_view text) {
    std::vector<std::string> known;
    for (const ChaosKind kind : chaos_kinds()) known.emplace_back(name_of(kind));
    std::vector<ChaosKind> kinds;
    for (const std::string_view word : split(text, ',')) {
        const auto found = std::ranges::find(known, word);
        if (found == known.end()) {
            return Error{Code::BadInput, fmt::format("there is no kind of fault \"{}\"; {}", word,
                                                     known_instead(word, known))};
        }
        kinds.push_back(chaos_kinds()[static_cast<size_t>(found - known.begin())]);
    }
    return kinds;
}

bool is_of_link(ChaosKind kind) {
    return kind == ChaosKind::Lost || kind == ChaosKind::Doubled || kind == ChaosKind::Delayed ||
           kind == ChaosKind::Reordered;
}

bool is_of_sensor(ChaosKind kind) {
    return kind == ChaosKind::Stuck || kind == ChaosKind::Noisy || kind == ChaosKind::Dead;
}

bool is_instant(ChaosKind kind) {
    return kind == ChaosKind::Reset || kind == ChaosKind::Hung;
}

std::optional<Time> end_of(const ChaosFault& fault) {
    if (fault.kind == ChaosKind::Reset) return fault.from;
    if (fault.kind == ChaosKind::Hung) return fault.from + kWatchdog;
    return fault.until;
}

// ---- sentences ----

std::string began_sentence(const ChaosFault& fault) {
    switch (fault.kind) {
        case ChaosKind::Lost:
            return fmt::format("{} loses {}", link_of(fault), share_of(fault));
        case ChaosKind::Doubled:
            return fmt::format("{} doubles {}", link_of(fault), share_of(fault));
        case ChaosKind::Delayed:
            return fmt::format("{} is {:g} s late", link_of(fault), fault.by);
        case ChaosKind::Reordered:
            return fmt::format("{} holds back {}, by up to {:g} s", link_of(fault), share_of(fault),
                               fault.by);
        case ChaosKind::Reset:
            return fmt::format("{} is reset", fault.where);
        case ChaosKind::Hung:
            return fmt::format("{} hangs", fault.where);
        case ChaosKind::Unplugged:
            return fmt::format("{} is unplugged", fault.where);
        case ChaosKind::Stuck:
            return fmt::format("{} of {} is stuck", fault.sensor, fault.where);
        case ChaosKind::Noisy:
            return fmt::format("{} of {} is noisy, by {:g}", fault.sensor, fault.where, fault.by);
        case ChaosKind::Dead:
            return fmt::format("{} of {} is dead", fault.sensor, fault.where);
        case ChaosKind::Slow:
            return fmt::format("{} is slow, by {:g} s", computer_of(fault), fault.by);
    }
    return "";
}

std::string ended_sentence(const ChaosFault& fault) {
    if (fault.kind == ChaosKind::Slow) return computer_of(fault) + " is as fast as before";
    if (fault.kind == ChaosKind::Hung) return "the watchdog of " + fault.where + " resets it";
    if (fault.kind == ChaosKind::Unplugged) return fault.where + " is plugged in again";
    if (is_of_sensor(fault.kind)) {
        return fmt::format("{} of {} works again", fault.sensor, fault.where);
    }
    return link_of(fault) + " works again";
}

// ---- what can break ----

bool is_sensor(std::string_view variable) {
    constexpr std::string_view kNone[] = {"id", "source", "args", "energy"};
    constexpr std::string_view kSetByOthers[] = {
        "_",       "event.", "motion.", "odometry.",  "timer.",
        "button.", "speed.", "sd.",     "prox.comm.", "mic.threshold"};
    return !variable.ends_with(".target") &&
           std::ranges::find(kNone, variable) == std::end(kNone) &&
           std::ranges::none_of(kSetByOthers, [variable](std::string_view beginning) {
               return variable.starts_with(beginning);
           });
}

namespace {

// Draws one set. Times are whole hundredths of a second, so that people can read them.
class Draw {
public:
    Draw(const std::vector<ChaosTarget>& targets, const ChaosDraw& how, uint64_t seed)
        : targets_(targets), random_(seed), within_(how.within) {
        for (const ChaosTarget& target : targets_) {
            for (const std::string& sensor : target.sensors) {
                sensors_.emplace_back(target.node, sensor);
            }
        }
        for (const ChaosKind kind : how.kinds.empty() ? chaos_kinds() : how.kinds) {
            if (!is_of_sensor(kind) || !sensors_.empty()) kinds_.push_back(kind);
        }
    }

    bool has_kinds() const { return !kinds_.empty(); }

    ChaosFault next() {
        ChaosFault fault;
        fault.kind = kinds_[random_.below(kinds_.size())];
        place(fault);
        fault.from = hundredths({}, within_);
        if (!is_instant(fault.kind)) {
            constexpr Duration kShortest = std::chrono::milliseconds(50);
            constexpr Duration kLongest = std::chrono::seconds(5);
            fault.until = fault.from + hundredths(kShortest, kLongest);
        }
        strength(fault);
        fault.seed = random_.below(1'000'000);
        return fault;
    }

private:
    Duration hundredths(Duration least, Duration most) {
        constexpr Duration kHundredth = std::chrono::milliseconds(10);
        const auto span = static_cast<uint64_t>(std::max<int64_t>((most - least) / kHundredth, 1));
        return least + kHundredth * static_cast<int64_t>(random_.below(span));
    }

    void place(ChaosFault& fault) {
        if (fault.kind == ChaosKind::Slow) return;
        if (is_of_sensor(fault.kind)) {
            std::tie(fault.where, fault.sensor) = sensors_[random_.below(sensors_.size())];
            return;
        }
        const size_t places = targets_.size() + (is_of_link(fault.kind) ? 1 : 0);
        const size_t chosen = random_.below(places);
        fault.where = chosen < targets_.size() ? targets_[chosen].node : kMainComputer;
    }

    void strength(ChaosFault& fault) {
        constexpr double kChances[] = {0.1, 0.3, 0.5, 1};
        constexpr double kDelays[] = {0.02, 0.05, 0.1, 0.2, 0.5, 1};
        constexpr double kNoises[] = {10, 30, 100, 300, 1000};
        const uint64_t drawn = random_.next();
        if (fault.kind == ChaosKind::Lost || fault.kind == ChaosKind::Doubled ||
            fault.kind == ChaosKind::Reordered) {
            fault.chance = kChances[drawn % std::size(kChances)];
        }
        if (fault.kind == ChaosKind::Delayed || fault.kind == ChaosKind::Slow) {
            fault.by = kDelays[drawn % std::size(kDelays)];
        }
        if (fault.kind == ChaosKind::Reordered) fault.by = kChaosMixUnlessSaid;
        if (fault.kind == ChaosKind::Noisy) fault.by = kNoises[drawn % std::size(kNoises)];
    }

    const std::vector<ChaosTarget>& targets_;
    SplitMix64 random_;
    Duration within_;
    std::vector<std::pair<std::string, std::string>> sensors_;  // node and variable
    std::vector<ChaosKind> kinds_;
};

}  // namespace

uint64_t chaos_seed(const ChaosFault& fault, uint64_t seed, uint64_t stream) {
    SplitMix64 mixed(seed);
    return SplitMix64(mixed.next() ^ SplitMix64(fault.seed * 4 + stream).next()).next();
}

std::vector<ChaosFault> draw_chaos(const std::vector<ChaosTarget>& targets, const ChaosDraw& draw,
                                   uint64_t seed) {
    std::vector<ChaosFault> faults;
    Draw drawing(targets, draw, draw.seed.value_or(seed));
    if (targets.empty() || !drawing.has_kinds()) return faults;
    for (size_t i = 0; i < draw.count; ++i) faults.push_back(drawing.next());
    std::ranges::stable_sort(faults, {}, &ChaosFault::from);
    return faults;
}

}  // namespace vagus::sim
