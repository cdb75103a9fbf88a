#include "trial/turning_text.hpp"

#include <fmt/format.h>

#include <cmath>

#include "base/json.hpp"
#include "base/seconds.hpp"
#include "base/shell_word.hpp"

namespace vagus::trial {

namespace {

constexpr int kBar = 20;  // characters

std::string short_seconds(Time at) {
    return fmt::format("{:.3f}", seconds_of(at));
}

std::string count(const Share& share) {
    return fmt::format("{} of {}", share.came, share.of);
}

std::string point_line(const Point& point) {
    if (point.is_end) {
        return fmt::format("{:>11} s  {}\n", short_seconds(point.at),
                           point.share.came > 0 ? "it became true" : "the end: it never did");
    }
    const Interval likely = wilson(point.share);
    const auto full = static_cast<size_t>(std::lround(point.share.value() * kBar));
    return fmt::format("{:>11} s  {}{}  {:>10}  {:>4.0f} % to {:>3.0f} %\n",
                       short_seconds(point.at), std::string(full, '#'),
                       std::string(kBar - full, '.'), count(point.share), likely.low * 100,
                       likely.high * 100);
}

std::string describe_run(const TurningTold& told) {
    const std::string came =
        told.run.came ? fmt::format("became true at {} s", short_seconds(*told.run.came))
                      : fmt::format("did not become true by {} s", short_seconds(told.run.end));
    return fmt::format(
        "{}: {}{} {}\nof {} continuations from an instant, it became true after it in "
        "(95 % interval):\n",
        told.file, told.robot.empty() ? "" : told.robot + ": ", told.condition, came,
        told.question.tries);
}

std::string describe_flat(const Turning& turning) {
    const Share all = turning.all();
    if (all.of == 0) return "not decided by chance: there is no instant before it to continue from";
    if (all.came == all.of && all.of > 0) {
        return fmt::format("not decided by chance: it became true in all {} continuations", all.of);
    }
    if (all.came == 0) {
        return fmt::format("not decided by chance: it became true in none of {} continuations",
                           all.of);
    }
    return fmt::format(
        "not decided by chance: it became true in {} continuations, and no change "
        "over time is significant",
        count(all));
}

// A point of the curve that is its end counts as what it is known to be.
std::string describe_turn(const Turn& turn) {
    return fmt::format("it turned {} {} s and {} s: before in {}, from then on in {}",
                       turn.narrowed ? "between" : "little by little between",
                       short_seconds(turn.before.at), short_seconds(turn.after.at),
                       count(turn.before.share),
                       turn.after.is_end && turn.after.share.came == 0 ? "none"
                       : turn.after.is_end                             ? "all"
                                                                       : count(turn.after.share));
}

std::string describe_recordings(const TurningTold& told) {
    const auto line = [&](std::string_view name, const std::string& file,
                          const std::optional<Continuation>& drawn) {
        if (!drawn) return fmt::format("{:<7}  none was found, but {}\n", name, told.file);
        return fmt::format("{:<7}  {}  (--from {} --reseed {})\n", name, file,
                           short_seconds(drawn->at), drawn->seed);
    };
    const Turn& turn = *told.turning.turn;
    std::string text =
        line("with", told.with, turn.with) + line("without", told.without, turn.without);
    if (!told.with.empty() && !told.without.empty()) {
        text +=
            fmt::format("  vagus compare {} {}\n", shell_word(told.with), shell_word(told.without));
    }
    return text;
}

// ---- JSON ----

std::string share_json(const Share& share) {
    const Interval likely = wilson(share);
    return fmt::format(R"("came":{},"of":{},"low":{:.4f},"high":{:.4f})", share.came, share.of,
                       likely.low, likely.high);
}

std::string point_json(const Point& point) {
    return fmt::format(R"({{"t":{},{},"end":{}}})", seconds_text(point.at), share_json(point.share),
                       point.is_end);
}

std::string recording_json(const std::string& file, const std::optional<Continuation>& drawn) {
    if (!drawn) return "null";
    return fmt::format(R"({{"file":{},"from":{},"seed":{}}})", json_quote(file),
                       seconds_text(drawn->at), drawn->seed);
}

std::string turn_json(const TurningTold& told) {
    if (!told.turning.turn) return "null";
    const Turn& turn = *told.turning.turn;
    std::string there = record::format_chain_json(told.there);
    if (there.ends_with('\n')) there.pop_back();
    return fmt::format(
        R"({{"before":{},"after":{},"narrowed":{},"with":{},"without":{},"there":{}}})",
        point_json(turn.before), point_json(turn.after), turn.narrowed,
        recording_json(told.with, turn.with), recording_json(told.without, turn.without), there);
}

}  // namespace

std::string turning_sentence(const Turning& turning) {
    return turning.turn ? describe_turn(*turning.turn) : describe_flat(turning);
}

std::string format_turning(const TurningTold& told) {
    std::string text = describe_run(told);
    for (const Point& point : told.turning.curve) text += point_line(point);
    text += turning_sentence(told.turning) + "\n";
    if (!told.turning.turn) return text;
    for (const record::Link& link : told.there) text += record::format_link(link) + "\n";
    return text + describe_recordings(told);
}

std::string format_turning_json(const TurningTold& told) {
    std::string curve;
    for (const Point& point : told.turning.curve) {
        curve += (curve.empty() ? "\n" : ",\n") + point_json(point);
    }
    return fmt::format(
        R"({{{}"condition":{},"came":{},"end":{},"tries":{},"continuations":{},"curve":[{}],)"
        R"("turn":{}}})"
        "\n",
        told.robot.empty() ? "" : fmt::format(R"("robot":{},)", json_quote(told.robot)),
        json_quote(told.condition), told.run.came ? seconds_text(*told.run.came) : "null",
        seconds_text(told.run.end), told.question.tries, told.turning.continuations, curve,
        turn_json(told));
}

}  // namespace vagus::trial
