// Clients that connect and stay: hello, tokens, two pages of one name, pings.
#include <fmt/format.h>

#include <algorithm>

#include "serve/json.hpp"
#include "serve/studio/answer_text.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kNameDigits = 16;  // of a name that we give to a page

const char* name_of(Role role) {
    return role == Role::Drive ? "drive" : "look";
}

}  // namespace

// Connections that have shown no token take places from each other only: the oldest goes.
void Desk::make_room() {
    const auto is_stranger = [](const auto& entry) {
        return !entry.second.known && !entry.second.dropped;
    };
    const auto strangers =
        static_cast<size_t>(std::count_if(connections_.begin(), connections_.end(), is_stranger));
    if (strangers <= Protocol::get().limit("strangers")) return;
    // Numbers count up.
    const auto oldest = std::find_if(connections_.begin(), connections_.end(), is_stranger);
    drop(oldest->first, "too many connections without a hello; open the page again");
}

void Desk::greet(ClientId client, const Request& request, Time now) {
    Connection& connection = connections_.at(client);
    const std::string address = connection.address;
    if (connection.known) {
        return send(client, false,
                    answer_text(request.id, Problem{"conflict",
                                                    "this connection has said hello; open another "
                                                    "for another client",
                                                    "do"}));
    }
    const Access::Grade grade = access_.grade(request.in["token"].get<std::string>());
    if (grade == Access::Grade::Refused) {
        log(address + ": a wrong token");
        // No longer than a connection may go without a hello at all.
        connection.refuse_at =
            std::min(access_.wrong(address, now), connection.opened + limit_ms("hello_ms"));
        connection.refused_id = request.id;
        if (*connection.refuse_at <= now) refuse(client, connection);
        return;
    }
    access_.right(address);
    connection.nonce = request.in.value("nonce", "");
    const Role role = grade == Access::Grade::Drive ? Role::Drive : Role::Look;
    if (!wait_for_twin(client, request, role, now)) welcome(client, request, role, now);
}

// ---- two pages of one name ----

// A tab that was duplicated has the name of the first one. A page that was loaded again has it,
// too: whether the other is still there is asked.
bool Desk::wait_for_twin(ClientId client, const Request& request, Role role, Time now) {
    Connection& connection = connections_.at(client);
    const Clients::Member* there = clients_.connected_with(request.in["client"], role);
    if (!there || connection.nonce.empty()) return false;
    const auto other = connections_.find(*there->connection);
    if (other == connections_.end() || other->second.dropped || other->second.nonce.empty() ||
        other->second.nonce == connection.nonce) {
        return false;
    }
    send_ping(other->first, now);
    connection.twin = Twin{request, role, other->first, pings_, now + kTwinWithin};
    return true;
}

// The other one has answered a ping, or is gone.
void Desk::settle_twins(ClientId other, std::optional<uint64_t> ponged, Time now) {
    std::vector<ClientId> settled;
    for (const auto& [client, connection] : connections_) {
        if (connection.dropped || !connection.twin || connection.twin->other != other) continue;
        if (!ponged || *ponged >= connection.twin->ping) settled.push_back(client);
    }
    for (const ClientId client : settled) settle_twin(client, ponged.has_value(), now);
}

void Desk::settle_twin(ClientId client, bool are_two, Time now) {
    Twin twin = std::move(*std::exchange(connections_.at(client).twin, std::nullopt));
    if (are_two) twin.request.in["client"] = outside_.random().substr(0, kNameDigits);
    welcome(client, twin.request, twin.role, now);
}

// ---- welcome, or not ----

void Desk::refuse(ClientId client, Connection& connection) {
    refuse_hello(client, connection.refused_id,
                 {"not_allowed", "the token is wrong; open the address that the server has printed",
                  "in.token"});
}

void Desk::refuse_hello(ClientId client, uint64_t id, Problem problem) {
    const std::string why = problem.code == "not_allowed" ? "wrong token" : problem.what;
    send(client, false, answer_text(id, std::move(problem)));
    drop(client, why);
}

void Desk::welcome(ClientId client, const Request& request, Role role, Time now) {
    const std::string key = request.in["client"];
    const size_t places = Protocol::get().limit("clients");
    if (clients_.connected() >= places && !clients_.connected_with(key, role)) {
        return refuse_hello(
            client, request.id,
            {"limit", fmt::format("more than {} pages; close another first", places), ""});
    }
    Connection& connection = connections_.at(client);
    connection.known = true;
    outside_.know(client);
    std::optional<ClientId> replaced;
    const Clients::Member& member =
        clients_.enter(client, key, request.in.value("name", "a page"), role, now, replaced);
    if (request.in.value("had_control", false)) clients_.take_back(member, now);
    if (replaced && *replaced != client) drop(*replaced, "the same page has connected again");
    const Json out = {{"version", VAGUS_VERSION},
                      {"epoch", epoch_},
                      {"client", key},
                      {"role", name_of(role)},
                      {"number", member.number},
                      {"driver", clients_.drives(member)},
                      {"now", server_ms(now)},
                      {"wall", outside_.wall_ms()},
                      {"stops", member.stops}};
    send(client, false, answer_text(request.id, out));
    people_changed_();
}

// ---- signs of life ----

void Desk::OnTheWay::mark(uint64_t ping) {
    marked_ = sent_;
    if (marks_.size() < kMarksMax) marks_.push_back({ping, sent_});
}

void Desk::OnTheWay::answered(uint64_t ping) {
    for (; !marks_.empty() && marks_.front().ping <= ping; marks_.pop_front()) {
        came_ = marks_.front().sent;
        answers_ = true;
    }
}

void Desk::on_pong(ClientId client, const Pong& pong, Time now) {
    connections_.at(client).on_the_way.answered(pong.number);
    settle_twins(client, pong.number, now);
}

// Whatever a client says shows that it is there.
void Desk::hear_life(Connection& connection) {
    const bool was_silent = is_silent(connection);
    connection.pings_missed = 0;
    if (was_silent) people_changed_();
}

bool Desk::is_silent(const Connection& connection) {
    return connection.pings_missed > kPingsMissedMax;  // the last one may still be answered
}

bool Desk::is_there(uint32_t member) const {
    const Clients::Member* const client = clients_.find(member);
    if (!client || !client->connection) return false;
    const auto found = connections_.find(*client->connection);
    return found != connections_.end() && !found->second.dropped && !is_silent(found->second);
}

size_t Desk::present() const {
    return static_cast<size_t>(
        std::count_if(connections_.begin(), connections_.end(), [](const auto& entry) {
            return entry.second.known && !entry.second.dropped && !is_silent(entry.second);
        }));
}

void Desk::ping(Time now) {
    if (now < next_ping_) return;
    const bool on_time = now <= next_ping_ + kPingLateMax;
    next_ping_ = now + limit_ms("ping_ms");
    bool changed = false;
    for (auto& [client, connection] : connections_) {
        if (!connection.known || connection.dropped) continue;
        const bool slow = std::exchange(connection.took, false) && connection.unsent > kSlowBytes;
        const bool was_silent = is_silent(connection);
        if (on_time && !slow) ++connection.pings_missed;
        changed = changed || is_silent(connection) != was_silent;
        send_ping(client, now);
    }
    if (changed) people_changed_();
}

void Desk::send_ping(ClientId client, Time now) {
    const uint64_t number = ++pings_;
    connections_.at(client).on_the_way.mark(number);
    const Clients::Member* const member = clients_.find(client);
    const uint64_t stops = member ? member->stops : 0;
    send(client, false, json_text({{"ping", number}, {"now", server_ms(now)}, {"stops", stops}}));
}

// At once: what a page is asked for from now on knows of the Stop.
void Desk::tell_stops(Time now) {
    if (!std::exchange(tells_stops_, false)) return;
    for (const auto& [client, connection] : connections_) {
        if (connection.known && !connection.dropped) send_ping(client, now);
    }
}

// Slow is not gone: only who takes nothing at all is, and only while we gave everything in time.
void Desk::look_after(ClientId client, Connection& connection, Duration passed, Time now) {
    if (connection.refuse_at && now >= *connection.refuse_at) return refuse(client, connection);
    if (connection.twin && now >= connection.twin->until) return settle_twin(client, false, now);
    connection.silent = connection.unsent == 0 ? Duration{} : connection.silent + passed;
    if (connection.silent > limit_ms("silent_ms")) {
        drop(client, "this page read too slowly and was disconnected; reload it");
    } else if (!connection.known && !connection.twin &&
               now > connection.opened + limit_ms("hello_ms")) {
        drop(client, "expected the command hello");
    }
}

// ---- a new token ----

void Desk::renew_access(const Clients::Member& member, ClientId client, uint64_t id) {
    if (!outside_.renew) {
        return answer(member.number, id, Problem{"unavailable", "this server has no token", ""});
    }
    const Result<std::string> token = outside_.renew();
    if (!token.ok()) return answer(member.number, id, Problem{"failed", token.error().what, ""});
    for (const auto& [other, connection] : connections_) {
        const Clients::Member* used = clients_.find(other);
        // One that waits whether it is a duplicated tab has shown the old one, too.
        const bool old = (used && used->role == Role::Drive) ||
                         (connection.twin && connection.twin->role == Role::Drive);
        if (other == client || connection.dropped || !old) continue;
        drop(other, "there is a new token; open the address with it");
    }
    log(member.name + " has made a new token; the old one is void");
    answer(member.number, id, Json{{"token", token.value()}});
}

}  // namespace vagus::serve
