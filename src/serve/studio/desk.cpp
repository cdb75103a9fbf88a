#include "serve/studio/desk.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vagus::serve {

using Json = nlohmann::json;

namespace {

constexpr double kBurstSeconds = 2;  // commands_a_second are averaged over so long

const char* code_of(Code code) {
    switch (code) {
        case Code::BadInput:
            return "bad_input";
        case Code::NotFound:
            return "not_found";
        case Code::Unavailable:
            return "unavailable";
        case Code::Limit:
            return "limit";
        case Code::Timeout:
            return "timeout";
        case Code::Refused:
            return "failed";
    }
    return "failed";
}

std::string text_of(const Json& message) {
    return message.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json json_of(const Problem& problem) {
    Json json = {{"code", problem.code}, {"what", problem.what}};
    if (!problem.place.empty()) json["place"] = problem.place;
    return json;
}

std::string answer_text(uint64_t id, const Call::Outcome& outcome) {
    Json message = {{"id", id}};
    if (const auto* out = std::get_if<Json>(&outcome)) {
        message["ok"] = *out;
    } else {
        message["error"] = json_of(std::get<Problem>(outcome));
    }
    return text_of(message);
}

double allowance_max() {
    return static_cast<double>(Protocol::get().limit("commands_a_second")) * kBurstSeconds;
}

Duration limit_ms(const char* name) {
    return std::chrono::milliseconds(Protocol::get().limit(name));
}

}  // namespace

void Call::fail(const Error& error) const {
    fail(code_of(error.code), error.what);
}

Desk::Desk(Access access, Outside outside)
    : access_(std::move(access)), outside_(std::move(outside)) {}

void Desk::command(const std::string& name, std::function<void(const Call&)> obey) {
    commands_[name] = std::move(obey);
}

Desk::Json Desk::people() const {
    const Clients::Member* driver = clients_.driver();
    Json people = {{"version", VAGUS_VERSION},
                   {"driver", driver ? driver->number : 0},
                   {"driver_name", driver ? driver->name : ""},
                   {"clients", clients_.connected()}};
    if (const auto& asked = clients_.asked()) {
        const Clients::Member* member = clients_.find(asked->member);
        const double left = std::chrono::duration<double, std::milli>(asked->until - now_).count();
        people["asked"] = {{"client", asked->member},
                           {"name", member ? member->name : ""},
                           {"until_wall", wall_ms() + left}};
    }
    return people;
}

void Desk::hear(const WebEvent& event, Time now) {
    now_ = now;
    if (const auto* opened = std::get_if<ClientOpened>(&event)) return on_opened(*opened, now);
    if (const auto* text = std::get_if<ClientText>(&event)) {
        return on_text(text->client, text->text, now);
    }
    if (const auto* took = std::get_if<ClientTook>(&event)) return on_took(*took, now);
    if (const auto* closed = std::get_if<ClientClosed>(&event)) {
        return on_closed(closed->client, now);
    }
    outside_.log(std::get<WebNote>(event).text);
}

void Desk::on_opened(const ClientOpened& opened, Time now) {
    Connection& connection = connections_[opened.client];
    connection.address = opened.address;
    connection.opened = connection.took = connection.allowance_at = now;
    connection.allowance = allowance_max();  // a page that has just come brings its subscriptions
    if (connections_.size() > Protocol::get().limit("clients")) {
        drop(opened.client, fmt::format("more than {} pages; close another first",
                                        Protocol::get().limit("clients")));
    }
}

void Desk::on_took(const ClientTook& took, Time now) {
    const auto found = connections_.find(took.client);
    if (found == connections_.end()) return;
    found->second.unsent -= std::min(found->second.unsent, took.bytes);
    found->second.took = now;
}

void Desk::on_closed(ClientId client, Time now) {
    connections_.erase(client);
    board_.drop(client);
    clients_.leave(client, now);
    people_changed_();
}

void Desk::on_text(ClientId client, const std::string& text, Time now) {
    const auto found = connections_.find(client);
    if (found == connections_.end() || found->second.dropped) return;
    if (found->second.refuse_at) return;
    const auto read = Protocol::get().read(text);
    if (const auto* refusal = std::get_if<Refusal>(&read)) {
        outside_.log(
            fmt::format("{}: refused a message: {}", found->second.address, refusal->problem.what));
        send(client, false, answer_text(refusal->id, refusal->problem));
        if (!found->second.known) drop(client, "expected the command hello");
        return;
    }
    const Request& request = std::get<Request>(read);
    Clients::Member* member = clients_.find(client);
    if (request.name == "hello") return greet(client, request, now);
    if (!member) {
        send(client, false,
             answer_text(request.id,
                         Problem{"not_allowed", "say hello first, with the token", "do"}));
        return drop(client, "expected the command hello");
    }
    if (!within_rate(found->second, now)) {
        send(client, false,
             answer_text(request.id,
                         Problem{"limit",
                                 fmt::format("more than {} commands a second; send them slower",
                                             Protocol::get().limit("commands_a_second")),
                                 ""}));
        return;
    }
    obey(*member, client, request, now);
}

bool Desk::within_rate(Connection& connection, Time now) const {
    const double passed = std::chrono::duration<double>(now - connection.allowance_at).count();
    connection.allowance_at = now;
    connection.allowance =
        std::min(connection.allowance + passed * allowance_max() / kBurstSeconds, allowance_max());
    if (connection.allowance < 1) return false;
    connection.allowance -= 1;
    return true;
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
        outside_.log(address + ": a wrong token");
        // No longer than a connection may go without a hello at all.
        connection.refuse_at =
            std::min(access_.wrong(address, now), connection.opened + limit_ms("hello_ms"));
        connection.refused_id = request.id;
        if (*connection.refuse_at <= now) refuse(client, connection);
        return;
    }
    access_.right(address);
    welcome(client, request, grade == Access::Grade::Drive ? Role::Drive : Role::Look, now);
}

void Desk::refuse(ClientId client, Connection& connection) {
    const Problem problem{"not_allowed",
                          "the token is wrong; open the address that the server has printed",
                          "in.token"};
    send(client, false, answer_text(connection.refused_id, problem));
    drop(client, "wrong token");
}

void Desk::welcome(ClientId client, const Request& request, Role role, Time now) {
    Connection& connection = connections_.at(client);
    connection.known = true;
    std::optional<ClientId> replaced;
    const Clients::Member& member = clients_.enter(
        client, request.in["client"], request.in.value("name", "a page"), role, now, replaced);
    if (replaced && *replaced != client) drop(*replaced, "the same page has connected anew");
    const Json out = {{"version", VAGUS_VERSION},
                      {"role", role == Role::Drive ? "drive" : "look"},
                      {"number", member.number},
                      {"driver", clients_.drives(member)},
                      {"wall", outside_.wall_ms()}};
    send(client, false, answer_text(request.id, out));
    people_changed_();
}

std::optional<Problem> Desk::refusal(const Clients::Member& member, const Request& request) const {
    switch (request.type->may) {
        case May::Any:
        case May::Look:
            return std::nullopt;
        case May::Drive:
            if (member.role == Role::Drive) return std::nullopt;
            return Problem{"not_allowed", "this token may only look", ""};
        case May::Driver:
            if (clients_.drives(member)) return std::nullopt;
            if (member.role == Role::Look) {
                return Problem{"not_allowed", "this token may only look", ""};
            }
            return Problem{"not_driver",
                           fmt::format("{} drives; ask for the wheel first",
                                       clients_.driver() ? clients_.driver()->name : "nobody"),
                           ""};
    }
    return std::nullopt;
}

void Desk::obey(Clients::Member& member, ClientId client, const Request& request, Time now) {
    // What only concerns this connection begins anew with each.
    if (request.name == "watch" || request.name == "unwatch") {
        return obey_here(member, client, request, now);
    }
    switch (clients_.begin(member, request.id)) {
        case Clients::Seen::New:
            break;
        case Clients::Seen::UnderWay:
            return;
        case Clients::Seen::Done:
            return send(client, false, member.answers.at(request.id));
        case Clients::Seen::TooOld:
            return send(
                client, false,
                answer_text(request.id,
                            Problem{"conflict", "this command was answered long ago", "id"}));
    }
    if (const auto problem = refusal(member, request)) {
        return answer(member.number, request.id, *problem);
    }
    if (is_here(request.name)) return obey_here(member, client, request, now);
    const auto found = commands_.find(request.name);
    if (found == commands_.end()) {
        return answer(member.number, request.id,
                      Problem{"unavailable", request.name + " is not served here", "do"});
    }
    found->second(Call(request.in, member.number,
                       [this, number = member.number, id = request.id](Call::Outcome outcome) {
                           answer(number, id, outcome);
                       }));
}

bool Desk::is_here(const std::string& name) const {
    return name.starts_with("driver.");
}

void Desk::obey_here(Clients::Member& member, ClientId client, const Request& request, Time now) {
    if (request.name == "watch") {
        const auto problem = board_.watch(client, request.in, now);
        return send(
            client, false,
            problem ? answer_text(request.id, *problem) : answer_text(request.id, Json::object()));
    }
    if (request.name == "unwatch") {
        board_.unwatch(client, request.in["watch"]);
        return send(client, false, answer_text(request.id, Json::object()));
    }
    Json out = Json::object();
    if (request.name == "driver.ask") out["driver"] = clients_.ask(member, now);
    if (request.name == "driver.answer") clients_.answer(request.in["give"]);
    if (request.name == "driver.leave") clients_.let_go();
    answer(member.number, request.id, out);
    people_changed_();
}

void Desk::answer(uint32_t number, uint64_t id, const Call::Outcome& outcome) {
    Clients::Member* member = clients_.find(number);
    if (!member) return;
    const std::string text = answer_text(id, outcome);
    clients_.finish(*member, id, text);
    if (member->connection) send(*member->connection, false, text);
}

void Desk::send(ClientId client, bool binary, std::string bytes) {
    const auto found = connections_.find(client);
    if (found == connections_.end()) return;
    if (found->second.dropped) return;
    found->second.unsent += bytes.size();
    outside_.send(client, binary, std::move(bytes));
    if (found->second.unsent > Protocol::get().limit("unsent_bytes")) {
        drop(client, "this page asks for more than it takes; it may return");
    }
}

void Desk::drop(ClientId client, const std::string& why) {
    connections_.at(client).dropped = true;
    outside_.close(client, why);
}

void Desk::tick(Time now) {
    now_ = now;
    if (clients_.tick(now)) people_changed_();
    const auto has_room = [this](ClientId client) {
        const auto found = connections_.find(client);
        return found != connections_.end() && !found->second.dropped &&
               found->second.unsent < kRoomBytes;
    };
    board_.flush(now, has_room, [this](ClientId client, bool binary, std::string bytes) {
        send(client, binary, std::move(bytes));
    });
    for (auto& [client, connection] : connections_) {
        if (connection.dropped) continue;
        if (connection.refuse_at && now >= *connection.refuse_at) {
            refuse(client, connection);
            continue;
        }
        if (connection.unsent == 0) connection.took = now;
        if (now > connection.took + limit_ms("silent_ms")) {
            drop(client, "this page took nothing for too long; it may return");
        } else if (!connection.known && now > connection.opened + limit_ms("hello_ms")) {
            drop(client, "expected the command hello");
        }
    }
}

Time Desk::next_tick(Time now) const {
    Time next = std::min(board_.next_due(now), clients_.next_tick());
    if (!connections_.empty()) next = std::min(next, now + 1s);
    for (const auto& [client, connection] : connections_) {
        if (connection.refuse_at && !connection.dropped) {
            next = std::min(next, *connection.refuse_at);
        }
    }
    return next;
}

}  // namespace vagus::serve
