#include "serve/studio/topics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "serve/json.hpp"
#include "serve/studio/merge_patch.hpp"
#include "serve/thrown.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kBinaryHeadBytes = 16;

// The head of a binary frame: kind, three zeros, number of the subscription, time.
std::string binary_head(uint8_t kind, uint32_t number, double time) {
    std::string head(kBinaryHeadBytes, '\0');
    head[0] = static_cast<char>(kind);
    std::memcpy(head.data() + 4, &number, sizeof number);
    std::memcpy(head.data() + 8, &time, sizeof time);
    return head;
}

Duration period_of(const Json& in) {
    const double rate = in.value("rate", kWatchRate);
    return Duration(static_cast<int64_t>(1e6 / rate));
}

}  // namespace

void Topics::document(const std::string& topic, MakeDocument make) {
    documents_[topic] = {std::move(make), false};
}

void Topics::stream(const std::string& topic, size_t kept) {
    streams_[topic].kept = kept;
}

void Topics::binary(const std::string& topic, OpenBinary open, CheckSubject check) {
    binaries_[topic] = {std::move(open), std::move(check)};
}

void Topics::touch(const std::string& topic) {
    for (auto& [key, subject] : subjects_[topic]) subject.stale = true;
}

void Topics::add(const std::string& topic, Json item) {
    Stream& stream = streams_[topic];
    item["number"] = stream.first + stream.items.size();
    stream.items.push_back(std::move(item));
    if (stream.items.size() <= stream.kept) return;
    stream.items.pop_front();
    ++stream.first;
}

void Topics::forget(const std::string& topic) {
    Stream& stream = streams_[topic];
    stream.first += stream.items.size();
    stream.items.clear();
    for (auto& [place, watch] : watches_) {
        if (watch.topic == topic) watch.next = std::max(watch.next, stream.first);
    }
}

bool Topics::is_served(const std::string& topic) const {
    return documents_.contains(topic) || streams_.contains(topic) || binaries_.contains(topic);
}

std::optional<Problem> Topics::watch(ClientId client, const Json& in, Time now) {
    const std::string topic = in["topic"];
    const TopicType* type = Protocol::get().topic(topic);
    if (!type) return Problem{"not_found", "there is no topic “" + topic + "”", "in.topic"};
    const Json of = in.value("of", Json::object());
    if (const auto fault = Protocol::get().fault_of_subject(*type, of)) {
        return Problem{"bad_message", *fault, "in.of"};
    }
    if (!is_served(topic)) return Problem{"unavailable", topic + " is not served here", "in.topic"};
    const uint32_t number = in["watch"];
    const auto mine = [&](const auto& entry) { return entry.first.first == client; };
    const auto limit = static_cast<std::ptrdiff_t>(Protocol::get().limit("watches"));
    if (std::count_if(watches_.begin(), watches_.end(), mine) >= limit) {
        return Problem{"limit", fmt::format("a page has at most {} subscriptions", limit), ""};
    }
    Watch watch;
    watch.topic = topic;
    watch.kind = type->kind;
    watch.of = of;
    watch.key = json_text(of);
    watch.every = period_of(in);
    watch.due = now;
    if (type->kind == TopicType::Kind::Document) {
        subjects_[topic].try_emplace(watch.key);
    } else if (type->kind == TopicType::Kind::Stream) {
        const Stream& stream = streams_[topic];
        const uint64_t last = of.value("last", uint64_t{0});
        const uint64_t end = stream.first + stream.items.size();
        watch.next = std::max(stream.first, end - std::min<uint64_t>(end, last));
        watch.kinds = of.value("kinds", std::vector<std::string>{});
    } else {
        const Binary& binary = binaries_.at(topic);
        if (auto problem = binary.check(of)) return problem;
        watch.source = binary.open(of);
    }
    ++subscriptions_;
    watches_[{client, number}] = std::move(watch);
    return std::nullopt;
}

void Topics::unwatch(ClientId client, uint32_t number) {
    ++subscriptions_;
    watches_.erase({client, number});
}

void Topics::drop(ClientId client) {
    ++subscriptions_;
    std::erase_if(watches_, [&](const auto& entry) { return entry.first.first == client; });
}

std::vector<Json> Topics::subjects(const std::string& topic) const {
    std::map<std::string, Json> found;
    for (const auto& [place, watch] : watches_) {
        if (watch.topic == topic) found.emplace(watch.key, watch.of);
    }
    std::vector<Json> list;
    for (auto& [key, of] : found) list.push_back(std::move(of));
    return list;
}

std::vector<std::string> Topics::flush(Time now, const std::function<bool(ClientId)>& has_room,
                                       const Send& send) {
    std::vector<std::string> faults;
    for (auto& [place, watch] : watches_) {
        if (watch.due > now) continue;
        // Asked again at its own pace, not at once: a page that does not read costs nothing.
        if (!has_room(place.first)) {
            watch.due = now + watch.every;
            continue;
        }
        bool sent = false;
        const auto thrown = thrown_by([&] { sent = flush_one(place, watch, send); });
        if (thrown) {
            watch.due = now + kThrownAgain;
            faults.push_back(watch.topic + ": " + *thrown);
            continue;
        }
        // A change after a quiet time goes out at once.
        if (sent || watch.kind == TopicType::Kind::Binary) watch.due = now + watch.every;
    }
    for (auto& [topic, subjects] : subjects_) {
        std::erase_if(subjects, [&](const auto& entry) {
            return std::none_of(watches_.begin(), watches_.end(), [&](const auto& watch) {
                return watch.second.topic == topic && watch.second.key == entry.first;
            });
        });
    }
    return faults;
}

bool Topics::flush_one(const Place& place, Watch& watch, const Send& send) {
    switch (watch.kind) {
        case TopicType::Kind::Document:
            return flush_document(place, watch, send);
        case TopicType::Kind::Stream:
            return flush_stream(place, watch, send);
        case TopicType::Kind::Binary:
            return flush_binary(place, watch, send);
    }
    return false;
}

bool Topics::flush_document(const Place& place, Watch& watch, const Send& send) {
    Subject& subject = subjects_[watch.topic][watch.key];
    if (subject.stale || !subject.made) {
        Json made = documents_.at(watch.topic).make(watch.of);
        subject.stale = false;
        if (!subject.made || *subject.made != made) {
            subject.made = std::make_shared<const Json>(std::move(made));
        }
    }
    if (watch.sent == subject.made) return false;
    Json message = {{"watch", place.second}};
    if (watch.sent) {
        message["patch"] = merge_patch(*watch.sent, *subject.made);
    } else {
        message["whole"] = *subject.made;
    }
    watch.sent = subject.made;
    send(place.first, false, json_text(message));
    return true;
}

bool Topics::flush_stream(const Place& place, Watch& watch, const Send& send) {
    const Stream& stream = streams_[watch.topic];
    if (watch.next < stream.first) {
        watch.left_out += stream.first - watch.next;
        watch.next = stream.first;
    }
    Json items = Json::array();
    const uint64_t end = stream.first + stream.items.size();
    while (watch.next < end && items.size() < kStreamItemsAtOnce) {
        const Json& item = stream.items[watch.next++ - stream.first];
        const bool wanted =
            watch.kinds.empty() || std::find(watch.kinds.begin(), watch.kinds.end(),
                                             item.value("kind", "")) != watch.kinds.end();
        if (wanted) items.push_back(item);
    }
    if (items.empty() && watch.left_out == 0) return false;
    const Json message = {
        {"watch", place.second}, {"items", std::move(items)}, {"left_out", watch.left_out}};
    watch.left_out = 0;
    send(place.first, false, json_text(message));
    return true;
}

bool Topics::flush_binary(const Place& place, Watch& watch, const Send& send) {
    auto next = watch.source ? watch.source->next() : std::nullopt;
    if (!next) return false;
    const uint8_t kind = Protocol::get().topic(watch.topic)->number;
    send(place.first, true, binary_head(kind, place.second, next->first) + next->second);
    return true;
}

bool Topics::pending(const Watch& watch) const {
    switch (watch.kind) {
        case TopicType::Kind::Document: {
            const auto topic = subjects_.find(watch.topic);
            if (topic == subjects_.end()) return true;
            const auto subject = topic->second.find(watch.key);
            return subject == topic->second.end() || subject->second.stale ||
                   subject->second.made != watch.sent;
        }
        case TopicType::Kind::Stream: {
            const Stream& stream = streams_.at(watch.topic);
            return watch.next < stream.first + stream.items.size();
        }
        case TopicType::Kind::Binary:
            return true;
    }
    return true;
}

Time Topics::next_due(Time now) const {
    Time next = Time::max();
    for (const auto& [place, watch] : watches_) {
        if (pending(watch)) next = std::min(next, std::max(now, watch.due));
    }
    return next;
}

}  // namespace vagus::serve
