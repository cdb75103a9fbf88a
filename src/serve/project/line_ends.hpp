// A text as it is edited, with line feeds only and without a byte-order mark, and beside it what
// the file has: what each line ends with, and whether the mark comes first. A place then counts
// each line end as one, as editors in a browser do, and a line that nobody touches is saved with
// the bytes that it had.
//
//     FileText file = FileText::read("a\r\nb\nc");
//     file.apply({{1, 1, "!\n"}});
//     file.text();    // "a!\n\nb\nc"
//     file.bytes();   // "a!\r\n\r\nb\nc"
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "serve/project/difference.hpp"

namespace vagus::serve {

enum class LineEnd : uint8_t { Lf, CrLf, Cr };

// "\r\n" and "\r" as "\n".
std::string with_line_feeds(std::string_view text);

class FileText {
public:
    FileText() = default;
    static FileText read(std::string_view bytes);

    const std::string& text() const { return text_; }
    std::string bytes() const;
    // As in the protocol: lf, crlf, mixed.
    std::string_view ends() const;

    // Places are bytes of text(), in their order; what is put in has line feeds only. New lines end
    // as those that they stand for, or as the line before them.
    void apply(const std::vector<TextDifference>& changes);

private:
    std::string text_;
    std::vector<LineEnd> ends_;  // one for each line feed of text_
    bool mark_ = false;
};

}  // namespace vagus::serve
