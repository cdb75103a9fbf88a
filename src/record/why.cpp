#include "record/why.hpp"

#include <fmt/format.h>

#include "base/json.hpp"
#include "base/seconds.hpp"
#include "record/damage.hpp"
#include "record/past_bus.hpp"
#include "record/past_run.hpp"
#include "record/why_walk.hpp"

namespace vagus::record {

namespace {

using About = Question::About;

// Each takes a run of its own, so not of a whole long chain.
Status tell_losers(const mcap::Reader& reader, const Causes& causes,
                   const std::vector<TiedLink>& ties, Chain& chain) {
    for (const auto& [link, bus, line] : ties) {
        if (link >= kTiesWithin) break;
        chain[link].lost = TRY(losers(reader, causes.bus(bus), line));
        if (!chain[link].lost.empty()) chain[link].what += " and " + won_against(chain[link].lost);
    }
    return Status::done();
}

// Of a real bus: what the plan decides otherwise than it did has no causes in the recording.
Status check_in_step(const mcap::Reader& reader, const Rerun& rerun, std::optional<Time> at) {
    if (rerun.past_bus() == nullptr) return Status::done();
    const std::optional<Time> parted = rerun.past_bus()->parted();
    if (!parted || *parted > at.value_or(rerun.recorded_until())) return Status::done();
    return Error{Code::Refused,
                 fmt::format("{}: at {} s the plan decides otherwise than it did (`vagus replay` "
                             "tells what), so nothing can be told of what came after it; ask about "
                             "an earlier instant, with --at",
                             reader.name(), seconds_text(*parted))};
}

}  // namespace

Result<Question> read_question(const std::vector<std::string>& words) {
    const auto fails = [](const std::string& found) {
        return Error{Code::BadInput,
                     "expected a question: actor NAME, variable NODE.NAME, variable NAME, motor "
                     "ROBOT, event NAME, or end; found " +
                         found};
    };
    if (words.empty()) return fails("nothing");
    static const std::vector<std::pair<std::string_view, About>> kWords = {
        {"actor", About::Actor},
        {"variable", About::Variable},
        {"motor", About::Motor},
        {"event", About::Event}};
    if (words.size() == 1 && words[0] == "end") return Question{About::End};
    for (const auto& [word, about] : kWords) {
        if (words[0] == word && words.size() == 2) return Question{about, words[1]};
    }
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
    return fails("\"" + all + "\"");
}

Result<Chain> why(const mcap::Reader& reader, const Question& question, std::optional<Time> at) {
    // Of a run that goes on there is what was written by now.
    if (!is_whole(reader)) at = std::min(at.value_or(Time::max()), end_of(reader));
    std::unique_ptr<Rerun> rerun = TRY(Rerun::open(reader, {.until = at}));
    std::optional<Result<Chain>> answer;
    std::vector<TiedLink> ties;
    Causes* seen = nullptr;
    const auto answer_now = [&] {
        Walk walk(*seen);
        answer = walk.answer(question);
        ties = walk.ties();
    };
    // A plan alone has no instants but those of its lines: before the first that comes later.
    rerun->listen([&](const plan::TraceEvent& event) {
        if (at && event.at > *at && !answer) answer_now();
    });
    Causes causes(*rerun);
    seen = &causes;
    NullTape tape;
    // At its instant, before the run is ended for it.
    if (at) {
        rerun->each_instant([&](Time now) {
            if (now >= *at && !answer) answer_now();
        });
        rerun->when_paused_at_end([&] {
            if (!answer) answer_now();
        });
    }
    (void)TRY(rerun->run(tape));
    TRY(check_in_step(reader, *rerun, at));
    if (!answer) answer_now();
    if (answer->ok()) TRY(tell_losers(reader, causes, ties, answer->value()));
    return *answer;
}

std::string format_link(const Link& link) {
    std::string text = fmt::format("{:>11} s  {}{}{}", fmt::format("{:.3f}", seconds_of(link.at)),
                                   link.robot, link.robot.empty() ? "" : ": ", link.what);
    if (!link.value.empty()) text += " (" + link.value + ")";
    if (!link.place.empty()) text += "  " + link.place;
    return text;
}

std::string format_chain_json(const Chain& chain) {
    std::string text = "[";
    for (const Link& link : chain) {
        std::string lost;
        for (const Loser& one : link.lost) {
            lost += fmt::format(R"({}{{"{}":{},"{}":{},"place":{}}})", lost.empty() ? "" : ",",
                                one.actor ? "actor" : "supervisor", json_quote(one.name),
                                one.actor ? "state" : "event", json_quote(one.outcome),
                                json_quote(one.place));
        }
        if (!lost.empty()) lost = ",\"lost\":[" + lost + "]";
        if (link.guessed) lost += ",\"guessed\":true";
        if (!link.robot.empty()) lost += ",\"robot\":" + json_quote(link.robot);
        text +=
            fmt::format(R"({}{{"t":{},"what":{},"place":{},"value":{},"root":{},"element":{}{}}})",
                        text.size() > 1 ? ",\n" : "\n", seconds_text(link.at),
                        json_quote(link.what), json_quote(link.place), json_quote(link.value),
                        link.root, json_quote(link.element), lost);
    }
    return text + "\n]\n";
}

}  // namespace vagus::record
