// docs/protocol.md: the protocol for people who write a client of their own.
#include <fmt/format.h>

#include "serve/protocol/protocol.hpp"

namespace vagus::serve {

namespace {

std::string text_of(const Type& type);

std::string number_text(double value) {
    return fmt::format("{}", value);
}

std::string words_text(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "`" : ", `") + word + "`";
    return "one of " + text;
}

std::string range_text(const Type& type, const std::string& name) {
    if (type.low < -1e300) return name;
    return name + " " + number_text(type.low) + " to " + number_text(type.high);
}

std::string text_of(const Type& type) {
    switch (type.kind) {
        case Type::Kind::Bool:
            return "true or false";
        case Type::Kind::Int:
            return range_text(type, "int");
        case Type::Kind::Number:
            return range_text(type, "number");
        case Type::Kind::Line:
            return fmt::format("one line, {} bytes at most", type.size_max);
        case Type::Kind::Text:
            return fmt::format("text, {} bytes at most", type.size_max);
        case Type::Kind::Word:
            return words_text(type.words);
        case Type::Kind::Any:
            return "any JSON";
        case Type::Kind::List:
            return fmt::format("list of {}, {} at most", text_of(*type.item), type.size_max);
        case Type::Kind::Map:
            return fmt::format("object of {}, {} at most", text_of(*type.item), type.size_max);
        case Type::Kind::Fields:
            return "object";
        case Type::Kind::Named:
            return fmt::format("[{0}](#{0})", type.name);
    }
    return {};
}

std::string table_of(const std::vector<Field>& fields) {
    std::string text = "| key | value | meaning |\n| --- | --- | --- |\n";
    for (const Field& field : fields) {
        text +=
            fmt::format("| `{}`{} | {} | {} |\n", field.name,
                        field.optional ? " (may be missing)" : "", text_of(field.type), field.help);
    }
    return text + "\n";
}

const char* name_of(May may) {
    switch (may) {
        case May::Any:
            return "anyone";
        case May::Look:
            return "who may look";
        case May::Drive:
            return "who has the token that drives";
        case May::Driver:
            return "the driver";
    }
    return "";
}

const char* name_of(CommandKind kind) {
    switch (kind) {
        case CommandKind::Look:
            return "look";
        case CommandKind::Edit:
            return "edit";
        case CommandKind::Act:
            return "act";
        case CommandKind::Stop:
            return "stop";
    }
    return "";
}

const char* name_of(TopicType::Kind kind) {
    switch (kind) {
        case TopicType::Kind::Document:
            return "document";
        case TopicType::Kind::Stream:
            return "stream";
        case TopicType::Kind::Binary:
            return "binary";
    }
    return "";
}

std::string command_text(const std::string& name, const CommandType& command) {
    std::string text = fmt::format("### {}\n\n{} For {}; kind {}.{}\n\n", name, command.help,
                                   name_of(command.may), name_of(command.kind),
                                   command.on_robot ? "" : " Not on a robot that serves itself.");
    if (!command.in.empty()) text += "In:\n\n" + table_of(command.in);
    if (!command.out.empty()) text += "Out:\n\n" + table_of(command.out);
    return text;
}

std::string topic_text(const std::string& name, const TopicType& topic) {
    std::string text = fmt::format("### {}\n\n{} ({}", name, topic.help, name_of(topic.kind));
    text += topic.number ? fmt::format(", kind {})\n\n", topic.number) : ")\n\n";
    if (!topic.of.empty()) text += "Of:\n\n" + table_of(topic.of);
    if (!topic.is.empty()) text += "Is:\n\n" + table_of(topic.is);
    if (!topic.item.empty()) text += fmt::format("Items: [{0}](#{0})\n\n", topic.item);
    return text;
}

}  // namespace

std::string Protocol::page() const {
    std::string text =
        "# The protocol of the studio\n\nMade from `src/serve/protocol/protocol.json`; a test says "
        "when it is stale.\n`examples/client/run_plan.py` is a client in Python: it runs a plan "
        "and prints what happens.\n\n";
    for (const std::string& line : help_) text += line + "\n\n";
    text += "## Limits\n\n| limit | value | of |\n| --- | --- | --- |\n";
    for (const auto& [name, limit] : limits_) {
        text += fmt::format("| `{}` | {} | {} |\n", name, number_text(limit.value), limit.help);
    }
    text += "\n## Commands\n\n";
    for (const auto& [name, command] : commands_) text += command_text(name, command);
    text += "## Topics\n\n";
    for (const auto& [name, topic] : topics_) text += topic_text(name, topic);
    text += "## Types\n\n";
    for (const auto& [name, help] : type_helps_) {
        const Type& type = types_.find(name)->second;
        text += fmt::format("### {}\n\n{}\n\n", name, help);
        text += type.kind == Type::Kind::Fields ? table_of(type.fields)
                                                : "Is " + text_of(type) + ".\n\n";
    }
    while (text.ends_with("\n\n")) text.pop_back();
    return text;
}

}  // namespace vagus::serve
