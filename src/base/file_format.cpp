#include "base/file_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace vagus {
namespace {

struct Known {
    FileFormat format;
    std::string_view text;
    std::string_view name;
};

constexpr std::array<Known, 7> kKnown = {{
    {FileFormat::Plan, "vagus-plan/1", "a plan file"},
    {FileFormat::World, "vagus-world/1", "a world file"},
    {FileFormat::Toolbox, "vagus-toolbox/1", "a toolbox file"},
    {FileFormat::Project, "vagus-project/1", "a project file"},
    {FileFormat::Test, "vagus-test/1", "a test file"},
    {FileFormat::Node, "", "a node file"},
    {FileFormat::Script, "", "a script (.aesl)"},
}};

const Known& known(FileFormat format) {
    return *std::find_if(kKnown.begin(), kKnown.end(),
                         [format](const Known& one) { return one.format == format; });
}

std::string_view without_spaces(std::string_view text) {
    if (text.starts_with("\xef\xbb\xbf")) text.remove_prefix(3);
    const size_t start = text.find_first_not_of(" \t\r\n");
    return start == text.npos ? std::string_view() : text.substr(start);
}

// A project of scripts is XML.
bool is_script_project(std::string_view text) {
    const std::string_view start = without_spaces(text);
    return start.starts_with("<!DOCTYPE aesl") || start.starts_with("<network") ||
           start.starts_with("<?xml");
}

// It has no key "format", but these, and no other file of ours has two of them.
bool is_node_file(const JsonValue& json) {
    int found = 0;
    for (const char* key :
         {"protocolVersion", "bytecodeSize", "variablesSize", "stackSize", "localEvents"}) {
        if (json.find(key) != nullptr) ++found;
    }
    return found >= 2;
}

std::string sentence(FileFormat found, FileFormat wanted) {
    return fmt::format("this is {}; {} was expected", name_of(found), name_of(wanted));
}

}  // namespace

std::string_view format_text(FileFormat format) {
    return known(format).text;
}

std::string name_of(FileFormat format) {
    const Known& one = known(format);
    return one.text.empty() ? std::string(one.name) : fmt::format("{} ({})", one.name, one.text);
}

std::optional<FileFormat> format_of(const JsonValue& json) {
    if (json.kind != JsonKind::Object) return std::nullopt;
    const JsonValue* format = json.find("format");
    if (format == nullptr) {
        return is_node_file(json) ? std::optional(FileFormat::Node) : std::nullopt;
    }
    for (const Known& one : kKnown) {
        if (!one.text.empty() && format->text == one.text) return one.format;
    }
    return std::nullopt;
}

std::optional<FileFormat> format_of(std::string_view text) {
    if (is_script_project(text)) return FileFormat::Script;
    if (!without_spaces(text).starts_with('{')) return std::nullopt;
    const auto read = read_json(text);
    const JsonValue* json = std::get_if<JsonValue>(&read);
    return json == nullptr ? std::nullopt : format_of(*json);
}

std::optional<std::string> other_format(const JsonValue& json, FileFormat wanted) {
    const std::optional<FileFormat> found = format_of(json);
    if (!found || *found == wanted) return std::nullopt;
    return sentence(*found, wanted);
}

std::optional<std::string> other_format(std::string_view text, FileFormat wanted) {
    const std::optional<FileFormat> found = format_of(text);
    if (!found || *found == wanted) return std::nullopt;
    return sentence(*found, wanted);
}

Result<JsonValue> parse_format(std::string_view text, std::string_view file, FileFormat wanted) {
    const auto refuse = [file](Place at, std::string_view what) {
        return Error{Code::BadInput, at_place(file, at, what)};
    };
    if (is_script_project(text)) return refuse({1, 1}, sentence(FileFormat::Script, wanted));
    JsonValue json = TRY(parse_json(text, file));
    if (const auto other = other_format(json, wanted)) {
        const JsonValue* format = json.find("format");
        return refuse(format == nullptr ? json.at : format->at, *other);
    }
    return json;
}

void check_format(JsonObject& in, FileFormat wanted) {
    const JsonValue* json = in.find("format", JsonKind::String, Need::Required);
    if (json == nullptr || json->text == format_text(wanted)) return;
    in.complain(json->at, fmt::format("\"format\" is {}; write \"{}\", the only one that this "
                                      "program reads here",
                                      json_quote(json->text.substr(0, 40)), format_text(wanted)));
}

}  // namespace vagus
