#include "plan/marked_text.hpp"

#include <algorithm>

namespace vagus::plan {

namespace {

size_t lines_in(std::string_view text) {
    return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

MarkedText& MarkedText::operator+=(std::string_view text) {
    text_ += text;
    lines_ += lines_in(text);
    return *this;
}

MarkedText& MarkedText::operator+=(const MarkedText& other) {
    for (CodeMark mark : other.marks_) {
        mark.first += lines_;
        mark.last += lines_;
        marks_.push_back(std::move(mark));
    }
    return *this += other.text_;
}

void MarkedText::add(std::string_view lines, const std::vector<std::string>& keys) {
    if (lines.empty()) return;
    marks_.push_back({keys, lines_ + 1, lines_ + lines_in(lines)});
    *this += lines;
}

}  // namespace vagus::plan
