// A broker and the ways to it in virtual time: what a member says arrives later, may be lost and
// sent again, may come twice, and ways are cut and restored. Nothing is decided but by the time
// that it is told and the seed: the same calls give the same bytes.
//
//     ModelledBroker broker({.latency = 5ms}, 1);
//     ModelledBroker::Way& way = broker.add("lab", member.will());   // a Link
//     broker.connect(way);
//     broker.pass(now);                                              // all that is due by now
//     for (const LinkEvent& event : way.take()) member.hear(event, now);
//
// As MQTT over TCP does it: each way keeps its order. A message of QoS 1 that is lost is sent
// again, and those behind it wait; one of QoS 0 is gone. A cut is noticed after kMissedAfter, by
// both ends; one that is over before delays what is on its way, and no more. For kSessionSeconds
// more the broker keeps what comes for a client of QoS 1; who is back by then gets it.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/rng.hpp"
#include "base/time.hpp"
#include "fleet/limits.hpp"
#include "fleet/link.hpp"

namespace vagus::fleet {

// What a broker and a client do that hear nothing of each other for one and a half of the time that
// was agreed.
constexpr Duration kMissedAfter = std::chrono::milliseconds(kKeepAliveSeconds * 1500);
constexpr Duration kSentAgainAfter = 200ms;  // what was lost
constexpr int kLostInARowMax = 20;           // then it arrives, whatever chance says

struct WayModel {
    Duration latency = 5ms;
    Duration jitter{};  // at most so much more
    double loss = 0;    // how likely a message is lost on a way
    double twice = 0;   // how likely a message of QoS 1 arrives twice
};

class ModelledBroker {
public:
    class Way;

    ModelledBroker(WayModel model, uint64_t seed) : model_(model), random_(seed) {}
    ~ModelledBroker();
    ModelledBroker(const ModelledBroker&) = delete;
    ModelledBroker& operator=(const ModelledBroker&) = delete;

    // The way of a client of that fleet, not connected; stays where it is as long as the broker.
    Way& add(std::string fleet, Post will);
    void connect(Way& way);
    // Nothing passes on it until it is restored.
    void cut(Way& way);
    void restore(Way& way);
    // What is due by `now` happens, in the order of time. Never earlier than before.
    void pass(Time now);

    // From now on chance is drawn from that seed.
    void reseed(uint64_t seed) { random_ = SplitMix64(seed); }

    // Messages that were lost for good.
    uint64_t lost() const { return lost_; }

private:
    struct Packet {
        Way* way = nullptr;
        uint64_t connection = 0;  // of the way when it was sent; an earlier one brings nothing
        bool to_broker = false;
        std::variant<std::vector<Filter>, Post, LinkEvent> what = {};
        int qos = 1;
        Time since{};            // to a client: when the broker got it
        uint32_t expires_s = 0;  // as Post says
    };
    // Filters that match a topic, and whose they are.
    struct Match {
        Way* way = nullptr;
        bool own = true;
    };

    void send(Packet packet);
    Time arrival(Time& last, int times_lost);
    void arrive(Packet packet);
    void arrive_at_broker(Packet& packet);
    void notice_cuts(Time now);
    void lose(Way& way);
    void keep_for(Way& way, Packet packet);
    void end_session(Way& way);
    static bool is_message(const Packet& packet);
    void subscribe(Way& way, const std::vector<Filter>& filters);
    void publish(const Post& post, const Way* by);
    void deliver(Way& way, const Post& post, bool retained);
    const std::vector<Match>& matches(const std::string& topic);
    static void add_match(std::vector<Match>& matches, Way& way, const Filter& filter);
    template <typename ByTopic, typename Do>
    static void each_topic(ByTopic& all, const Filter& filter, const Do& act);
    bool chance(double share);

    const WayModel model_;
    SplitMix64 random_;
    Time now_{};
    uint64_t sent_ = 0;  // orders what is due at one time
    uint64_t lost_ = 0;
    std::vector<std::unique_ptr<Way>> ways_;
    std::map<std::pair<Time, uint64_t>, Packet> under_way_;
    std::map<std::string, Post> retained_;
    // Of topics that were seen. A map: they are walked in an order that is the same everywhere.
    std::map<std::string, std::vector<Match>> matches_;
};

class ModelledBroker::Way final : public Link {
public:
    Way(ModelledBroker& broker, std::string fleet, Post will)
        : broker_(broker), fleet_(std::move(fleet)), will_(std::move(will)) {}

    void subscribe(const std::vector<Filter>& filters) override;
    void publish(const Post& post) override;
    std::vector<LinkEvent> take() override { return std::exchange(inbox_, {}); }
    bool has_news() const { return !inbox_.empty(); }
    bool is_connected() const { return connected_; }

private:
    friend class ModelledBroker;

    ModelledBroker& broker_;
    const std::string fleet_;
    const Post will_;
    bool connected_ = false;
    uint64_t connection_ = 0;  // counted
    std::optional<Time> cut_since_;
    std::vector<Packet> held_;        // due while it was cut
    std::optional<Time> away_since_;  // its connection is lost, the broker still knows it
    std::vector<Packet> kept_;        // messages that wait for it
    Time last_up_{}, last_down_{};    // when what was sent last arrives
    std::vector<Filter> filters_;     // as the broker knows them
    std::vector<LinkEvent> inbox_;
};

}  // namespace vagus::fleet
