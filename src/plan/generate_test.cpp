// What generated code is called, where its lines come from, and that nothing of a plan can break
// it. How it reads: tests/generate/text_test.cpp; whether it runs as the plan: tests/generate.
#include "plan/generate.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>

#include "plan/test_change.hpp"

namespace vagus::plan {
namespace {

using testing::HasSubstr;

// A plan whose names are words of C++, with another one inside that has nearly the same name.
const std::string kClass = R"({
  "format": "vagus-plan/1",
  "name": "class",
  "configuration": { "low": { "type": "int", "initial": -9223372036854775808 },
    "text": { "type": "string", "initial": "a\"b\\" },
    "half": { "type": "float", "initial": 2 } },
  "start": { "actor": "while", "supervisors": {
    "new": { "template": "See", "in": { "limit": "low" }, "events": { "Seen": "plan" } } } },
  "actors": {
    "while": { "plan": "inner.plan.json", "out": { "to": "low" },
      "states": { "OK": "plan", "Interrupted": "plan", "Error": "@terminate" } },
    "plan": { "template": "Drive", "in": { "speed": -9223372036854775808 },
      "states": { "Done": "while" } }
  }
})";
const std::string kGeneratedInner = R"({
  "format": "vagus-plan/1",
  "name": "class_",
  "configuration": { "to": { "type": "int", "access": "out" } },
  "start": { "actor": "go" },
  "actors": { "go": { "template": "Turn", "states": { "Done": "@terminate" } } }
})";

class Generated : public testing::Test {
protected:
    Generated()
        : checked_(
              check("main.plan.json",
                    ChangeTexts({{"main.plan.json", kClass}, {"inner.plan.json", kGeneratedInner}}),
                    change_library())) {
        EXPECT_TRUE(checked_.ok()) << format_findings_json(checked_.findings);
    }
    // Those of one element, by the keys that lead to it.
    std::string lines_of(const MarkedText& code, const std::vector<std::string>& keys) {
        std::vector<std::string> lines;
        std::istringstream text(code.text());
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        std::string found;
        for (const CodeMark& mark : code.marks()) {
            if (mark.keys != keys) continue;
            for (size_t i = mark.first; i <= mark.last; ++i) found += lines.at(i - 1) + "\n";
        }
        return found;
    }
    Checked checked_;
};

TEST_F(Generated, EachPlanHasFilesOfItsOwnThatAllAreBuilt) {
    const auto files = generate(checked_);
    ASSERT_EQ(files.size(), 6u);  // two for each plan
    const std::string& build = files.at("CMakeLists.txt");
    size_t sources = 0;
    for (const auto& [name, text] : files) {
        if (!name.ends_with(".cpp")) continue;
        ++sources;
        EXPECT_THAT(build, HasSubstr("\n  " + name)) << build;
    }
    EXPECT_EQ(sources, 3u);
    EXPECT_EQ(files.count("class.cpp"), 0u) << "a word of C++";
}

TEST_F(Generated, NamesThatCppHasAreOtherOnesAndThePlansOwnStayInTheTexts) {
    const std::string code = generate_code(checked_).text();
    EXPECT_THAT(code, HasSubstr("while_(\"while\""));
    EXPECT_THAT(code, HasSubstr("new_(\"new\""));
    EXPECT_THAT(code, HasSubstr("plan_(\"plan\""));  // `plan` is the plan itself
    EXPECT_THAT(code, HasSubstr("Plan plan(\"class\""));
}

TEST_F(Generated, ConstantsAreWhatTheyWere) {
    const std::string code = generate_code(checked_).text();
    EXPECT_THAT(code, HasSubstr(".initial = -9223372036854775807 - 1"));  // no literal of C++
    EXPECT_THAT(code, HasSubstr(R"(.initial = "a\"b\\")"));
    EXPECT_THAT(code, HasSubstr(R"("-9223372036854775807 - 1")"));  // nor a formula
    EXPECT_THAT(code, testing::ContainsRegex("\"half\", Type::Float, .*2"));
}

TEST_F(Generated, EachElementKnowsItsLines) {
    const MarkedText code = generate_code(checked_);
    const std::string drive = lines_of(code, {"actors", "plan"});
    EXPECT_THAT(drive, HasSubstr("Drive plan_(\"plan\""));
    EXPECT_THAT(drive, HasSubstr("plan.after(plan_, core::Drive::Done, while_);"));
    EXPECT_THAT(drive, testing::Not(HasSubstr("new_")));
    const std::string global = lines_of(code, {"start", "supervisors", "new"});
    EXPECT_THAT(global, HasSubstr("See new_(\"new\""));
    EXPECT_THAT(global, HasSubstr("plan.always(new_, core::See::Seen, plan_);"));
    EXPECT_EQ(lines_of(code, {"start"}), "    plan.start_with(while_);\n");
}

}  // namespace
}  // namespace vagus::plan
