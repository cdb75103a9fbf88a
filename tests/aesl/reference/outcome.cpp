// Comparing and reading outcomes: see outcome.hpp.
#include "reference/outcome.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "base/json.hpp"

namespace vagus::aesl {
namespace {

constexpr std::array<std::string_view, 3> kFaultNames = {"division_by_zero", "array_out_of_bounds",
                                                         "node_specific"};

bool is_zero(const Words& words) {
    return std::all_of(words.begin(), words.end(), [](int16_t word) { return word == 0; });
}

// The golden files are ours: what does not fit counts as absent and fails the comparison.
int64_t integer_in(const JsonValue& json, std::string_view key) {
    const JsonValue* value = json.find(key);
    return value == nullptr ? 0 : value->integer;
}

Words words_of(const JsonValue& json) {
    Words words;
    for (const JsonValue& item : json.items) words.push_back(static_cast<int16_t>(item.integer));
    return words;
}

std::map<std::string, Words> words_by_name(const JsonValue* json) {
    std::map<std::string, Words> named;
    if (json == nullptr) return named;
    for (const JsonMember& member : json->members) named[member.key] = words_of(member.value);
    return named;
}

Emission emission_of(const JsonValue& json) {
    Emission emission{static_cast<size_t>(integer_in(json, "during")), text_in(json, "event"), {}};
    if (const JsonValue* arguments = json.find("args")) emission.arguments = words_of(*arguments);
    return emission;
}

Fault fault_of(const JsonValue& json) {
    const auto* kind = std::find(kFaultNames.begin(), kFaultNames.end(), text_in(json, "kind"));
    return {static_cast<FaultCause>(kind - kFaultNames.begin()),
            static_cast<size_t>(integer_in(json, "during")),
            static_cast<int>(integer_in(json, "line"))};
}

}  // namespace

std::string to_string(const Outcome& outcome) {
    if (outcome.out_of_steps) return "out of steps\n";
    if (outcome.error)
        return fmt::format("error {} in line {}\n", outcome.error->code, outcome.error->line);
    std::string text;
    for (const auto& [name, words] : outcome.memory)
        if (!is_zero(words)) text += fmt::format("{} = {}\n", name, words);
    for (const Emission& emission : outcome.emitted)
        text +=
            fmt::format("{}: emit {} {}\n", emission.during, emission.event, emission.arguments);
    if (outcome.fault)
        text +=
            fmt::format("{}: {} in line {}\n", outcome.fault->during,
                        kFaultNames[static_cast<size_t>(outcome.fault->kind)], outcome.fault->line);
    return text;
}

std::string without_guess(std::string_view code) {
    constexpr std::string_view kGuess = "_GUESS";
    if (code.ends_with(kGuess)) code.remove_suffix(kGuess.size());
    return std::string(code);
}

Result<Golden> parse_golden(std::string source, std::string_view expected, std::string_view file) {
    const JsonValue json = TRY(parse_json(expected, file));
    Golden golden{{std::move(source), {}}, {}};
    if (const JsonValue* error = json.find("error")) {
        golden.outcome.error = CompileError{without_guess(text_in(*error, "code")),
                                            static_cast<int>(integer_in(*error, "line"))};
        return golden;
    }
    golden.program.stimuli = TRY(parse_stimuli(expected, file));
    golden.outcome.memory = words_by_name(json.find("memory"));
    if (const JsonValue* emitted = json.find("events_emitted"))
        for (const JsonValue& item : emitted->items)
            golden.outcome.emitted.push_back(emission_of(item));
    if (const JsonValue* fault = json.find("runtime_error"))
        golden.outcome.fault = fault_of(*fault);
    return golden;
}

}  // namespace vagus::aesl
