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

// One code point on the page for each of the text: a tab is a space, so that the marks are in line.
std::string flat(std::string_view line) {
    std::string text;
    size_t shown = 0;
    while (!line.empty() && shown++ < kLineShownMax) {
        const CodePoint point = first_code_point(line);
        const size_t bytes = std::max<size_t>(point.bytes, 1);
        const bool obeyed = point.bytes == 0 || is_obeyed(point.value);
        text += obeyed ? std::string_view(point.value == '\t' ? " " : "?") : line.substr(0, bytes);
        line.remove_prefix(bytes);
    }
    return text;
}

// The line of the script and the marks under it; empty if there is no position.
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

}  // namespace

Diagnostic in_file(const SourceText& text, const aesl::Diagnostic& diagnostic, Severity severity) {
    Place at;
    if (diagnostic.at.line > 0) {
        at = {diagnostic.at.line + text.first_line - 1, diagnostic.at.column};
    }
    return {.severity = severity,
            .file = text.file,
            .at = at,
            .sentence = diagnostic.message,
            .code = diagnostic.code,
            .source = marked_source(text, diagnostic)};
}

std::vector<Diagnostic> diagnostics_of(const SourceText& text, const aesl::Compilation& done) {
    std::vector<Diagnostic> list;
    for (const auto& error : done.errors) list.push_back(in_file(text, error, Severity::Error));
    for (const auto& warning : done.warnings) {
        list.push_back(in_file(text, warning, Severity::Warning));
    }
    return list;
}

}  // namespace vagus::session
