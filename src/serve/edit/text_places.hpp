// One text with its places counted in every way that is in use: bytes, lines and columns in
// characters (compilers, pages), UTF-16 units (editors in a browser). Each answer takes a search
// among the lines and a walk along one of them, however long the text is.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "aesl/diagnostic.hpp"

namespace vagus::serve {

class TextPlaces {
public:
    // `text` is borrowed.
    explicit TextPlaces(std::string_view text);

    // Places behind the end of a line, or of the text, count as that end.
    size_t byte_of(aesl::Position at) const;
    size_t unit_of(aesl::Position at) const { return unit_of_byte(byte_of(at)); }
    size_t unit_of_byte(size_t byte) const;
    aesl::Position position_of(size_t byte) const;

    size_t lines() const { return lines_.size(); }
    // Without its line end; `line` counts from 1.
    std::string_view line(size_t line) const;

private:
    struct Line {
        size_t byte = 0, unit = 0;  // of its beginning
    };
    size_t line_at(size_t byte) const;

    std::string_view text_;
    std::vector<Line> lines_;
};

// The same for places that come one behind the other: together they cost one walk.
class PlaceCursor {
public:
    // `text` is borrowed.
    explicit PlaceCursor(std::string_view text) : text_(text) {}
    // `byte` is not before that of the last question.
    aesl::Position position_of(size_t byte);
    size_t unit_of(size_t byte);

private:
    void walk_to(size_t byte);

    std::string_view text_;
    size_t byte_ = 0, unit_ = 0;
    aesl::Position at_{1, 1};
};

// A line by its number from 1, without its line end.
std::string_view line_at(std::string_view text, size_t line);
// At most so many bytes of a text, without control characters: for a line of the protocol.
std::string line_of(std::string_view text, size_t bytes_max);

}  // namespace vagus::serve
