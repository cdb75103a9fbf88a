// The studio's protocol as protocol.json has it: the one list from which the checks here, the
// pages' TypeScript types and docs/protocol.md are made.
//
//     const Protocol& protocol = Protocol::get();
//     const Message message = protocol.read(text);  // a Request, checked, or why it is none
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "serve/protocol/type.hpp"

namespace vagus::serve {

// Who may give a command: anyone before hello, who may look, who holds the token that drives, the
// one driver.
enum class May { Any, Look, Drive, Driver };

// What a command does, and so how late it may come. Look changes nothing. Edit changes what is
// kept: a client repeats it after a lost connection, and it is done once. Act can move something:
// it has a deadline. Stop only makes things stop, and is obeyed before others that wait.
enum class CommandKind { Look, Edit, Act, Stop };

struct CommandType {
    May may = May::Driver;
    CommandKind kind = CommandKind::Act;
    bool on_robot = false;  // a robot that serves itself obeys it
    std::string help;
    std::vector<Field> in, out;
};

struct TopicType {
    enum class Kind { Document, Stream, Binary };
    Kind kind = Kind::Document;
    uint8_t number = 0;  // Binary: the first byte of its frames
    std::string help;
    std::vector<Field> of;  // what it is about
    std::vector<Field> is;  // Document
    std::string item;       // Stream: the type
};

struct LimitType {
    double value = 0;
    std::string help;
};

// Why a message or a command is refused.
struct Problem {
    std::string code;   // of the list in protocol.json
    std::string what;   // a sentence
    std::string place;  // the part of the message, or FILE:LINE:COLUMN; may be empty
};

// A command that fits the protocol.
struct Request {
    uint64_t id = 0;
    std::string name;
    const CommandType* type = nullptr;
    nlohmann::json in;
    std::optional<double> until = {};    // ms of the server's time: not done later
    std::optional<uint64_t> stops = {};  // of others, heard of when it was asked for
};

// The answer to a ping of the server.
struct Pong {
    uint64_t number = 0;
};

// A refused message, with its id if it had one.
struct Refusal {
    uint64_t id = 0;
    Problem problem;
};

// What a client says.
using Message = std::variant<Request, Refusal, Pong>;

class Protocol {
public:
    // The list that is built in. A mistake in it is a bug: a test reads it.
    static const Protocol& get();
    static Result<Protocol> parse(std::string_view text);

    // A text message from a client. Whatever it holds, this ends soon and uses little.
    Message read(std::string_view message) const;

    const CommandType* command(std::string_view name) const;
    std::vector<std::string> command_names() const;
    std::vector<std::string> topic_names() const;
    const Types& types() const { return types_; }
    const TopicType* topic(std::string_view name) const;
    // What is wrong with the `of` of a subscription.
    std::optional<std::string> fault_of_subject(const TopicType& topic,
                                                const nlohmann::json& of) const;
    // What is wrong with an answer or a document of ours: for tests.
    std::optional<std::string> fault_of_answer(std::string_view command,
                                               const nlohmann::json& out) const;
    std::optional<std::string> fault_of_document(std::string_view topic,
                                                 const nlohmann::json& document) const;
    size_t limit(std::string_view name) const;

    // docs/protocol.md.
    std::string page() const;

private:
    struct Reader;
    std::optional<Refusal> read_members(const nlohmann::json& json, Request& request) const;
    std::vector<std::string> help_;
    std::vector<std::pair<std::string, LimitType>> limits_;
    std::vector<std::pair<std::string, std::string>> type_helps_;  // in the order of the list
    Types types_;
    std::vector<std::pair<std::string, CommandType>> commands_;
    std::vector<std::pair<std::string, TopicType>> topics_;
};

}  // namespace vagus::serve
