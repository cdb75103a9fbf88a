#include "fleet/project_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/seconds.hpp"
#include "fleet/limits.hpp"
#include "fleet/topic.hpp"
#include "plan/word_formula.hpp"

namespace vagus::fleet {
namespace {

// Empty: it asks for no more words of nodes than a robot reads.
std::string too_many_words(const plan::WordFormula& formula) {
    using Of = plan::WordFormula::Name::Of;
    const auto words = std::ranges::count(formula.names(), Of::Word, &plan::WordFormula::Name::of);
    if (static_cast<size_t>(words) <= kConditionWordsMax) return "";
    return fmt::format("expected at most {} words of nodes, found {}; remove some",
                       kConditionWordsMax, words);
}

class Reader {
public:
    explicit Reader(JsonObject& in) : in_(in) {}

    ProjectPart part();

private:
    bool fits(std::string_view key, size_t count, size_t max);
    bool is_good_name(const JsonValue& json, std::string_view key);
    bool is_first(const JsonValue& json, std::string_view key, const std::string& text);
    std::vector<std::string> names(std::string_view key, size_t max);
    std::vector<Hears> hear();
    std::optional<Hears> hear(const JsonValue& json);
    std::vector<Tells> tell();
    std::optional<Healthy> healthy();

    JsonObject& in_;
    std::set<std::pair<std::string_view, std::string>> seen_;
};

bool Reader::fits(std::string_view key, size_t count, size_t max) {
    if (count <= max) return true;
    in_.complain(in_.find(key, Need::Optional)->at,
                 fmt::format("\"{}\" of {}: expected at most {}, found {}; remove some", key,
                             in_.name(), max, count));
    return false;
}

bool Reader::is_good_name(const JsonValue& json, std::string_view key) {
    if (json.kind == JsonKind::String && is_name(json.text)) return true;
    const std::string found = json.kind == JsonKind::String
                                  ? fmt::format("a text of {} bytes", json.text.size())
                                  : std::string(name_of(json.kind));
    in_.complain(json.at,
                 fmt::format("\"{}\" of {}: expected a name of 1 to {} bytes without control "
                             "characters, found {}",
                             key, in_.name(), kNameBytesMax, found));
    return false;
}

bool Reader::is_first(const JsonValue& json, std::string_view key, const std::string& text) {
    if (seen_.emplace(key, text).second) return true;
    in_.complain(json.at, fmt::format("\"{}\" of {} has {} a second time; keep one of them", key,
                                      in_.name(), json_quote(text)));
    return false;
}

std::vector<std::string> Reader::names(std::string_view key, size_t max) {
    std::vector<std::string> list;
    const auto& items = in_.items(key, Need::Optional);
    if (!fits(key, items.size(), max)) return list;
    for (const JsonValue& item : items) {
        if (is_good_name(item, key) && is_first(item, key, item.text)) list.push_back(item.text);
    }
    return list;
}

std::optional<Hears> Reader::hear(const JsonValue& json) {
    if (json.kind != JsonKind::Object) {
        if (!is_good_name(json, "hear")) return std::nullopt;
        return Hears{json.text, ""};
    }
    Complaints complaints;
    JsonObject entry(json, "an entry of \"hear\"", complaints);
    const Hears one{entry.text("event", Need::Required), entry.text("from", Need::Optional)};
    const JsonValue* event = entry.find("event", Need::Optional);
    const JsonValue* from = entry.find("from", Need::Optional);
    entry.finish();
    for (const Complaint& complaint : complaints) in_.complain(complaint.at, complaint.what);
    if (!complaints.empty()) return std::nullopt;
    if (!is_good_name(*event, "event")) return std::nullopt;
    if (from != nullptr && !is_good_name(*from, "from")) return std::nullopt;
    return one;
}

std::vector<Hears> Reader::hear() {
    std::vector<Hears> list;
    const auto& items = in_.items("hear", Need::Optional);
    if (!fits("hear", items.size(), kEventsMax)) return list;
    for (const JsonValue& item : items) {
        const auto one = hear(item);
        if (one && is_first(item, "hear", one->event + "\n" + one->from)) list.push_back(*one);
    }
    return list;
}

// "drive.odometry.x": the variable odometry.x of the node drive.
std::vector<Tells> Reader::tell() {
    std::vector<Tells> list;
    const auto& items = in_.items("tell", Need::Optional);
    if (!fits("tell", items.size(), kTellMax)) return list;
    for (const JsonValue& item : items) {
        if (item.kind != JsonKind::String) {
            (void)is_good_name(item, "tell");
            continue;
        }
        const size_t dot = item.text.find('.');
        const Tells one{item.text.substr(0, dot),
                        dot == std::string::npos ? "" : item.text.substr(dot + 1)};
        if (!is_name(one.node) || !is_name(one.name)) {
            in_.complain(item.at, fmt::format("\"tell\" of {}: expected NODE.VARIABLE, found {}",
                                              in_.name(), json_quote(item.text)));
        } else if (is_first(item, "tell", item.text)) {
            list.push_back(one);
        }
    }
    return list;
}

// Its names are checked where plans and nodes are known (serve/edit/condition_check.hpp).
std::optional<Healthy> Reader::healthy() {
    const JsonValue* json = in_.find("healthy", JsonKind::Object, Need::Optional);
    if (json == nullptr) return std::nullopt;
    Complaints complaints;
    JsonObject healthy(*json, "\"healthy\"", complaints);
    const std::string condition = healthy.text("condition", Need::Required);
    const double seconds = healthy.number(
        "for", {.low = 0, .high = seconds_of(kHealthyForMax), .fallback = seconds_of(kHealthyFor)});
    const JsonValue* const text = healthy.find("condition", Need::Required);
    healthy.finish();
    if (complaints.empty() && condition.size() > kConditionBytesMax) {
        healthy.complain(text->at, fmt::format("\"condition\" of \"healthy\": expected at most {} "
                                               "bytes, found {}; write a shorter one",
                                               kConditionBytesMax, condition.size()));
    } else if (complaints.empty()) {
        const auto formula = plan::WordFormula::parse(condition);
        const std::string wrong =
            formula.ok() ? too_many_words(formula.value()) : formula.error().what;
        if (!wrong.empty()) healthy.complain(text->at, "\"condition\" of \"healthy\": " + wrong);
    }
    for (const Complaint& complaint : complaints) in_.complain(complaint.at, complaint.what);
    if (!complaints.empty()) return std::nullopt;
    return Healthy{condition, from_seconds(seconds)};
}

ProjectPart Reader::part() {
    ProjectPart part;
    part.name = in_.text("name", Need::Optional);
    const JsonValue* name = in_.find("name", Need::Optional);
    const bool is_text = name != nullptr && name->kind == JsonKind::String;
    if (is_text && !is_good_name(*name, "name")) part.name.clear();
    part.groups = names("groups", kGroupsMax);
    part.send = names("send", kEventsMax);
    part.hear = hear();
    part.tell = tell();
    const bool goes_on =
        in_.word("broker_lost", {"stop", "continue"}, Need::Optional, "stop") == "continue";
    part.broker_lost = goes_on ? BrokerLost::Continue : BrokerLost::Stop;
    part.healthy = healthy();
    in_.finish();
    return part;
}

}  // namespace

ProjectPart read_project_part(JsonObject& in, Complaints& complaints) {
    const JsonValue* json = in.find("fleet", JsonKind::Object, Need::Optional);
    if (json == nullptr) return {};
    JsonObject fleet(*json, "\"fleet\"", complaints);
    return Reader(fleet).part();
}

}  // namespace vagus::fleet
