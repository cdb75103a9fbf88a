#include "serve/edit/doc_finding.hpp"

#include <algorithm>
#include <charconv>

#include "base/text.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

using aesl::Position;

namespace {

constexpr size_t kEditsMax = 100;  // of a fix: "[Edit; 100]"
constexpr size_t kFixesMax = 8;
constexpr size_t kKeysMax = 100;
constexpr int kPlaceMax = 10'000'000;

Json json_of(const FindingFix& fix) {
    Json edits = Json::array();
    for (const TextEdit& edit : fix.edits) {
        edits.push_back(
            {{"doc", edit.doc}, {"from", edit.from}, {"to", edit.to}, {"text", edit.text}});
    }
    return {{"label", line_of(fix.label, 200)}, {"edits", std::move(edits)}};
}

// Takes "12:" from the front of a text.
std::optional<int> take_number(std::string_view& text) {
    int number = 0;
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (bad != std::errc() || end == text.data() + text.size() || *end != ':') return std::nullopt;
    text.remove_prefix(static_cast<size_t>(end - text.data()) + 1);
    return number;
}

size_t end_of_string(std::string_view text, size_t at) {
    for (++at; at < text.size() && text[at] != '"' && text[at] != '\n'; ++at) {
        if (text[at] == '\\') ++at;
    }
    return std::min(at + 1, text.size());
}

}  // namespace

Json json_of(Position at) {
    return {{"line", std::clamp(at.line, 1, kPlaceMax)},
            {"column", std::clamp(at.column, 1, kPlaceMax)}};
}

Position position_of(const Json& place) {
    return {place["line"].get<int>(), place["column"].get<int>()};
}

Json json_of(const DocFinding& finding) {
    Json fixes = Json::array();
    for (const FindingFix& fix : finding.fixes) {
        if (fixes.size() < kFixesMax && fix.edits.size() <= kEditsMax)
            fixes.push_back(json_of(fix));
    }
    Json json = {{"doc", finding.doc},
                 {"severity", std::string(name_of(finding.severity))},
                 {"code", line_of(finding.code, 64)},
                 {"at", json_of(finding.at)},
                 {"end", json_of(std::max(finding.at, finding.end))},
                 {"what", utf8_prefix(finding.what, 2000)},
                 {"fixes", std::move(fixes)}};
    if (!finding.keys.empty() && finding.keys.size() <= kKeysMax) json["keys"] = finding.keys;
    if (!finding.element.empty()) json["element"] = line_of(finding.element, 256);
    return json;
}

Position end_of_word(std::string_view text, Position at) {
    if (at.line < 1) return at;
    const TextPlaces places(text);
    const size_t begin = places.byte_of(at);
    size_t end = begin;
    constexpr std::string_view kBetween = " \t\r\n,:{}[]\"";
    if (begin < text.size() && text[begin] == '"') {
        end = end_of_string(text, begin);
    } else {
        while (end < text.size() && kBetween.find(text[end]) == kBetween.npos) ++end;
        if (end == begin && end < text.size() && text[end] != '\n') ++end;
    }
    return places.position_of(end);
}

DocFinding finding_of_sentence(const std::string& doc, std::string_view text, Severity severity,
                               const std::string& code, std::string_view sentence) {
    DocFinding finding{doc, severity, code, {}, {1, 1}, {1, 1}, {}, {}};
    std::string_view rest = sentence;
    if (rest.starts_with(doc + ":")) {
        rest.remove_prefix(doc.size() + 1);
        std::string_view numbers = rest;
        if (const auto line = take_number(numbers)) {
            finding.at.line = *line;
            rest = numbers;
            if (const auto column = take_number(numbers)) {
                finding.at.column = *column;
                rest = numbers;
            }
        }
    }
    while (rest.starts_with(' ')) rest.remove_prefix(1);
    for (const std::string_view word : {"error: ", "warning: "}) {
        if (rest.starts_with(word)) rest.remove_prefix(word.size());
    }
    finding.what = rest;
    finding.end = end_of_word(text, finding.at);
    return finding;
}

}  // namespace vagus::serve
