#include "session/diagnostic_text.hpp"

#include <gmock/gmock.h>

namespace vagus::session {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const aesl::Diagnostic kUnknown{"VARIABLE_NOT_DEFINED", 34, {2, 1}, {2, 6}, "There is no speeed."};

std::string line_of(const SourceText& text, const aesl::Diagnostic& found, Severity severity) {
    return text_of(in_file(text, found, severity));
}

std::vector<std::string> source_of(const SourceText& text, const aesl::Diagnostic& found) {
    return in_file(text, found, Severity::Error).source;
}

TEST(DiagnosticText, NamesThePlaceInTheFileNotInTheScript) {
    EXPECT_EQ(line_of({"a.aesl", "var x\nspeeed = 3\n", 1}, kUnknown, Severity::Error),
              "a.aesl:2:1: error: There is no speeed. [VARIABLE_NOT_DEFINED]");
    // The script of a project begins on line 11 of the file: its second line is the file's twelfth.
    EXPECT_EQ(line_of({"a.aesl", "var x\nspeeed = 3\n", 11}, kUnknown, Severity::Warning),
              "a.aesl:12:1: warning: There is no speeed. [VARIABLE_NOT_DEFINED]");
}

TEST(DiagnosticText, AMistakeWithoutPlaceNamesTheFileOnly) {
    const aesl::Diagnostic whole{"SCRIPT_TOO_BIG", 1, {0, 0}, {0, 0}, "Too big."};
    EXPECT_EQ(line_of({"a.aesl", "", 1}, whole, Severity::Error),
              "a.aesl: error: Too big. [SCRIPT_TOO_BIG]");
    EXPECT_THAT(source_of({"a.aesl", "", 1}, whole), IsEmpty());
}

TEST(DiagnosticText, MarksStandUnderWhatIsMeant) {
    EXPECT_THAT(source_of({"a.aesl", "var x\nspeeed = 3\n", 11}, kUnknown),
                ElementsAre("   12 | speeed = 3", "      | ^~~~~"));
}

// Columns count code points; a tab counts one, and takes one column here.
TEST(DiagnosticText, TabsAndLettersBeyondAsciiKeepTheMarksInPlace) {
    const aesl::Diagnostic at_x{"X", 1, {1, 9}, {1, 10}, "x"};
    EXPECT_THAT(source_of({"a.aesl", "\tgröße = x", 1}, at_x),
                ElementsAre("    1 |  größe = x", "      |         ^"));
}

TEST(DiagnosticText, TheEndOfALineAndPlacesBeyondItCanBeMarked) {
    const aesl::Diagnostic at_end{"X", 1, {1, 4}, {1, 4}, "x"};
    EXPECT_THAT(source_of({"a.aesl", "a =\r\n", 1}, at_end),
                ElementsAre("    1 | a =", "      |    ^"));
    const aesl::Diagnostic beyond{"X", 1, {7, 40}, {7, 90}, "x"};
    EXPECT_THAT(source_of({"a.aesl", "a =\n", 1}, beyond), ElementsAre("    7 | ", "      | ^"));
}

TEST(DiagnosticText, AVeryLongLineIsCutAndTheMarkStaysInside) {
    const aesl::Diagnostic far{"X", 1, {1, 5000}, {1, 6000}, "x"};
    const auto lines = source_of({"a.aesl", std::string(10000, 'a'), 1}, far);
    ASSERT_EQ(lines.size(), 2u);
    EXPECT_EQ(lines[0].size(), 8u + 200u);
    EXPECT_EQ(lines[1].size(), 8u + 200u + 1u);
}

}  // namespace
}  // namespace vagus::session
