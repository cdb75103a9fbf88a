#include "fleet/modelled_broker.hpp"

#include <algorithm>

#include "base/text.hpp"
#include "fleet/topic.hpp"

namespace vagus::fleet {

ModelledBroker::~ModelledBroker() = default;

// ---- the ends of a way ----

ModelledBroker::Way& ModelledBroker::add(std::string fleet, Post will) {
    return *ways_.emplace_back(std::make_unique<Way>(*this, std::move(fleet), std::move(will)));
}

void ModelledBroker::connect(Way& way) {
    if (way.connected_) return;
    way.connected_ = true;
    ++way.connection_;
    way.last_up_ = way.last_down_ = now_;
    send({.way = &way, .connection = way.connection_, .what = LinkEvent(Connected{})});
    way.away_since_.reset();
    for (Packet& packet : std::exchange(way.kept_, {})) {
        packet.connection = way.connection_;
        const bool expired =
            packet.expires_s > 0 && now_ - packet.since >= std::chrono::seconds(packet.expires_s);
        if (expired) {
            ++lost_;
        } else {
            send(std::move(packet));
        }
    }
}

void ModelledBroker::Way::subscribe(const std::vector<Filter>& filters) {
    if (!connected_) return;
    broker_.send({.way = this, .connection = connection_, .to_broker = true, .what = filters});
}

void ModelledBroker::Way::publish(const Post& post) {
    if (!connected_) return;
    broker_.send(
        {.way = this, .connection = connection_, .to_broker = true, .what = post, .qos = post.qos});
}

// ---- what ways do to messages ----

bool ModelledBroker::chance(double share) {
    return share > 0 && random_.unit() < share;
}

// Never before what was sent on that way before it.
Time ModelledBroker::arrival(Time& last, int times_lost) {
    const double more = model_.jitter.count() > 0 ? random_.unit() : 0;
    const auto jitter =
        Duration(static_cast<Duration::rep>(more * static_cast<double>(model_.jitter.count())));
    const Time at = now_ + model_.latency + jitter + times_lost * kSentAgainAfter;
    last = std::max(last, at);
    return last;
}

bool ModelledBroker::is_message(const Packet& packet) {
    const auto* const event = std::get_if<LinkEvent>(&packet.what);
    return std::holds_alternative<Post>(packet.what) ||
           (event != nullptr && std::holds_alternative<Received>(*event));
}

void ModelledBroker::send(Packet packet) {
    int times_lost = 0;
    while (times_lost < kLostInARowMax && chance(model_.loss)) ++times_lost;
    if (packet.qos == 0 && times_lost > 0) {
        ++lost_;
        return;
    }
    Way& way = *packet.way;
    Time& last = packet.to_broker ? way.last_up_ : way.last_down_;
    if (packet.qos > 0 && is_message(packet) && chance(model_.twice)) {
        under_way_.emplace(std::pair(arrival(last, times_lost), ++sent_), packet);
        times_lost = 0;
    }
    under_way_.emplace(std::pair(arrival(last, times_lost), ++sent_), std::move(packet));
}

void ModelledBroker::cut(Way& way) {
    if (!way.cut_since_) way.cut_since_ = now_;
}

// What waited goes on; a connection that both ends have ended begins again.
void ModelledBroker::restore(Way& way) {
    if (!way.cut_since_) return;
    way.cut_since_.reset();
    if (!way.connected_) return connect(way);
    for (Packet& packet : std::exchange(way.held_, {})) {
        Time& last = packet.to_broker ? way.last_up_ : way.last_down_;
        under_way_.emplace(std::pair(arrival(last, 0), ++sent_), std::move(packet));
    }
}

void ModelledBroker::notice_cuts(Time now) {
    for (const auto& way : ways_) {
        if (way->connected_ && way->cut_since_ && *way->cut_since_ + kMissedAfter <= now) {
            lose(*way);
        }
        if (way->away_since_ && *way->away_since_ + std::chrono::seconds(kSessionSeconds) <= now) {
            end_session(*way);
        }
    }
}

// Both ends end the connection. Of what was under way the sender knows what was not acknowledged:
// the client sends it again when it is back, and so does the broker.
void ModelledBroker::lose(Way& way) {
    way.connected_ = false;
    ++way.connection_;
    way.away_since_ = now_;
    for (Packet& packet : std::exchange(way.held_, {})) keep_for(way, std::move(packet));
    for (auto& [due, packet] : under_way_) {
        if (packet.way == &way && packet.connection != way.connection_ && !packet.to_broker) {
            keep_for(way, std::exchange(packet, {.way = &way}));
        }
    }
    way.inbox_.emplace_back(Lost{"the broker does not answer any more"});
    if (!way.will_.topic.empty()) publish(way.will_, nullptr);
}

void ModelledBroker::keep_for(Way& way, Packet packet) {
    if (packet.to_broker || packet.qos == 0 || !is_message(packet)) {
        ++lost_;
    } else {
        way.kept_.push_back(std::move(packet));
    }
}

void ModelledBroker::end_session(Way& way) {
    way.away_since_.reset();
    lost_ += way.kept_.size();
    way.kept_.clear();
    way.filters_.clear();
    matches_.clear();
}

void ModelledBroker::pass(Time now) {
    while (!under_way_.empty() && under_way_.begin()->first.first <= now) {
        now_ = std::max(now_, under_way_.begin()->first.first);
        Packet packet = std::move(under_way_.begin()->second);
        under_way_.erase(under_way_.begin());
        arrive(std::move(packet));
    }
    now_ = now;
    notice_cuts(now);
}

void ModelledBroker::arrive(Packet packet) {
    Way& way = *packet.way;
    if (packet.connection != way.connection_) {
        ++lost_;
    } else if (way.cut_since_) {
        way.held_.push_back(std::move(packet));
    } else if (packet.to_broker) {
        arrive_at_broker(packet);
    } else {
        way.inbox_.push_back(std::move(std::get<LinkEvent>(packet.what)));
    }
}

// ---- the broker ----

void ModelledBroker::arrive_at_broker(Packet& packet) {
    Way& way = *packet.way;
    if (const auto* filters = std::get_if<std::vector<Filter>>(&packet.what)) {
        return subscribe(way, *filters);
    }
    const Post& post = std::get<Post>(packet.what);
    publish(post, &way);
    if (post.number == 0) return;
    send({.way = &way,
          .connection = way.connection_,
          .what = LinkEvent(Acknowledged{.number = post.number})});
}

void ModelledBroker::subscribe(Way& way, const std::vector<Filter>& filters) {
    for (const Filter& filter : filters) {
        std::erase_if(way.filters_, [&](const Filter& one) { return one.topic == filter.topic; });
        way.filters_.push_back(filter);
        each_topic(matches_, filter, [&](auto& known) { add_match(known.second, way, filter); });
        each_topic(retained_, filter, [&](auto& kept) { deliver(way, kept.second, true); });
    }
}

// What is kept under the topics that the filter means.
template <typename ByTopic, typename Do>
void ModelledBroker::each_topic(ByTopic& all, const Filter& filter, const Do& act) {
    if (filter.topic.find('+') == std::string::npos) {
        const auto found = all.find(filter.topic);
        if (found != all.end()) act(*found);
        return;
    }
    for (auto& one : all) {
        if (matches_filter(filter.topic, one.first)) act(one);
    }
}

// A client with several matching filters gets a message once.
void ModelledBroker::add_match(std::vector<Match>& matches, Way& way, const Filter& filter) {
    const auto known = std::find_if(matches.begin(), matches.end(),
                                    [&way](const Match& one) { return one.way == &way; });
    if (known == matches.end()) {
        matches.push_back({&way, filter.own});
    } else {
        known->own = known->own || filter.own;
    }
}

const std::vector<ModelledBroker::Match>& ModelledBroker::matches(const std::string& topic) {
    const auto [known, is_new] = matches_.try_emplace(topic);
    if (!is_new) return known->second;
    for (const auto& way : ways_) {
        for (const Filter& filter : way->filters_) {
            if (matches_filter(filter.topic, topic)) add_match(known->second, *way, filter);
        }
    }
    return known->second;
}

void ModelledBroker::publish(const Post& post, const Way* by) {
    if (post.retained) retained_[post.topic] = post;
    for (const Match& match : matches(post.topic)) {
        if (match.own || match.way != by) deliver(*match.way, post, false);
    }
}

void ModelledBroker::deliver(Way& way, const Post& post, bool retained) {
    if (!way.connected_ && !way.away_since_) return;
    auto event = event_of(way.fleet_, post.topic, post.payload, retained);
    if (!event) return;
    Packet packet{.way = &way,
                  .connection = way.connection_,
                  .what = std::move(*event),
                  .qos = post.qos,
                  .since = now_,
                  .expires_s = post.expires_s};
    if (way.connected_) {
        send(std::move(packet));
    } else {
        keep_for(way, std::move(packet));
    }
}

}  // namespace vagus::fleet
