// What `exec` prints, in the form of the expected files (testdata/golden/aesl/README.md).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/json.hpp"
#include "session/execute.hpp"

namespace vagus::session {

namespace {

std::string list_of_words(const std::vector<int16_t>& words) {
    return fmt::format("[{}]", fmt::join(words, ", "));
}

// The items one a line between the brackets; on one line if there are none.
std::string block(std::string_view brackets, const std::vector<std::string>& items) {
    if (items.empty()) return std::string(brackets);
    return fmt::format("{}\n  {}\n {}", brackets[0], fmt::join(items, ",\n  "), brackets[1]);
}

std::string format_memory(const std::vector<VariableWords>& memory) {
    std::vector<std::string> items;
    for (const VariableWords& variable : memory) {
        items.push_back(json_quote(variable.name) + ": " + list_of_words(variable.words));
    }
    return block("{}", items);
}

std::string format_emissions(const std::vector<Emission>& emissions) {
    std::vector<std::string> items;
    for (const Emission& emission : emissions) {
        items.push_back(fmt::format(R"({{"during": {}, "event": {}, "args": {}}})", emission.during,
                                    json_quote(emission.event), list_of_words(emission.arguments)));
    }
    return block("[]", items);
}

std::string format_error(const RuntimeError& error) {
    std::string text = fmt::format(R"({{"kind": "{}", "during": {}, "line": {})",
                                   name_of(error.kind), error.during, error.line);
    if (error.size) text += fmt::format(R"(, "size": {})", *error.size);
    if (error.index) text += fmt::format(R"(, "index": {})", *error.index);
    if (!error.text.empty()) text += fmt::format(R"(, "text": {})", json_quote(error.text));
    return text + "}";
}

}  // namespace

std::string_view name_of(StopKind kind) {
    switch (kind) {
        case StopKind::DivisionByZero:
            return "division_by_zero";
        case StopKind::ArrayOutOfBounds:
            return "array_out_of_bounds";
        case StopKind::NodeSpecific:
            return "node_specific";
        case StopKind::StepLimit:
            return "step_limit";
    }
    return "";
}

std::string format_execution(const Execution& execution) {
    std::string text =
        fmt::format("{{\n \"memory\": {},\n \"events_emitted\": {}",
                    format_memory(execution.memory), format_emissions(execution.emitted));
    if (execution.error) {
        text += fmt::format(",\n \"runtime_error\": {}", format_error(*execution.error));
    }
    return text + "\n}\n";
}

std::string format_compile_error(const aesl::Diagnostic& error) {
    const aesl::Position place = error.formal_place();
    return fmt::format(
        "{{\n \"error\": {{\"code\": {}, \"number\": {}, \"line\": {}, \"column\": {}}}\n}}\n",
        json_quote(error.code), error.number, place.line, place.column);
}

}  // namespace vagus::session
