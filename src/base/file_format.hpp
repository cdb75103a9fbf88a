// Which of our file formats a text is, so that a file of another format is called that: "this is a
// plan file (vagus-plan/1); a world file (vagus-world/1) was expected".
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/json_object.hpp"

namespace vagus {

enum class FileFormat { Plan, World, Toolbox, Project, Test, Node, Script };

// The value of the key "format"; empty for formats that have none (node file, script).
std::string_view format_text(FileFormat format);
// "a world file (vagus-world/1)", "a script (.aesl)": for sentences.
std::string name_of(FileFormat format);

// What the text is by its beginning or its JSON; nothing if it is none of ours.
std::optional<FileFormat> format_of(std::string_view text);
std::optional<FileFormat> format_of(const JsonValue& json);

// "this is …; … was expected", if the text is one of our formats, but another than `wanted`.
std::optional<std::string> other_format(std::string_view text, FileFormat wanted);
std::optional<std::string> other_format(const JsonValue& json, FileFormat wanted);

// Reads a JSON file of that format: text in, tree out. The Error says where the JSON is broken, or
// which other format it is.
Result<JsonValue> parse_format(std::string_view text, std::string_view file, FileFormat wanted);

// Asks for the key "format" of the file's object and complains unless it is the wanted one.
void check_format(JsonObject& in, FileFormat wanted);

}  // namespace vagus
