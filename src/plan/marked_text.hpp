// A text that is put together line by line and knows which element of a plan each part is about.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vagus::plan {

// Lines of a text, from 1, that belong to one element.
struct CodeMark {
    std::vector<std::string> keys;  // that lead to it in the plan file, as actors, NAME
    size_t first = 0, last = 0;
};

class MarkedText {
public:
    MarkedText& operator+=(std::string_view text);
    MarkedText& operator+=(const MarkedText& other);
    // Whole lines about one element.
    void add(std::string_view lines, const std::vector<std::string>& keys);

    const std::string& text() const { return text_; }
    const std::vector<CodeMark>& marks() const { return marks_; }

private:
    std::string text_;
    size_t lines_ = 0;
    std::vector<CodeMark> marks_;
};

}  // namespace vagus::plan
