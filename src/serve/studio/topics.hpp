// What pages watch: documents that change, streams that grow, binary frames that flow. A part with
// something to show declares it once and says when it may have changed. Only what somebody watches
// is computed. A page is sent what differs from what it has, no faster than it asked for, and
// nothing while it has no room: what it missed is merged or counted, not queued.
//
//     topics.document("clock", [&](const Json&) { return clock_document(); });
//     topics.touch("clock");
//     topics.flush(now, has_room, send);
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/protocol/protocol.hpp"
#include "serve/web/server.hpp"

namespace vagus::serve {

constexpr double kWatchRate = 20;  // a second, unless the page asks for another
constexpr Duration kThrownAgain = std::chrono::seconds(1);
constexpr size_t kStreamItemsAtOnce = 1000;  // in one message of a stream

// One subscription to binary frames; it remembers what it has sent.
class BinaryWatch {
public:
    virtual ~BinaryWatch() = default;
    // The payload of the next frame with its time in seconds; nothing if there is nothing new.
    virtual std::optional<std::pair<double, std::string>> next() = 0;
};

class Topics {
public:
    using MakeDocument = std::function<Json(const Json& of)>;
    using OpenBinary = std::function<std::unique_ptr<BinaryWatch>(const Json& of)>;
    // Why there is no such subscription, if there is none.
    using CheckSubject = std::function<std::optional<Problem>(const Json& of)>;
    using Send = std::function<void(ClientId, bool binary, std::string bytes)>;

    // ---- what there is; the names are those of the protocol ----
    void document(const std::string& topic, MakeDocument make);
    void stream(const std::string& topic, size_t kept);
    void binary(
        const std::string& topic, OpenBinary open,
        CheckSubject check = [](const Json&) { return std::optional<Problem>(); });

    // The documents of a topic may differ from now on.
    void touch(const std::string& topic);
    // Appends to a stream; the item gets its number.
    void add(const std::string& topic, Json item);
    // Drops what is kept of a stream; the next item gets the next number all the same.
    void forget(const std::string& topic);

    // ---- who watches ----
    std::optional<Problem> watch(ClientId client, const Json& in, Time now);
    void unwatch(ClientId client, uint32_t number);
    void drop(ClientId client);
    // Subjects of a topic that somebody watches now.
    std::vector<Json> subjects(const std::string& topic) const;
    bool watched(const std::string& topic) const { return !subjects(topic).empty(); }
    // Another number whenever subjects() may be others.
    uint64_t subscriptions() const { return subscriptions_; }

    // Sends what is due and differs to every page for which has_room says yes. What cannot be made
    // waits for kThrownAgain, and keeps nothing else back: gives "TOPIC: WHY" of each.
    std::vector<std::string> flush(Time now, const std::function<bool(ClientId)>& has_room,
                                   const Send& send);
    // When flush() may have something again, at the latest; now, if something is touched.
    Time next_due(Time now) const;

private:
    struct Document {
        MakeDocument make;
        bool touched = false;
    };
    // The document of one subject as it was made last. Owners: this, and each page that has it.
    using Made = std::shared_ptr<const Json>;
    struct Subject {
        Made made;
        bool stale = true;
    };
    struct Stream {
        std::deque<Json> items;
        uint64_t first = 0;  // number of the oldest one kept
        size_t kept = 0;
    };
    struct Watch {
        std::string topic;
        TopicType::Kind kind = TopicType::Kind::Document;
        Json of;
        std::string key;  // of the subject
        Duration every{};
        Time due{};
        Made sent;          // Document
        uint64_t next = 0;  // Stream
        uint64_t left_out = 0;
        std::vector<std::string> kinds;  // Stream: only these, if there are any
        std::unique_ptr<BinaryWatch> source;
    };
    using Place = std::pair<ClientId, uint32_t>;

    bool flush_one(const Place& place, Watch& watch, const Send& send);
    bool flush_document(const Place& place, Watch& watch, const Send& send);
    bool flush_stream(const Place& place, Watch& watch, const Send& send);
    bool flush_binary(const Place& place, Watch& watch, const Send& send);
    bool pending(const Watch& watch) const;
    bool is_served(const std::string& topic) const;

    std::map<std::string, Document> documents_;
    std::map<std::string, std::map<std::string, Subject>> subjects_;  // by topic, by subject
    std::map<std::string, Stream> streams_;
    struct Binary {
        OpenBinary open;
        CheckSubject check;
    };
    std::map<std::string, Binary> binaries_;
    std::map<Place, Watch> watches_;
    uint64_t subscriptions_ = 0;
};

}  // namespace vagus::serve
