#include "session/diagnostic_text.hpp"

#include <algorithm>

#include "base/text.hpp"

namespace vagus::session {
namespace {

constexpr size_t kLineShownMax = 200;  // code points of a source line; the marks must stay in sight

// Line `number` of the text, from 1, without its end.
std::string_view line_of(std::string_view source, int number) {
    for (int line = 1; line < number; line++) {
        const size_t end = source.find('\n');
        if (end == std::string_view::npos) return {};
        source.remove_prefix(end + 1);
    }
    source = source.substr(0, source.find('\n'));
    if (source.ends_with('\r')) source.remove_suffix(1);
    return source;
}

// One code point on the page for each of the text: a tab is a space, so that the marks stand right.
std::string flat(std::string_view line) {
    std::string text;
    size_t shown = 0;
    while (!line.empty() && shown++ < kLineShownMax) {
        const CodePoint point = first_code_point(line);
        const size_t bytes = std::max<size_t>(point.bytes, 1);
        const bool control = point.bytes == 0 || point.value < 0x20 || point.value == 0x7f;
        text += control ? std::string_view(point.value == '\t' ? " " : "?") : line.substr(0, bytes);
        line.remove_prefix(bytes);
    }
    return text;
}

}  // namespace

std::string diagnostic_line(const SourceText& text, const aesl::Diagnostic& diagnostic,
                            Severity severity) {
    std::string line = text.file + ":";
    if (diagnostic.at.line > 0) {
        line += std::to_string(diagnostic.at.line + text.first_line - 1) + ":" +
                std::to_string(diagnostic.at.column) + ":";
    }
    line += severity == Severity::Error ? " error: " : " warning: ";
    return line + diagnostic.message + " [" + diagnostic.code + "]";
}

std::vector<std::string> marked_source(const SourceText& text, const aesl::Diagnostic& diagnostic) {
    const aesl::Position at = diagnostic.at;
    if (at.line <= 0 || at.column <= 0) return {};
    const std::string source = flat(line_of(text.source, at.line));
    const std::string number = std::to_string(at.line + text.first_line - 1);
    const std::string margin(std::max<size_t>(5, number.size() + 1), ' ');
    const size_t width = count_code_points(source) + 1;  // the end of the line can be marked
    const size_t from = std::min(static_cast<size_t>(at.column) - 1, width - 1);
    size_t marks = 1;
    if (diagnostic.end.line == at.line && diagnostic.end.column > at.column) {
        marks = static_cast<size_t>(diagnostic.end.column - at.column);
    }
    marks = std::clamp<size_t>(marks, 1, width - from);
    return {margin.substr(number.size()) + number + " | " + source,
            margin + " | " + std::string(from, ' ') + "^" + std::string(marks - 1, '~')};
}

std::vector<std::string> diagnostic_report(const SourceText& text, const aesl::Compilation& done) {
    std::vector<std::string> lines;
    const auto add = [&](const std::vector<aesl::Diagnostic>& list, Severity severity) {
        for (const aesl::Diagnostic& diagnostic : list) {
            lines.push_back(diagnostic_line(text, diagnostic, severity));
            for (std::string& line : marked_source(text, diagnostic)) lines.push_back(line);
        }
    };
    add(done.errors, Severity::Error);
    add(done.warnings, Severity::Warning);
    return lines;
}

}  // namespace vagus::session
