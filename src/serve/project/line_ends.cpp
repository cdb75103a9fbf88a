#include "serve/project/line_ends.hpp"

#include <algorithm>

#include "serve/project/text_change.hpp"

namespace vagus::serve {

namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";

size_t feeds(std::string_view text) {
    return static_cast<size_t>(std::count(text.begin(), text.end(), '\n'));
}

LineEnd end_at(std::string_view text, size_t at) {
    if (text[at] == '\n') return LineEnd::Lf;
    return at + 1 < text.size() && text[at + 1] == '\n' ? LineEnd::CrLf : LineEnd::Cr;
}

std::string_view bytes_of(LineEnd end) {
    switch (end) {
        case LineEnd::Lf:
            return "\n";
        case LineEnd::CrLf:
            return "\r\n";
        case LineEnd::Cr:
            return "\r";
    }
    return "\n";
}

}  // namespace

std::string with_line_feeds(std::string_view text) {
    if (text.find('\r') == text.npos) return std::string(text);
    std::string result;
    for (size_t at = 0; at < text.size(); ++at) {
        const bool pair = text[at] == '\r' && at + 1 < text.size() && text[at + 1] == '\n';
        if (pair) continue;
        result += text[at] == '\r' ? '\n' : text[at];
    }
    return result;
}

FileText FileText::read(std::string_view bytes) {
    FileText file;
    file.mark_ = bytes.starts_with(kByteOrderMark);
    if (file.mark_) bytes.remove_prefix(kByteOrderMark.size());
    for (size_t at = 0; at < bytes.size(); ++at) {
        if (bytes[at] != '\n' && bytes[at] != '\r') {
            file.text_ += bytes[at];
            continue;
        }
        file.ends_.push_back(end_at(bytes, at));
        file.text_ += '\n';
        if (file.ends_.back() == LineEnd::CrLf) ++at;
    }
    return file;
}

std::string FileText::bytes() const {
    std::string result(mark_ ? kByteOrderMark : "");
    size_t line = 0;
    for (size_t at = 0; at < text_.size(); ++at) {
        if (text_[at] != '\n') {
            result += text_[at];
            continue;
        }
        LineEnd end = ends_[line++];
        // What was between the two is gone: together they would be one line end.
        const bool joins = end == LineEnd::Cr && at + 1 < text_.size() && text_[at + 1] == '\n' &&
                           ends_[line] == LineEnd::Lf;
        if (joins) end = LineEnd::CrLf;
        result += bytes_of(end);
    }
    return result;
}

std::string_view FileText::ends() const {
    const auto lf = std::count(ends_.begin(), ends_.end(), LineEnd::Lf);
    const auto crlf = std::count(ends_.begin(), ends_.end(), LineEnd::CrLf);
    const auto all = static_cast<long>(ends_.size());
    return lf == all ? "lf" : crlf == all ? "crlf" : "mixed";
}

void FileText::apply(const std::vector<TextDifference>& changes) {
    std::vector<LineEnd> ends;
    size_t byte = 0;
    size_t line = 0;  // of the ends before
    const auto keep = [&](size_t to) {
        for (const size_t behind = line + feeds(std::string_view(text_).substr(byte, to - byte));
             line < behind; ++line) {
            ends.push_back(ends_[line]);
        }
        byte = to;
    };
    for (const TextDifference& change : changes) {
        keep(change.from);
        const size_t gone = feeds(std::string_view(text_).substr(byte, change.to - byte));
        const LineEnd usual = line > 0              ? ends_[line - 1]
                              : line < ends_.size() ? ends_[line]
                                                    : LineEnd::Lf;
        const size_t come = feeds(change.insert);
        for (size_t i = 0; i < come; ++i) ends.push_back(i < gone ? ends_[line + i] : usual);
        line += gone;
        byte = change.to;
    }
    keep(text_.size());
    text_ = applied(text_, changes);
    ends_ = std::move(ends);
}

}  // namespace vagus::serve
