// Scripts with the mistakes of beginners (beginners.txt): what the first message says, where it
// points, and whether its fix is one.
//
//     ## title
//     the script
//     >> LINE:COLUMN CODE sentence           of the first error in the text
//     >> fix: Write "…"                      its label, if there is a fix
//     >> then: no error                      what the text says with the fix made
#include <gtest/gtest.h>

#include "aesl/compile.hpp"
#include "base/file.hpp"
#include "base/text.hpp"
#include "session/known_nodes.hpp"
#include "session/script_file.hpp"

namespace vagus::aesl {
namespace {

constexpr std::string_view kTitle = "## ";
constexpr std::string_view kExpected = ">> ";

struct Case {
    std::string title;
    std::string script;
    std::string expected;  // its lines without the mark
};

std::vector<Case> cases() {
    const auto text = read_file(VAGUS_BEGINNERS);
    EXPECT_TRUE(text.ok());
    std::vector<Case> all;
    for (const std::string_view line : split(text.value(), '\n')) {
        if (line.starts_with(kTitle)) {
            all.push_back({std::string(line.substr(kTitle.size())), "", ""});
        } else if (all.empty()) {
            continue;
        } else if (line.starts_with(kExpected)) {
            all.back().expected += std::string(line.substr(kExpected.size())) + "\n";
        } else {
            all.back().script += std::string(line) + "\n";
        }
    }
    return all;
}

// As `vagus compile --node thymio-II` does.
Compilation compile_for_thymio(const std::string& script) {
    const Target target = session::known_node("thymio-II");
    const CommonDefinitions common = session::with_emitted({}, script, target);
    return compile(script, target, common, session::options_for(common, {}));
}

std::string told(const std::string& script) {
    const Compilation done = compile_for_thymio(script);
    if (done.ok()) return "no error\n";
    const Diagnostic& first = done.errors.front();
    std::string text = std::to_string(first.at.line) + ":" + std::to_string(first.at.column) + " " +
                       first.code + " " + first.message + "\n";
    if (!first.fix) return text;
    text += "fix: " + first.fix->label + "\n";
    const Compilation again = compile_for_thymio(with_edits(script, first.fix->edits));
    return text + "then: " + (again.ok() ? "no error" : again.errors.front().message) + "\n";
}

TEST(Beginners, TheFirstMessageNamesTheMistakeItsPlaceAndItsFix) {
    const std::vector<Case> all = cases();
    EXPECT_GE(all.size(), 80u);
    for (const Case& one : all) EXPECT_EQ(told(one.script), one.expected) << one.title;
}

TEST(Beginners, EveryErrorHasARange) {
    for (const Case& one : cases()) {
        for (const Diagnostic& error : compile_for_thymio(one.script).errors) {
            EXPECT_GE(error.at.line, 1) << one.title;
            EXPECT_GE(error.end, error.at) << one.title;
        }
    }
}

TEST(Beginners, AFixReplacesExactlyItsRange) {
    EXPECT_EQ(
        with_edits("höhe = x\nb = 2\n", {{{{1, 8}, {1, 9}}, "speed"}, {{{2, 1}, {2, 1}}, "a"}}),
        "höhe = speed\nab = 2\n");
    EXPECT_EQ(with_edits("a", {{{{7, 1}, {7, 1}}, "\nend"}}), "a\nend");
}

}  // namespace
}  // namespace vagus::aesl
