// Answers why something is as it is, as a chain of happenings, the newest first, each with where it
// is written: down to something in the world, a person, a timer, or the beginning.
//
//     const Question question = TRY(read_question({"motor", "carbot"}));
//     const Chain chain = TRY(why(reader, question, std::nullopt));
//     for (const Link& link : chain) print(format_link(link));
//
// The run is run again up to the instant in question (replay.hpp), and its scripts are followed
// instruction by instruction. Of a real bus only its plan is; the rest is told by frames
// (why_bus.cpp).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mcap/reader.hpp"
#include "record/causes.hpp"
#include "record/ties.hpp"

namespace vagus::record {

constexpr size_t kLinksMax = 1000;  // of a chain; what is beyond is said, not shown

constexpr size_t kTiesWithin = 50;  // newest links: there it is told who lost (ties.hpp)

constexpr size_t kMomentMax = 12;  // links of a moment

struct Link {
    Time at{};
    std::string what;          // a sentence without its full stop
    std::string place;         // "carbot/carbot.aesl:42", "WallFollow.plan.json:61"; empty: nowhere
    std::string value;         // of what it wrote or carried; empty: none
    bool root = false;         // nothing in the run comes before it
    std::string element = {};  // of the plan at that place; empty: none
    std::vector<Loser> lost = {};  // to the event of that element, at the same instant
    bool guessed =
        false;  // of a real bus: no frame tells it, but a script has no other place for it
    std::string robot = {};  // of robots with projects of their own: whose it is; empty: nobody's
    friend bool operator==(const Link&, const Link&) = default;
};
using Chain = std::vector<Link>;

struct Question {
    enum class About { Actor, Variable, Motor, Event, End };
    About about = About::End;
    std::string name = {};   // of robots with projects of their own also "ROBOT/NAME"
    std::string robot = {};  // of those: whose; empty: the only one that has it
};

// "actor NAME", "variable NODE.NAME" or "variable NAME", "motor ROBOT", "event NAME", "end".
Result<Question> read_question(const std::vector<std::string>& words);

// At the end of the recording, unless `at` says when. The Error says what is not there, and what
// there is; or that several robots have it.
Result<Chain> why(const mcap::Reader& reader, const Question& question, std::optional<Time> at);

// What there was at a moment, after one instant and by another one: the actors that were active,
// and then what happened: what scripts drew with math.rand, decisions of the plan, happenings in
// the world, handlers that ran. The first kMomentMax of these. Of robots with projects of their
// own: the actors of that one, and of each kind what happened with it before the others.
Result<Chain> moment(const mcap::Reader& reader, Time after, Time by,
                     const std::string& robot = "");

// One line, and a JSON array.
std::string format_link(const Link& link);
std::string format_chain_json(const Chain& chain);

}  // namespace vagus::record
