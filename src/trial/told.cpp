#include "trial/told.hpp"

#include <fmt/format.h>

#include "base/json.hpp"

namespace vagus::trial {

namespace {

template <typename Items, typename Format>
std::string joined_json(const Items& items, Format format) {
    std::string text;
    for (const auto& item : items) text += (text.empty() ? "" : ",") + format(item);
    return "[" + text + "]";
}

JsonValue tree_of(std::string_view text) {
    auto read = read_json(text);
    return std::get<JsonValue>(std::move(read));
}

uint64_t number_in(const JsonValue& json, std::string_view key) {
    return static_cast<uint64_t>(json.find(key)->integer);
}

std::string failure_json(const Failure& one) {
    return fmt::format("[{},{},{},{},{},{}]", one.at.line, one.at.column, one.t,
                       json_quote(one.expected), json_quote(one.what), json_quote(one.help));
}

Failure read_failure(const JsonValue& json) {
    const auto place = [&](size_t i) { return static_cast<int>(json.items[i].integer); };
    return {.at = {place(0), place(1)},
            .t = json.items[2].number,
            .expected = json.items[3].text,
            .what = json.items[4].text,
            .help = json.items[5].text};
}

}  // namespace

std::string format_order(const TestOrder& order) {
    return fmt::format(R"({{"tests":{},"results":{},"scripts":{}}})",
                       joined_json(order.tests, [](const auto& one) { return json_quote(one); }),
                       json_quote(order.results), order.scripts);
}

TestOrder read_order(std::string_view text) {
    const JsonValue json = tree_of(text);
    TestOrder order{
        .tests = {}, .results = text_in(json, "results"), .scripts = json.find("scripts")->boolean};
    for (const JsonValue& one : json.find("tests")->items) order.tests.push_back(one.text);
    return order;
}

std::string format_planned(const std::vector<PlannedTest>& tests) {
    return joined_json(tests, [](const PlannedTest& one) {
        return fmt::format("[{},{},{},{}]", one.seeds.first, one.seeds.last, one.world,
                           json_quote(one.refused));
    });
}

std::vector<PlannedTest> read_planned(std::string_view text) {
    std::vector<PlannedTest> tests;
    for (const JsonValue& one : tree_of(text).items) {
        const auto seed = [&](size_t i) { return static_cast<uint64_t>(one.items[i].integer); };
        tests.push_back({.seeds = {seed(0), seed(1)},
                         .world = one.items[2].boolean,
                         .refused = one.items[3].text});
    }
    return tests;
}

std::string format_seed(const SeedTold& told) {
    return fmt::format(
        R"({{"test":{},"seed":{},"refused":{},"trouble":{},"recording":{},"failures":{},)"
        R"("coverage":{}}})",
        told.test, told.seed, json_quote(told.refused), json_quote(told.trouble),
        json_quote(told.recording), joined_json(told.failures, failure_json),
        format_coverage(told.coverage));
}

SeedTold read_seed(std::string_view text) {
    const JsonValue json = tree_of(text);
    SeedTold told{.test = number_in(json, "test"),
                  .seed = number_in(json, "seed"),
                  .refused = text_in(json, "refused"),
                  .trouble = text_in(json, "trouble"),
                  .recording = text_in(json, "recording")};
    for (const JsonValue& one : json.find("failures")->items) {
        told.failures.push_back(read_failure(one));
    }
    told.coverage = read_coverage(*json.find("coverage"));
    return told;
}

}  // namespace vagus::trial
