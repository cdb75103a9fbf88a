#include "serve/edit/plan_findings.hpp"

#include <algorithm>
#include <map>

#include "base/json.hpp"
#include "serve/edit/text_places.hpp"
#include "toolbox/shadowed.hpp"

namespace vagus::serve {

namespace {

using PlaceKey = std::pair<int, int>;

bool is_name_letter(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) || letter == '_';
}

// The ends of a plan by their names in its drawing; what is quoted stays as it is written.
std::string as_drawn(std::string message) {
    for (const std::string_view name : {"@terminate", "@ignore"}) {
        for (size_t at = message.find(name); at != std::string::npos; at = message.find(name, at)) {
            const bool quoted = at > 0 && message[at - 1] == '"';
            quoted ? ++at : (message.erase(at, 1), at);
        }
    }
    return message;
}

// Where in a text a name is a word of its own; npos if it does not.
size_t find_word(std::string_view text, std::string_view name, size_t from) {
    for (size_t at = text.find(name, from); at != text.npos; at = text.find(name, at + 1)) {
        const bool begins = at == 0 || !is_name_letter(text[at - 1]);
        const size_t end = at + name.size();
        if (begins && (end >= text.size() || !is_name_letter(text[end]))) return at;
    }
    return text.npos;
}

// One file with its strings by their places, for fixes, and the keys that lead to each place.
class PlanText {
public:
    explicit PlanText(std::string text) : text_(std::move(text)), places_(text_) {}

    const std::string& text() const { return text_; }

    FindingFix fix_of(const std::string& doc, plan::Finding const& finding) {
        FindingFix fix{"Write \"" + finding.meant->name + "\"", {}};
        if (!read_) read();
        const auto [from, to] = strings_.equal_range({finding.line, finding.column});
        for (auto one = from; one != to && fix.edits.empty(); ++one) {
            if (one->second.is_key != finding.meant->is_key) continue;
            fix.edits = edits_in(doc, one->second, *finding.meant);
        }
        return fix;
    }

    // Empty: nothing begins there.
    nlohmann::json keys_to(int line, int column) {
        if (!read_) read();
        const auto found = keys_.find({line, column});
        return found == keys_.end() ? nlohmann::json::array() : found->second;
    }

private:
    struct Found {
        size_t begin = 0;
        std::string raw;
        bool is_key = false;
    };

    void read() {
        read_ = true;
        const auto json = read_json(text_);
        const auto* root = std::get_if<JsonValue>(&json);
        if (!root) return;
        walk(*root, {});
        auto way = nlohmann::json::array();
        note(*root, way);
    }

    // A member is found by the place of its key, and by that of its value.
    void note(const JsonValue& json, nlohmann::json& way) {
        const auto go = [&](nlohmann::json key, Place at, const JsonValue& value) {
            way.push_back(std::move(key));
            keys_.try_emplace({at.line, at.column}, way);
            keys_.try_emplace({value.at.line, value.at.column}, way);
            note(value, way);
            way.erase(way.size() - 1);
        };
        size_t index = 0;
        for (const JsonValue& item : json.items) go(index++, item.at, item);
        for (const JsonMember& member : json.members) go(member.key, member.at, member.value);
    }

    // A string is found at its own place, and at that of the key before it.
    void walk(const JsonValue& json, std::vector<Place> keys) {
        if (json.kind == JsonKind::String) {
            keys.push_back(json.at);
            for (const Place& place : keys) add(place, json.at, json.raw, false);
        }
        for (const JsonValue& item : json.items) walk(item, keys);
        for (const JsonMember& member : json.members) {
            add(member.at, member.at, member.raw_key, true);
            walk(member.value, {member.at});
        }
    }
    void add(Place at, Place begin, const std::string& raw, bool is_key) {
        strings_.emplace(PlaceKey(at.line, at.column),
                         Found{places_.byte_of({begin.line, begin.column}), raw, is_key});
    }

    // The whole string, or the name wherever it is in a formula.
    std::vector<TextEdit> edits_in(const std::string& doc, const Found& found,
                                   const plan::Meant& meant) const {
        std::vector<TextEdit> edits;
        const auto replace = [&](size_t from, size_t size, std::string text) {
            edits.push_back({doc, places_.unit_of_byte(found.begin + from),
                             places_.unit_of_byte(found.begin + from + size), std::move(text)});
        };
        if (found.raw == json_quote(meant.typed)) {
            replace(0, found.raw.size(), json_quote(meant.name));
            return edits;
        }
        for (size_t at = find_word(found.raw, meant.typed, 0); at != std::string::npos;
             at = find_word(found.raw, meant.typed, at + meant.typed.size())) {
            replace(at, meant.typed.size(), meant.name);
        }
        return edits;
    }

    const std::string text_;
    const TextPlaces places_;
    bool read_ = false;
    std::multimap<PlaceKey, Found> strings_;
    std::map<PlaceKey, nlohmann::json> keys_;
};

}  // namespace

void add_warnings(const plan::Checked& checked, const std::optional<session::BusNames>& names,
                  plan::Findings& findings) {
    const auto add = [&](const plan::Findings& more) {
        findings.insert(findings.end(), more.begin(), more.end());
    };
    add(toolbox::find_shadowed(checked.plans, *checked.library));
    if (names) add(names->check(checked.plans, *checked.library));
}

std::vector<DocFinding> plan_findings(const plan::Findings& findings, const TextOf& text_of) {
    std::map<std::string, PlanText> texts;
    std::vector<DocFinding> all;
    for (const plan::Finding& one : findings) {
        auto text = texts.find(one.file);
        if (text == texts.end()) {
            const auto read = text_of(one.file);
            text = texts.try_emplace(one.file, read.ok() ? read.value() : "").first;
        }
        DocFinding finding{one.file,
                           one.severity,
                           one.rule,
                           one.element,
                           {one.line, std::max(one.column, 1)},
                           {},
                           as_drawn(one.message),
                           {}};
        finding.keys = text->second.keys_to(one.line, one.column);
        if (one.missing) {
            if (one.missing->part == "start") finding.keys = nlohmann::json::array();
            finding.keys.push_back(one.missing->part);
            finding.keys.push_back(one.missing->name);
        }
        finding.end = end_of_word(text->second.text(), finding.at);
        if (one.meant) {
            FindingFix fix = text->second.fix_of(one.file, one);
            if (!fix.edits.empty()) finding.fixes.push_back(std::move(fix));
        }
        all.push_back(std::move(finding));
    }
    return all;
}

}  // namespace vagus::serve
