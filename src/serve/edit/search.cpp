#include "serve/edit/search.hpp"

#include <algorithm>
#include <set>

#include "aesl/project.hpp"
#include "base/text.hpp"
#include "serve/edit/doc_finding.hpp"
#include "serve/edit/edited_project.hpp"
#include "serve/edit/seen.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kPlacesMax = 100'000;  // of text.replace

bool is_text(const std::string& kind) {
    return kind != "folder" && kind != "picture" && kind != "other";
}

// The lines of a project that are those of its scripts.
std::vector<std::pair<size_t, size_t>> script_lines(const std::string& path,
                                                    std::string_view text) {
    std::vector<std::pair<size_t, size_t>> lines;
    const auto project = aesl::parse_project(text, path);
    if (!project.ok()) return lines;
    for (const aesl::Script& script : project.value().scripts) {
        const auto first = static_cast<size_t>(script.first_line);
        const auto more = std::count(script.source.begin(), script.source.end(), '\n');
        lines.emplace_back(first, first + static_cast<size_t>(more));
    }
    return lines;
}

}  // namespace

Search::Search(Desk& desk, Files& files, Scripts& scripts, std::string epoch)
    : files_(files), scripts_(scripts), epoch_(std::move(epoch)) {
    desk.command("text.search", [this](const Call& call) { search(call); });
    desk.command("text.replace", [this](const Call& call) { replace(call); });
}

std::optional<Pattern> Search::pattern_of(const Call& call, std::string& why) {
    auto made = Pattern::make(
        call.in["text"].get<std::string>(),
        {.regex = call.in["regex"], .exact_case = call.in["case"], .whole = call.in["whole"]});
    if (made.ok()) return std::move(made.value());
    why = made.error().what;
    return std::nullopt;
}

// ---- what there is to look through ----

std::vector<Search::Text> Search::texts(Budget& budget, bool& more) {
    std::vector<Text> all;
    for (const FileInfo& file : files_.list(more)) {
        if (!is_text(file.kind) || file.size > kTextBytesMax) continue;
        if (file.size > budget.bytes) {
            more = true;
            break;
        }
        budget.bytes -= file.size;
        add_texts_of(file, all);
    }
    return all;
}

void Search::add_texts_of(const FileInfo& file, std::vector<Text>& texts) {
    auto text = files_.text(file.path);
    if (!text.ok() || malformed_utf8_at(text.value())) return;
    // The file comes before its scripts: what changes around them leaves them as they are.
    Text whole{file.path, std::move(text.value())};
    if (file.kind == "script") whole.without = script_lines(file.path, whole.text);
    texts.push_back(std::move(whole));
    for (const ScriptPart& part : scripts_.parts()) {
        if (part.file != file.path || part.doc == file.path) continue;
        const auto opened = files_.open(part.doc);
        if (opened.ok()) texts.push_back({part.doc, opened.value().text});
    }
}

bool Search::each_match(const Pattern& pattern, const Text& text, Budget& budget, const See& see) {
    size_t begin = 0;
    for (size_t number = 1; begin <= text.text.size(); ++number) {
        const size_t end = std::min(text.text.find('\n', begin), text.text.size());
        std::string_view line = std::string_view(text.text).substr(begin, end - begin);
        if (line.ends_with('\r')) line.remove_suffix(1);
        const bool passed =
            line.size() > kSearchLineBytesMax ||
            std::any_of(text.without.begin(), text.without.end(), [&](const auto& lines) {
                return number >= lines.first && number <= lines.second;
            });
        for (size_t from = 0; !passed;) {
            const auto match = pattern.find(line, from, budget.steps);
            if (budget.steps == 0) return false;
            if (!match) break;
            if (!see({number, begin, line, *match})) return false;
            from = match->to;
        }
        begin = end + 1;
    }
    return true;
}

// ---- the commands ----

void Search::search(const Call& call) {
    Json spots = Json::array();
    std::string why;
    const auto pattern = pattern_of(call, why);
    if (!pattern) {
        return call.done({{"spots", spots}, {"more", false}, {"why", line_of(why, 300)}});
    }
    bool more = false;
    Budget budget;
    for (const Text& text : texts(budget, more)) {
        PlaceCursor cursor(text.text);
        const bool all = each_match(*pattern, text, budget, [&](const Found& found) {
            if (spots.size() >= kSpotsMax) return false;
            const auto at = cursor.position_of(found.match.from + found.line_begin);
            const auto end = cursor.position_of(found.match.to + found.line_begin);
            spots.push_back({{"doc", text.doc},
                             {"at", json_of(at)},
                             {"end", json_of(end)},
                             {"line_text", line_of(found.line_text, 400)}});
            return true;
        });
        if (all) continue;
        more = true;
        break;
    }
    call.done({{"spots", std::move(spots)}, {"more", more}});
}

std::vector<TextChange> Search::changes_of(const Call& call, const Pattern& pattern,
                                           const Text& text, Budget& budget) const {
    const std::string by = call.in["by"];
    PlaceCursor cursor(text.text);
    std::vector<TextChange> changes;
    each_match(pattern, text, budget, [&](const Found& found) {
        const size_t from = cursor.unit_of(found.line_begin + found.match.from);
        const size_t to = cursor.unit_of(found.line_begin + found.match.to);
        changes.push_back({from, to, pattern.replacement(found.match, found.line_text, by)});
        return changes.size() <= kPlacesMax;
    });
    return changes;
}

void Search::replace(const Call& call) {
    if (!seen_all(call, files_, epoch_)) return;
    std::string why;
    const auto pattern = pattern_of(call, why);
    if (!pattern) return call.fail("bad_input", why);
    std::optional<std::set<std::string>> only;
    if (call.in.contains("docs") && !call.in["docs"].is_null()) {
        only = call.in["docs"].get<std::set<std::string>>();
    }
    bool more = false;
    Budget budget;
    std::vector<std::pair<std::string, std::vector<TextChange>>> planned;
    size_t places = 0;
    for (const Text& text : texts(budget, more)) {
        if (only && !only->contains(text.doc)) continue;
        auto changes = changes_of(call, *pattern, text, budget);
        places += changes.size();
        if (!changes.empty()) planned.emplace_back(text.doc, std::move(changes));
    }
    // Half a replacement would be worse than none.
    if (budget.steps == 0 || more || places > kPlacesMax) {
        return call.fail("limit", "that is too much to replace at once; replace in fewer files");
    }
    Json changed = Json::array();
    for (const auto& [doc, changes] : planned) {
        const auto edited = files_.edit(doc, files_.version(doc), changes, made_for(call.member));
        if (!edited.ok()) return call.fail(edited.error());
        changed.push_back(doc);
    }
    call.done({{"changed", std::move(changed)}, {"places", places}});
}

}  // namespace vagus::serve
