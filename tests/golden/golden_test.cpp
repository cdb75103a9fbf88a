// The golden programs: what the compiler and the machine make of each must be what its expected
// file says, in the parts that are normative (testdata/golden/aesl/README.md), and its error code.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "aesl/compile.hpp"
#include "aesl/node_file.hpp"
#include "base/file.hpp"
#include "base/json.hpp"
#include "base/test_places.hpp"
#include "session/execute.hpp"

namespace vagus {
namespace {

constexpr size_t kCases = 266;
constexpr std::string_view kEnding = ".expected.json";
const std::string kFolder = test::testdata("golden/aesl/");

using Words = std::vector<int16_t>;

std::vector<std::string> case_names() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(kFolder)) {
        const std::string file = entry.path().filename().string();
        if (file.ends_with(kEnding)) names.push_back(file.substr(0, file.size() - kEnding.size()));
    }
    std::ranges::sort(names);
    return names;
}

template <typename T>
T good(Result<T> result) {
    EXPECT_TRUE(result.ok()) << result.error().what;
    return std::move(result.value());
}

Words words_of(const JsonValue& list) {
    Words words;
    for (const JsonValue& item : list.items) words.push_back(static_cast<int16_t>(item.integer));
    return words;
}

std::map<std::string, Words> memory_of(const JsonValue& object) {
    std::map<std::string, Words> memory;
    for (const JsonMember& member : object.members) memory[member.key] = words_of(member.value);
    return memory;
}

std::map<std::string, Words> memory_of(const session::Execution& execution) {
    std::map<std::string, Words> memory;
    for (const auto& variable : execution.memory) memory[variable.name] = variable.words;
    return memory;
}

std::vector<session::Emission> emissions_of(const JsonValue& list) {
    std::vector<session::Emission> emissions;
    for (const JsonValue& item : list.items) {
        emissions.push_back({static_cast<int>(item.find("during")->integer),
                             item.find("event")->text, words_of(*item.find("args"))});
    }
    return emissions;
}

// `X` and `X_GUESS` count as equal.
std::string without_guess(std::string code) {
    constexpr std::string_view kGuess = "_GUESS";
    if (code.ends_with(kGuess)) code.resize(code.size() - kGuess.size());
    return code;
}

class Golden : public testing::TestWithParam<std::string> {
protected:
    std::string text(const std::string& ending) const {
        return good(read_file(kFolder + GetParam() + ending));
    }
    static void expect_compile_error(const aesl::Compilation& done, const JsonValue& expected) {
        ASSERT_FALSE(done.ok()) << "expected " << expected.find("code")->text;
        EXPECT_EQ(done.first_error().formal_place().line, expected.find("line")->integer)
            << done.first_error().message;
        EXPECT_EQ(without_guess(done.first_error().code),
                  without_guess(expected.find("code")->text))
            << done.errors[0].message;
    }
    static void expect_run(const session::Execution& execution, const JsonValue& expected) {
        EXPECT_EQ(memory_of(execution), memory_of(*expected.find("memory")));
        EXPECT_EQ(execution.emitted, emissions_of(*expected.find("events_emitted")));
        const JsonValue* error = expected.find("runtime_error");
        ASSERT_EQ(execution.error.has_value(), error != nullptr);
        if (error == nullptr) return;
        EXPECT_EQ(session::name_of(execution.error->kind), error->find("kind")->text);
        EXPECT_EQ(execution.error->during, error->find("during")->integer);
        EXPECT_EQ(execution.error->line, error->find("line")->integer);
    }
};

TEST_P(Golden, IsAsExpected) {
    const std::string expected_text = text(std::string(kEnding));
    const JsonValue expected = good(parse_json(expected_text, GetParam()));
    const aesl::NodeFile node =
        good(aesl::parse_node_file(good(read_file(kFolder + "node.json")), "node.json"));
    const aesl::Compilation done = aesl::compile(text(".aesl"), node.target, node.common, {});
    if (const JsonValue* error = expected.find("error")) return expect_compile_error(done, *error);
    ASSERT_TRUE(done.ok()) << done.errors[0].at.line << ": " << done.errors[0].message << " ["
                           << done.errors[0].code << "]";
    const auto stimuli = good(aesl::parse_stimuli(expected_text, GetParam()));
    expect_run(good(session::execute(done.program, node, stimuli, session::kStepsPerEvent)),
               expected);
}

std::string test_name(const testing::TestParamInfo<std::string>& golden_case) {
    std::string name = golden_case.param;
    std::ranges::replace(name, '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Aesl, Golden, testing::ValuesIn(case_names()), test_name);

TEST(GoldenCases, AreAllThere) {
    EXPECT_EQ(case_names().size(), kCases);
}

}  // namespace
}  // namespace vagus
