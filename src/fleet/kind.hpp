// The messages of a fleet, written once: which topic each has, what it holds, how it travels. The
// checks at the border (message.hpp) and the tables of docs/fleet-messages.md are made from it.
//
//     for (const KindInfo& info : kinds()) show(info.topic, info.help);
//     const auto fault = fault_of(json, info_of(Kind::Event).fields);
//     if (fault) complain(*fault);
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/json.hpp"
#include "base/json_object.hpp"

namespace vagus::fleet {

enum class Kind {
    Connection,
    Description,
    State,
    Variable,
    Event,
    Ask,
    Answer,
    Command,
    Question,  // to the keeper
    Reply,     // of the keeper
    Task,
    Shared,
    Beat,
    Want,    // the version that a robot should have
    Version  // what became of it
};

enum class FieldType {
    Bool,
    Int,    // from low to high
    Name,   // fleet/topic.hpp
    Line,   // a text of at most kLineBytesMax bytes
    Word,   // one of `words`, with | between
    Words,  // values of the bus: whole numbers of 16 bits, at most `high` of them
    Names,  // at most `high` names
    Lines,  // at most `high` lines
    Term,   // of the keeper: EPOCH.NUMBER
    Value,  // any value
    Object
};

struct Field {
    std::string_view name;
    FieldType type = FieldType::Line;
    Need need = Need::Required;
    double low = 0, high = 0;
    std::string_view words = "";
    std::string_view help = "";
};

// The first level of a topic below vagus/1/FLEET/.
enum class Folder { Robot, Command, Shared, Task, Keeper };

struct KindInfo {
    Kind kind = Kind::State;
    Folder folder = Folder::Robot;
    std::string_view word;   // the level that says what it is
    size_t names = 0;        // levels behind it
    std::string_view topic;  // for people: robot/R/var/NODE/NAME
    int qos = 1;             // 0: may be lost; 1: may come twice
    bool retained = false;   // a broker keeps the last one
    std::string_view help;   // a sentence
    std::span<const Field> fields;
};

std::span<const KindInfo> kinds();
const KindInfo& info_of(Kind kind);

// What a command may be, beside the fields of every command.
struct VerbInfo {
    std::string_view verb;
    std::string_view help;
    std::span<const Field> fields;
};
std::span<const VerbInfo> verbs();
const VerbInfo* verb_of(std::string_view verb);

// The same of questions to the keeper: robot/R/ask/give, robot/R/ask/take, …
std::span<const VerbInfo> questions();
const VerbInfo* question_of(std::string_view verb);

// What is wrong with a value: a sentence that names the field, what was expected and found.
// Members that the list does not have are passed over: a later version may add some.
std::optional<std::string> fault_of(const JsonValue& value, std::span<const Field> fields);

// docs/fleet-messages.md
std::string page_of_messages();

}  // namespace vagus::fleet
