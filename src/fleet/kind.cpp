#include "fleet/kind.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/text.hpp"
#include "fleet/limits.hpp"
#include "fleet/topic.hpp"
#include "keeper/keeper.hpp"

namespace vagus::fleet {
namespace {

using T = FieldType;
constexpr Need kMust = Need::Required;
constexpr Need kMay = Need::Optional;
// Whole numbers that every program reads as such, whatever its numbers are.
constexpr double kWholeMax = 9'007'199'254'740'991;
constexpr double kLeaseMsMax = static_cast<double>(keeper::kLeaseMax / 1ms);

constexpr Field kEpoch = {
    "epoch",
    T::Int,
    kMust,
    0,
    kWholeMax,
    "",
    "of the robot's clock and numbers: another one after each start of its program"};
constexpr Field kNumber = {
    "number", T::Int, kMust, 1, kWholeMax, "", "counts up, for each robot and epoch"};

constexpr std::array kConnection = {
    Field{"state", T::Word, kMust, 0, 0, "online|offline|lost",
          "offline: it said so; lost: the broker missed it"},
    Field{"instance", T::Name, kMust, 0, 0, "", "of the program that speaks for the robot"},
    kEpoch};

constexpr std::array kDescription = {
    Field{"project", T::Line, kMust, 0, 0, "", "name of the project"},
    Field{"vagus", T::Line, kMust, 0, 0, "", "version of Vagus"},
    Field{"plan", T::Line, kMay, 0, 0, "", "file of the plan"},
    Field{"studio", T::Line, kMay, 0, 0, "",
          "address of the robot's own studio, without the token"},
    Field{"groups", T::Names, kMust, 0, kGroupsMax, "", ""},
    Field{"nodes", T::Names, kMust, 0, kNodesMax, "",
          "of the robot, as they are called on its bus"},
    Field{"send", T::Names, kMust, 0, kEventsMax, "", "events that it sends"},
    Field{"hear", T::Names, kMust, 0, kEventsMax, "", "events that it hears"}};

constexpr std::array kState = {
    kNumber,
    kEpoch,
    Field{"clock", T::Int, kMust, 0, kWholeMax, "", "the robot's monotonic clock, ms"},
    Field{"state", T::Word, kMust, 0, 0, "running|paused|stopped|fault", ""},
    Field{"since", T::Int, kMust, 0, kWholeMax, "", "of the same clock: since when"},
    Field{"actor", T::Line, kMay, 0, 0, "", "what its plan does"},
    Field{"problems", T::Lines, kMust, 0, kProblemsMax, "", "sentences; none: it is well"},
    Field{"left_out", T::Int, kMust, 0, kWholeMax, "",
          "events that were too many, too old, or did not fit, sent or heard"}};

constexpr std::array kVariable = {
    Field{"clock", T::Int, kMust, 0, kWholeMax, "", "the robot's monotonic clock, ms"}, kEpoch,
    Field{"values", T::Words, kMust, 0, kWordsMax, "", "one for each word"}};

constexpr std::array kEvent = {
    kNumber, kEpoch, Field{"groups", T::Names, kMust, 0, kGroupsMax, "", "of the sender"},
    Field{"args", T::Words, kMust, 0, kWordsMax, "", "arguments, as on the bus"}};

constexpr std::array kAsk = {
    Field{"instance", T::Name, kMust, 0, 0, "", "of the robot that wants this name"}};

constexpr std::array kAnswer = {
    Field{"id", T::Name, kMust, 0, 0, "", "of what is answered"},
    Field{"done", T::Bool, kMust, 0, 0, "", ""},
    Field{"what", T::Line, kMay, 0, 0, "", "why not: a sentence"},
    Field{"instance", T::Name, kMay, 0, 0, "", "of who has the name that was asked for"},
    Field{"silent", T::Names, kMay, 0, kNodesMax, "",
          "nodes of which it is not known that they have stopped"}};

constexpr std::array kCommand = {
    Field{"id", T::Name, kMust, 0, 0, "", "the same for a command that comes again"},
    Field{"reply", T::Name, kMust, 0, 0, "", "the answer comes on robot/R/answer/REPLY"},
    Field{"epoch", T::Int, kMay, 0, kWholeMax, "", "as the robot's state had it; not with stop"},
    Field{"deadline", T::Int, kMay, 0, kWholeMax, "",
          "ms of the robot's clock: not done later; not with stop"}};

constexpr std::array kSet = {
    Field{"node", T::Name, kMay, 0, 0, "", "of the variable; without: a variable of the plan"},
    Field{"name", T::Line, kMust, 0, 0, "", "of the variable"},
    Field{"values", T::Words, kMust, 1, kWordsMax, "", ""}};
constexpr std::array kRaise = {
    Field{"supervisor", T::Name, kMust, 0, 0, "", "of the plan, one that watches"},
    Field{"event", T::Name, kMust, 0, 0, "", "of that supervisor"}};
constexpr std::array kEmit = {Field{"event", T::Name, kMust, 0, 0, "", "of the project"},
                              Field{"args", T::Words, kMust, 0, kWordsMax, "", ""}};

constexpr std::array kQuestion = {kNumber, kEpoch};
constexpr Field kTerm = {"term", T::Term, kMust, 0, 0, "", "of the lease"};
constexpr Field kLength = {"length", T::Int, kMust, 0, kLeaseMsMax, "", "of the lease, ms"};
constexpr std::array kGive = {
    Field{"queue", T::Name, kMust, 0, 0, "", ""},
    Field{"id", T::Name, kMust, 0, 0, "", "the giver chooses it: given twice, it is there once"},
    Field{"data", T::Value, kMay, 0, 0, "", "what is to be done"}};
constexpr std::array kTake = {Field{"queue", T::Name, kMust, 0, 0, "", ""}, kLength};
constexpr std::array kClaim = {
    Field{"name", T::Name, kMust, 0, 0, "", "that one robot has at a time"}, kLength};
constexpr std::array kRenew = {kTerm};
constexpr std::array kFinish = {kTerm, Field{"result", T::Value, kMay, 0, 0, "", ""}};
constexpr std::array kWrite = {
    Field{"key", T::Name, kMust, 0, 0, "", ""},
    Field{"seen", T::Term, kMay, 0, 0, "", "the version that is overwritten; none: it is new"},
    Field{"value", T::Value, kMust, 0, 0, "", ""}};

constexpr std::array<VerbInfo, 7> kQuestions = {{
    {"give", "Keeps a task.", kGive},
    {"take", "The next task of a queue that waits, on a lease.", kTake},
    {"claim", "A name, on a lease.", kClaim},
    {"renew", "The lease lasts for another of its lengths.", kRenew},
    {"finish", "The task of that lease is done.", kFinish},
    {"release", "The lease is given back: a task waits again, a name is free.", kRenew},
    {"write", "A shared value, if nobody has written it since.", kWrite},
}};

constexpr std::array kReply = {
    Field{"number", T::Int, kMust, 0, kWholeMax, "", "of the question"},
    Field{"epoch", T::Int, kMust, 0, kWholeMax, "", "of the question"},
    Field{"outcome", T::Word, kMust, 0, 0, "done|nothing|refused",
          "nothing: no task waits, another has the name, or the version is another"},
    Field{"why", T::Line, kMay, 0, 0, "", "of nothing and refused: a sentence"},
    Field{"keeper", T::Int, kMust, 0, kWholeMax, "", "epoch of the keeper that replies"},
    Field{"topic", T::Line, kMay, 0, 0, "", "of the record that it is about"},
    Field{"record", T::Object, kMay, 0, 0, "", "as it is there now"}};

constexpr Field kHolder = {"robot", T::Name, kMay, 0, 0, "", "who has the lease"};
constexpr Field kHeldTerm = {"term", T::Term, kMay, 0, 0, "", "of the last lease"};
constexpr Field kHeldFor = {"length", T::Int, kMay, 0, kLeaseMsMax, "", "of the lease, ms"};

constexpr std::array kTask = {
    Field{"work", T::Word, kMust, 0, 0, "waiting|leased|done", ""},
    Field{"given", T::Term, kMust, 0, 0, "", "tasks are handed out in this order"},
    Field{"data", T::Value, kMay, 0, 0, "", "what is to be done"},
    kHolder,
    kHeldTerm,
    kHeldFor,
    Field{"result", T::Value, kMay, 0, 0, "", "of who has finished it"}};
constexpr std::array kShared = {
    Field{"is", T::Word, kMust, 0, 0, "value|name", "a name: that one robot has at a time"},
    Field{"version", T::Term, kMay, 0, 0, "", "of a value"},
    Field{"value", T::Value, kMay, 0, 0, "", ""},
    kHolder,
    kHeldTerm,
    kHeldFor};
constexpr std::array kBeat = {
    Field{"epoch", T::Int, kMust, 0, kWholeMax, "", "of the keeper: a later one has a higher one"},
    Field{"instance", T::Name, kMust, 0, 0, "", "of its process"},
    Field{"number", T::Int, kMust, 0, kWholeMax, "", "counts up"}};

constexpr Field kRollout = {
    "number", T::Int, kMust, 1, kWholeMax, "", "of the roll-out: another one each time"};
constexpr std::array kWant = {
    kRollout, Field{"sha256", T::Line, kMust, 0, 0, "", "of what is at the address"},
    Field{"address", T::Line, kMust, 0, 0, "",
          "to fetch it from by HTTPS; nobody else knows it, and it is good during the roll-out"},
    Field{"back", T::Bool, kMay, 0, 0, "", "true: instead, the version before is in force again"}};
constexpr std::array kVersion = {
    kRollout, Field{"sha256", T::Line, kMust, 0, 0, "", "as it was wanted"},
    Field{"result", T::Word, kMust, 0, 0, "taken|started|stopped|refused|rolled_back|waiting",
          "taken: it is being fetched and checked; waiting: it is in force, and does not run"},
    Field{"healthy", T::Word, kMay, 0, 0, "not_yet|well",
          "of started: whether the project's own condition has been true as long as it says; "
          "without it the project has none"},
    Field{"why", T::Line, kMay, 0, 0, "", "a sentence; of not_yet: what the condition lacks"}};

constexpr std::array kTellThis = {Field{"node", T::Name, kMust, 0, 0, "", "of the variable"},
                                  Field{"name", T::Line, kMust, 0, 0, "", "of the variable"}};

constexpr std::array<VerbInfo, 9> kVerbs = {{
    {"stop", "Everything stops. Repeated until it is answered; also to a group and to all.", {}},
    {"pause", "What runs is paused.", {}},
    {"continue", "What is paused goes on.", {}},
    {"start", "Scripts and plan start.", {}},
    {"set", "Writes a variable.", kSet},
    {"raise", "A supervisor of the plan raises an event.", kRaise},
    {"emit", "An event of the bus.", kEmit},
    {"tell", "A variable is told for a minute, as those under tell.", kTellThis},
    {"identify",
     "The event identify of the robot's project: it blinks, or whatever it does then.",
     {}},
}};

constexpr std::array<KindInfo, 15> kKinds = {{
    {Kind::Connection, Folder::Robot, "connection", 0, "robot/R/connection", 1, true,
     "Whether the robot is there; its last will says lost.", kConnection},
    {Kind::Description, Folder::Robot, "description", 0, "robot/R/description", 1, true,
     "What the robot is.", kDescription},
    {Kind::State, Folder::Robot, "state", 0, "robot/R/state", 1, true,
     "What the robot does: on each change, at least every 2 s, at most 5 a second.", kState},
    {Kind::Variable, Folder::Robot, "var", 2, "robot/R/var/NODE/NAME", 0, true,
     "A variable that the project lists under tell, when it changes, at most 5 a second.",
     kVariable},
    {Kind::Event, Folder::Robot, "event", 1, "robot/R/event/NAME", 1, false,
     "An event that a script of the robot emitted and its project lists under send.", kEvent},
    {Kind::Ask, Folder::Robot, "ask", 1, "robot/R/ask/name", 1, false,
     "Somebody who wants the name R asks who has it.", kAsk},
    {Kind::Answer, Folder::Robot, "answer", 1, "robot/R/answer/REPLY", 1, false,
     "The answer to a command; on answer/name: to robot/R/ask/name.", kAnswer},
    {Kind::Command, Folder::Command, "cmd", 1, "cmd/R/VERB", 1, false,
     "What somebody wants the robot R to do; stop also on cmd/group/G/stop and cmd/all/stop.",
     kCommand},
    {Kind::Question, Folder::Robot, "ask", 1, "robot/R/ask/QUESTION", 1, false,
     "What the robot R asks the keeper; asked again, with the same number, until it is answered.",
     kQuestion},
    {Kind::Reply, Folder::Keeper, "answer", 1, "keeper/answer/R", 1, false,
     "What the keeper replies to the robot R.", kReply},
    {Kind::Task, Folder::Task, "", 2, "task/QUEUE/ID", 1, true,
     "A task, and who has it: the keeper's alone.", kTask},
    {Kind::Shared, Folder::Shared, "", 1, "shared/KEY", 1, true,
     "A shared value, or a name that is claimed: the keeper's alone.", kShared},
    {Kind::Beat, Folder::Keeper, "beat", 0, "keeper/beat", 1, true,
     "A sign of life of the keeper, each second.", kBeat},
    {Kind::Want, Folder::Robot, "want", 0, "robot/R/want", 1, true,
     "The version that the robot should have; of an operator.", kWant},
    {Kind::Version, Folder::Robot, "version", 0, "robot/R/version", 1, true,
     "What became of the version that was wanted last.", kVersion},
}};

std::string list_of_words(std::string_view words) {
    const auto list = split(words, '|');
    return fmt::format("{}", fmt::join(list, ", "));
}

std::string expected(const Field& field) {
    switch (field.type) {
        case T::Bool:
            return "true or false";
        case T::Int:
            return fmt::format("a whole number from {:.0f} to {:.0f}", field.low, field.high);
        case T::Name:
            return fmt::format("a name of 1 to {} bytes", kNameBytesMax);
        case T::Line:
            return fmt::format("a text of at most {} bytes", kLineBytesMax);
        case T::Word:
            return "one of " + list_of_words(field.words);
        case T::Words:
            return fmt::format("{:.0f} to {:.0f} whole numbers of 16 bits", field.low, field.high);
        case T::Names:
            return fmt::format("at most {:.0f} names", field.high);
        case T::Lines:
            return fmt::format("at most {:.0f} texts", field.high);
        case T::Term:
            return "a term: EPOCH.NUMBER";
        case T::Value:
            return "any value";
        case T::Object:
            return "an object";
    }
    return "";
}

bool is_line(const JsonValue& value) {
    return value.kind == JsonKind::String && value.text.size() <= kLineBytesMax;
}

bool is_word_of_bus(const JsonValue& value) {
    return value.kind == JsonKind::Int && value.integer >= INT16_MIN && value.integer <= INT16_MAX;
}

bool is_name_value(const JsonValue& value) {
    return value.kind == JsonKind::String && is_name(value.text);
}

template <typename Fits>
bool all_fit(const JsonValue& value, const Field& field, Fits fits) {
    const auto count = static_cast<double>(value.items.size());
    if (value.kind != JsonKind::Array || count < field.low || count > field.high) return false;
    return std::all_of(value.items.begin(), value.items.end(), fits);
}

bool fits(const JsonValue& value, const Field& field) {
    switch (field.type) {
        case T::Bool:
            return value.kind == JsonKind::Bool;
        case T::Int:
            return value.kind == JsonKind::Int && value.number >= field.low &&
                   value.number <= field.high;
        case T::Name:
            return is_name_value(value);
        case T::Line:
            return is_line(value);
        case T::Word: {
            const auto words = split(field.words, '|');
            return value.kind == JsonKind::String &&
                   std::find(words.begin(), words.end(), value.text) != words.end();
        }
        case T::Words:
            return all_fit(value, field, is_word_of_bus);
        case T::Names:
            return all_fit(value, field, is_name_value);
        case T::Lines:
            return all_fit(value, field, is_line);
        case T::Term:
            return value.kind == JsonKind::String && keeper::read_term(value.text);
        case T::Value:
            return true;
        case T::Object:
            return value.kind == JsonKind::Object;
    }
    return false;
}

const VerbInfo* find(std::span<const VerbInfo> verbs, std::string_view verb) {
    const auto found = std::find_if(verbs.begin(), verbs.end(),
                                    [verb](const VerbInfo& one) { return one.verb == verb; });
    return found == verbs.end() ? nullptr : &*found;
}

std::string row_of(const Field& field) {
    return fmt::format("| `{}` | {}{} | {} |\n", field.name, expected(field),
                       field.need == Need::Optional ? ", or left out" : "", field.help);
}

std::string table_of(std::span<const Field> fields) {
    std::string table = "| member | value | meaning |\n| --- | --- | --- |\n";
    for (const Field& field : fields) table += row_of(field);
    return table;
}

}  // namespace

std::span<const KindInfo> kinds() {
    return kKinds;
}

const KindInfo& info_of(Kind kind) {
    return kKinds[static_cast<size_t>(kind)];
}

std::span<const VerbInfo> verbs() {
    return kVerbs;
}

const VerbInfo* verb_of(std::string_view verb) {
    return find(kVerbs, verb);
}

std::span<const VerbInfo> questions() {
    return kQuestions;
}

const VerbInfo* question_of(std::string_view verb) {
    return find(kQuestions, verb);
}

std::optional<std::string> fault_of(const JsonValue& value, std::span<const Field> fields) {
    if (value.kind != JsonKind::Object) {
        return fmt::format("expected an object, found {}", name_of(value.kind));
    }
    for (const Field& field : fields) {
        const JsonValue* member = value.find(field.name);
        if (member == nullptr && field.need == Need::Optional) continue;
        if (member == nullptr) {
            return fmt::format("\"{}\" is missing: expected {}", field.name, expected(field));
        }
        if (fits(*member, field)) continue;
        return fmt::format("\"{}\": expected {}, found {}", field.name, expected(field),
                           name_of(member->kind));
    }
    return std::nullopt;
}

std::string page_of_messages() {
    std::string page =
        "# Messages of a fleet\n\n"
        "Made by `fleet_page` from the list in `src/fleet/kind.cpp`; what they are for: "
        "[fleet.md](fleet.md). Topics stand below `vagus/1/FLEET/`. Payloads are JSON objects; "
        "members that are not listed are passed over.\n";
    for (const KindInfo& info : kKinds) {
        page += fmt::format("\n## {}\n\n{} QoS {}{}.\n\n", info.topic, info.help, info.qos,
                            info.retained ? ", retained" : "");
        page += table_of(info.fields);
    }
    for (const auto& [topic, list] :
         {std::pair("cmd/R", verbs()), std::pair("robot/R/ask", questions())}) {
        for (const VerbInfo& verb : list) {
            page += fmt::format("\n### {}/{}\n\n{}\n", topic, verb.verb, verb.help);
            if (!verb.fields.empty()) page += "\n" + table_of(verb.fields);
        }
    }
    return page;
}

}  // namespace vagus::fleet
