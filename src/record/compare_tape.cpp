#include "record/compare_tape.hpp"

#include <algorithm>

#include "record/damage.hpp"

namespace vagus::record {

namespace {

std::string text_of(const JsonValue* value) {
    return value != nullptr ? json_line(*value) : "";
}

bool same(const JsonValue& a, const JsonValue& b) {
    return json_line(a) == json_line(b);
}

// The first member that differs, in the order of what was recorded, then those that are new.
std::optional<Difference> in_object(const JsonValue& then, const JsonValue& now) {
    const auto found = [](const std::string& key, const JsonValue* a, const JsonValue* b) {
        if (a != nullptr && b != nullptr && a->kind == JsonKind::Object &&
            b->kind == JsonKind::Object) {
            Difference inner = in_object(*a, *b).value_or(Difference{});
            inner.place = key + (inner.place.empty() ? "" : "." + inner.place);
            return inner;
        }
        return Difference{.topic = {}, .place = key, .then = text_of(a), .now = text_of(b)};
    };
    for (const JsonMember& member : then.members) {
        const JsonValue* const other = now.find(member.key);
        if (other == nullptr || !same(member.value, *other)) {
            return found(member.key, &member.value, other);
        }
    }
    for (const JsonMember& member : now.members) {
        if (then.find(member.key) == nullptr) return found(member.key, nullptr, &member.value);
    }
    return std::nullopt;
}

}  // namespace

std::string json_line(const JsonValue& value) {
    if (value.kind == JsonKind::String) return json_quote(value.text);
    if (value.kind == JsonKind::Bool) return value.boolean ? "true" : "false";
    if (value.kind == JsonKind::Null) return "null";
    if (value.is_number()) return value.text;
    std::string text = value.kind == JsonKind::Array ? "[" : "{";
    for (const JsonValue& item : value.items) {
        text += (text.size() > 1 ? "," : "") + json_line(item);
    }
    for (const JsonMember& member : value.members) {
        text +=
            (text.size() > 1 ? "," : "") + json_quote(member.key) + ":" + json_line(member.value);
    }
    return text + (value.kind == JsonKind::Array ? "]" : "}");
}

Difference first_difference(const std::string& then, const std::string& now) {
    const auto a = read_json(then);
    const auto b = read_json(now);
    const auto* const before = std::get_if<JsonValue>(&a);
    const auto* const after = std::get_if<JsonValue>(&b);
    if (before != nullptr && after != nullptr && before->kind == JsonKind::Object) {
        if (const auto inside = in_object(*before, *after)) return *inside;
    }
    return {.topic = {}, .place = {}, .then = then, .now = now};
}

CompareTape::CompareTape(const mcap::Reader& reader, std::set<std::string> only, Time until)
    : reader_(reader), cursor_(reader), only_(std::move(only)), until_(until) {}

bool CompareTape::counts(const std::string& name) const {
    if (name == kRunTopic || name == kCutTopic || name.starts_with(kCameraTopics)) return false;
    return only_.empty() || only_.contains(name);
}

uint16_t CompareTape::declare(const Topic& topic) {
    topics_.push_back(topic);
    return static_cast<uint16_t>(topics_.size());
}

// The next message of a topic; those of others that come before it are kept.
std::optional<CompareTape::Recorded> CompareTape::take(uint16_t topic) {
    const std::string& name = topics_[topic - 1u].name;
    std::deque<Recorded>& kept = ahead_[name];
    while (kept.empty()) {
        const std::optional<mcap::Message> message = cursor_.next();
        if (!message) return std::nullopt;
        const mcap::Channel* const channel = reader_.channel(message->channel);
        if (channel == nullptr || !counts(channel->topic)) continue;
        ahead_[channel->topic].push_back({time_of(message->log_time), std::string(message->data)});
    }
    Recorded recorded = std::move(kept.front());
    kept.pop_front();
    return recorded;
}

void CompareTape::differs(Difference found) {
    if (!difference_ || found.at < difference_->at) difference_ = std::move(found);
}

void CompareTape::put(uint16_t topic, Time at, std::string_view data) {
    if (over_ || topic == 0 || !counts(topics_[topic - 1u].name)) return;
    if (at > until_ || (difference_ && at > difference_->at)) return;
    std::optional<Recorded> recorded = take(topic);
    // One that is not there was dropped, or the recording was cut off: that is no difference.
    const bool dropped = topics_[topic - 1u].may_be_dropped;
    if (!recorded && (dropped || !is_whole(reader_) || cursor_.trouble())) return;
    if (recorded && dropped && recorded->at > at) {
        ahead_[topics_[topic - 1u].name].push_front(std::move(*recorded));
        return;
    }
    ++compared_;
    if (recorded && recorded->at == at && recorded->data == data) return;
    Difference found = recorded && recorded->at == at
                           ? first_difference(recorded->data, std::string(data))
                           : Difference{};
    if (!recorded || recorded->at != at) {
        const bool later = !recorded || recorded->at > at;
        found.at = later ? at : recorded->at;
        if (later) {
            found.now = data;
        } else {
            found.then = recorded->data;
        }
    } else {
        found.at = at;
    }
    found.topic = topics_[topic - 1u].name;
    differs(std::move(found));
}

Status CompareTape::end() {
    over_ = true;
    while (const auto message = cursor_.next()) {
        const mcap::Channel* const channel = reader_.channel(message->channel);
        if (channel == nullptr || !counts(channel->topic)) continue;
        std::deque<Recorded>& kept = ahead_[channel->topic];
        if (!kept.empty()) continue;  // the first tells where it differs
        kept.push_back({time_of(message->log_time), std::string(message->data)});
    }
    // A rerun up to an instant stops at its end. An input that was recorded behind it is not
    // repeated, nor is what followed from that input at the same time.
    const auto inputs = ahead_.find(std::string(kInputTopic));
    const bool input_behind =
        inputs != ahead_.end() && !inputs->second.empty() && inputs->second.front().at == until_;
    for (const auto& [topic, kept] : ahead_) {
        if (kept.empty()) continue;
        const auto& [at, data] = kept.front();
        if (at > until_ || (input_behind && at == until_)) continue;
        differs({.at = at, .topic = topic, .place = {}, .then = data, .now = {}});
    }
    return check_read(cursor_, reader_);
}

}  // namespace vagus::record
