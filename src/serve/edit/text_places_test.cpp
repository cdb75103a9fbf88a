#include "serve/edit/text_places.hpp"

#include <gtest/gtest.h>

#include "serve/edit/doc_finding.hpp"

namespace vagus::serve {
namespace {

using aesl::Position;

TEST(TextPlaces, BytesColumnsAndUnitsAreCountedApart) {
    // Line 2: é (2 bytes, 1 unit), 😀 (4 bytes, 2 units), b.
    const std::string text = "a\né😀b\r\n\nz";
    const TextPlaces places(text);
    EXPECT_EQ(places.lines(), 4u);
    EXPECT_EQ(places.byte_of({1, 1}), 0u);
    EXPECT_EQ(places.byte_of({2, 1}), 2u);
    EXPECT_EQ(places.byte_of({2, 2}), 4u);
    EXPECT_EQ(places.byte_of({2, 3}), 8u);
    EXPECT_EQ(places.byte_of({2, 4}), 9u);   // behind b
    EXPECT_EQ(places.byte_of({2, 99}), 9u);  // the end of the line, before its line end
    EXPECT_EQ(places.byte_of({9, 1}), text.size());
    EXPECT_EQ(places.unit_of({2, 3}), 5u);
    EXPECT_EQ(places.unit_of({4, 2}), 10u);
    EXPECT_EQ(places.position_of(8), (Position{2, 3}));
    EXPECT_EQ(places.position_of(12), (Position{4, 1}));
    EXPECT_EQ(places.position_of(99), (Position{4, 2}));
    EXPECT_EQ(places.line(2), "é😀b");
    EXPECT_EQ(line_at(text, 2), "é😀b");
    EXPECT_EQ(line_at(text, 4), "z");
    EXPECT_EQ(line_at(text, 5), "");
}

TEST(TextPlaces, ACursorSaysTheSameOnOneWalk) {
    const std::string text = "a\né😀b\r\n\nz";
    PlaceCursor cursor(text);
    const TextPlaces places(text);
    for (const size_t byte : {0u, 1u, 2u, 4u, 8u, 9u, 11u, 12u, 13u, 13u}) {
        EXPECT_EQ(cursor.position_of(byte), places.position_of(byte)) << byte;
        EXPECT_EQ(cursor.unit_of(byte), places.unit_of_byte(byte)) << byte;
    }
}

TEST(TextPlaces, TextsAreCutBetweenCharacters) {
    EXPECT_EQ(line_of("a\tb\n", 9), "a b ");
    EXPECT_EQ(line_of("a\t\xc3\xa9", 3), "a ");
}

TEST(DocFinding, SentencesOfReadersAreTakenApart) {
    const std::string text = "{\n  \"seed\": 12x\n}\n";
    const DocFinding one =
        finding_of_sentence("a/w.json", text, Severity::Error, "world", "a/w.json:2:11: wrong: b");
    EXPECT_EQ(one.at, (Position{2, 11}));
    EXPECT_EQ(one.end, (Position{2, 14}));
    EXPECT_EQ(one.what, "wrong: b");
    const DocFinding key =
        finding_of_sentence("w", text, Severity::Warning, "world", "w:2:3: warning: key");
    EXPECT_EQ(key.end, (Position{2, 9}));
    EXPECT_EQ(key.what, "key");
    const DocFinding none = finding_of_sentence("w", text, Severity::Error, "x", "no place");
    EXPECT_EQ(none.at, (Position{1, 1}));
    EXPECT_EQ(none.what, "no place");
}

}  // namespace
}  // namespace vagus::serve
