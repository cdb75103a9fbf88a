#include "cli/plan/debug_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/nearest.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "cli/screen/degrees.hpp"

namespace vagus::cli {

namespace {

using Kind = run::Breakpoint::Kind;

const std::vector<std::string> kKinds = {"actor", "state", "event", "when"};

std::string_view words_of(plan::Phase phase) {
    switch (phase) {
        case plan::Phase::Pending:
            return "is about to begin";
        case plan::Phase::Running:
            return "runs";
        case plan::Phase::SubEnded:
            return "has ended";
        case plan::Phase::Stopping:
            return "is being stopped";
        case plan::Phase::None:
            return "is over";
    }
    return "";
}

std::string line_of(const run::LevelNow& level) {
    return fmt::format("{}: {} (activation {}) {}", level.path, level.actor, level.activation,
                       words_of(level.phase));
}

Result<uint64_t> parse_count(const std::string& text) {
    const auto count = plan::int_from_digits(text);
    if (count && *count > 0) return static_cast<uint64_t>(*count);
    return Error{Code::BadInput,
                 fmt::format("count \"{}\": expected a whole number from 1, as count 3", text)};
}

// `count N` at the end of a condition: no formula ends so.
Status take_count_behind(std::string_view& condition, run::Breakpoint& made) {
    const size_t last = condition.rfind(' ');
    if (last == std::string_view::npos) return Status::done();
    const std::string_view before = trimmed(condition.substr(0, last), " ");
    if (!before.ends_with(" count")) return Status::done();
    made.stop_at = TRY(parse_count(std::string(condition.substr(last + 1))));
    condition = trimmed(before.substr(0, before.size() - 6), " ");
    return Status::done();
}

Result<run::Breakpoint> finish(run::Breakpoint made, std::string_view rest) {
    for (std::string word = take_word(rest); !word.empty(); word = take_word(rest)) {
        if (word == "if") {
            std::string_view condition = trimmed(rest, " ");
            TRY(take_count_behind(condition, made));
            made.condition = std::string(condition);
            if (!made.condition.empty()) return made;
            return Error{Code::BadInput, "if: expected a condition behind it, as if speed > 3"};
        }
        if (word == "count") {
            made.stop_at = TRY(parse_count(take_word(rest)));
        } else if (made.outcome.empty() && made.kind != Kind::Actor) {
            made.outcome = word;
        } else {
            return Error{Code::BadInput,
                         fmt::format("\"{}\" is too much here; what may follow is count N and if "
                                     "CONDITION",
                                     word)};
        }
    }
    return made;
}

}  // namespace

std::string take_word(std::string_view& rest) {
    rest = trimmed(rest, " ");
    char quote = 0;
    size_t length = 0;
    for (; length < rest.size(); ++length) {
        const char c = rest[length];
        if (quote == 0 && c == ' ') break;
        if (quote == 0 && (c == '"' || c == '\'')) {
            quote = c;
        } else if (c == quote) {
            quote = 0;
        }
    }
    std::string word(rest.substr(0, length));
    rest = trimmed(rest.substr(length), " ");
    return word;
}

Result<run::Breakpoint> parse_breakpoint(std::string_view text) {
    run::Breakpoint made;
    std::string word = take_word(text);
    if (word == "in") {
        made.plan = take_word(text);
        word = take_word(text);
    }
    if (word == "when") {
        made.kind = Kind::Condition;
        std::string_view condition = trimmed(text, " ");
        TRY(take_count_behind(condition, made));
        made.condition = std::string(condition);
        return made;
    }
    if (word != "actor" && word != "state" && word != "event") {
        const std::string near = nearest(word, kKinds);
        return Error{
            Code::BadInput,
            fmt::format("break \"{}\": expected actor, state, event or when{}; as break "
                        "actor turn",
                        word, near.empty() ? "" : fmt::format("; did you mean {}?", near))};
    }
    made.kind = word == "actor" ? Kind::Actor : word == "state" ? Kind::State : Kind::Event;
    made.element = take_word(text);
    if (made.element.empty()) {
        return Error{Code::BadInput,
                     fmt::format("break {}: the name of {} is missing", word,
                                 made.kind == Kind::Event ? "a supervisor" : "an actor")};
    }
    return finish(std::move(made), text);
}

std::string text_of(const run::Breakpoint& breakpoint) {
    const auto kind = static_cast<size_t>(breakpoint.kind);
    const bool when = breakpoint.kind == Kind::Condition;
    std::string text = fmt::format("{} in {} {} {}", breakpoint.id, breakpoint.plan, kKinds[kind],
                                   when ? breakpoint.condition : breakpoint.element);
    if (!breakpoint.outcome.empty()) text += " " + breakpoint.outcome;
    if (breakpoint.stop_at > 1) text += fmt::format(" count {}", breakpoint.stop_at);
    if (!when && !breakpoint.condition.empty()) text += " if " + breakpoint.condition;
    text += fmt::format(": {} hit{}", breakpoint.hits, breakpoint.hits == 1 ? "" : "s");
    if (!breakpoint.enabled) text += ", disabled";
    if (!breakpoint.trouble.empty()) {
        text += fmt::format(", its condition does not hold because {}", breakpoint.trouble);
    }
    return text + "\n";
}

std::string value_text(const plan::Value& value) {
    if (value.type() == plan::Type::Object) {
        return value.object() ? fmt::format("an object of kind {}", value.object()->tag())
                              : "no object";
    }
    const std::string text = plan::text_of(value).value();
    return value.type() == plan::Type::String ? '"' + text + '"' : text;
}

std::string text_of(const run::Stopped& stopped) {
    const run::Where& where = stopped.where;
    if (where.levels.empty()) return "before the start\n";
    std::string why;
    switch (stopped.why) {
        case run::Stopped::Why::Breakpoint:
            why = fmt::format("breakpoint {}, ", fmt::join(stopped.breakpoints, ", "));
            break;
        case run::Stopped::Why::Start:
        case run::Stopped::Why::Asked:
        case run::Stopped::Why::Instant:
        case run::Stopped::Why::Step:
            break;
    }
    return fmt::format("{}paused at {}, {}\n", why, seconds_text(where.at),
                       line_of(where.levels.back()));
}

std::string text_of(const run::RunOver& over) {
    return fmt::format("the run is over at {}: {}{}\n", seconds_text(over.at),
                       plan::name_of(over.result), over.message.empty() ? "" : ", " + over.message);
}

std::string variables_of(const run::LevelNow& level) {
    std::string text;
    for (const run::VariableNow& variable : level.variables) {
        text += fmt::format("{} = {} ({})\n", variable.name, value_text(variable.value),
                            plan::name_of(variable.type));
    }
    return text;
}

std::string text_of(const sim::RobotView& robot) {
    return fmt::format("{} is at {:.2f}, {:.2f} m, {} deg\n", robot.name, robot.pose.at.x,
                       robot.pose.at.y, degrees_shown(robot.pose.angle));
}

std::string text_of(const run::Where& where) {
    if (where.levels.empty()) return "before the start\n";
    std::string text =
        fmt::format("{} at {}\n", where.paused ? "paused" : "runs", seconds_text(where.at));
    for (size_t i = 0; i < where.levels.size(); ++i) {
        text += fmt::format("{} {}\n", i, line_of(where.levels[i]));
        for (const run::SupervisorNow& supervisor : where.levels[i].supervisors) {
            text += fmt::format(
                "    {}{} {}: {}\n", supervisor.name, supervisor.global ? " (global)" : "",
                supervisor.watching ? "watches" : "rests", fmt::join(supervisor.events, ", "));
        }
    }
    return text;
}

// ---- events that wait ----

namespace {

Result<std::optional<uint64_t>> held_number(const std::string& word) {
    if (word.empty() || word == "all") return std::optional<uint64_t>();
    if (const auto number = decimal_number(word)) return number;
    return Error{
        Code::BadInput,
        fmt::format("\"{}\" is not the number of an event that waits; `held` shows them", word)};
}

}  // namespace

Result<run::Request> parse_held(std::string_view text) {
    const std::string act = take_word(text);
    const std::string which = take_word(text);
    const std::optional<uint64_t> number = TRY(held_number(which));
    if (act == "go") return run::Request(run::LetGo{number});
    if (act == "step" && which != "all") return run::Request(run::StepEvent{number});
    if (act == "drop" && !which.empty()) return run::Request(run::DropHeld{number});
    return Error{Code::BadInput,
                 fmt::format("held {}: expected go, go N, step, step N, drop N or drop all", act)};
}

std::string text_of(const run::HeldNow& held) {
    if (held.events.empty()) return "no event of the bus waits for the plan\n";
    std::string text;
    for (const run::HeldEvent& one : held.events) {
        const std::string from =
            one.event.from == 0 ? "a host" : fmt::format("node {}", one.event.from);
        text += fmt::format("{} {} [{}] from {}\n", one.number, one.event.name,
                            fmt::join(one.event.arguments, ", "), from);
    }
    if (held.dropped > 0) {
        text += fmt::format("{} more were dropped: no more than {} can wait\n", held.dropped,
                            run::kHeldEventsMax);
    }
    return text;
}

}  // namespace vagus::cli
