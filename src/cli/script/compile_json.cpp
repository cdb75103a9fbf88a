#include "cli/script/compile_json.hpp"

#include <span>

#include "base/json.hpp"

namespace vagus::cli {
namespace {

// "[" items ", " … "]"
template <typename Items, typename ToText>
std::string joined(const Items& items, const ToText& to_text, std::string_view open,
                   std::string_view close) {
    std::string text(open);
    for (const auto& item : items) {
        if (text.size() > open.size()) text += ", ";
        text += to_text(item);
    }
    return text + std::string(close);
}

std::string words(std::span<const uint16_t> values) {
    return joined(
        values, [](uint16_t word) { return std::to_string(word); }, "[", "]");
}

std::string variable(const aesl::VariablePlace& place) {
    return json_quote(place.name) + ": [" + std::to_string(place.address) + ", " +
           std::to_string(place.size) + "]";
}

std::string subroutine(const aesl::SubroutinePlace& place) {
    return "{ \"name\": " + json_quote(place.name) +
           ", \"address\": " + std::to_string(place.address) +
           ", \"line\": " + std::to_string(place.line) + " }";
}

std::string range(aesl::Mark mark) {
    return "\"line\": " + std::to_string(mark.at.line) +
           ", \"column\": " + std::to_string(mark.at.column) +
           ", \"endLine\": " + std::to_string(mark.end.line) +
           ", \"endColumn\": " + std::to_string(mark.end.column);
}

std::string edit(const aesl::Edit& change) {
    return "{ " + range(change.range) + ", \"text\": " + json_quote(change.text) + " }";
}

std::string fix(const aesl::Fix& value) {
    std::string text = "{ \"label\": " + json_quote(value.label) +
                       ", \"edits\": " + joined(value.edits, edit, "[", "]");
    if (value.declares) {
        text += ", \"declares\": { \"name\": " + json_quote(value.declares->name) +
                ", \"size\": " + std::to_string(value.declares->size.value_or(0)) + " }";
    }
    return text + " }";
}

std::string finding(const aesl::Diagnostic& diagnostic) {
    std::string text = "{ \"code\": " + json_quote(diagnostic.code) + ", " +
                       range({diagnostic.at, diagnostic.end}) +
                       ", \"message\": " + json_quote(diagnostic.message);
    if (diagnostic.fix) text += ", \"fix\": " + fix(*diagnostic.fix);
    return text + " }";
}

std::string used(const aesl::Used& numbers) {
    return "{ \"bytecode\": " + std::to_string(numbers.bytecode) +
           ", \"variables\": " + std::to_string(numbers.variables) +
           ", \"stack\": " + std::to_string(numbers.stack) + " }";
}

std::string node(const CompiledNode& compiled) {
    if (!compiled.done.ok()) {
        return "    {\n      \"name\": " + json_quote(compiled.name) +
               ",\n      \"errors\": " + joined(compiled.done.errors, finding, "[", "]") +
               "\n    }";
    }
    const aesl::Program& program = compiled.done.program;
    return "    {\n      \"name\": " + json_quote(compiled.name) +
           ",\n      \"bytecode\": " + words(program.bytecode) +
           ",\n      \"lines\": " + words(program.lines) +
           ",\n      \"variables\": " + joined(program.variables, variable, "{ ", " }") +
           ",\n      \"subroutines\": " + joined(program.subroutines, subroutine, "[", "]") +
           ",\n      \"used\": " + used(program.used) +
           ",\n      \"warnings\": " + joined(compiled.done.warnings, finding, "[", "]") +
           "\n    }";
}

}  // namespace

std::string compile_json(const std::vector<CompiledNode>& nodes) {
    std::string text = "{\n  \"nodes\": [\n";
    for (size_t i = 0; i < nodes.size(); i++)
        text += node(nodes[i]) + (i + 1 < nodes.size() ? ",\n" : "\n");
    return text + "  ]\n}\n";
}

}  // namespace vagus::cli
