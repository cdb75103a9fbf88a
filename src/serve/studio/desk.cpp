#include "serve/studio/desk.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/studio/answer_text.hpp"
#include "serve/thrown.hpp"

namespace vagus::serve {

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

double allowance_max() {
    return static_cast<double>(Protocol::get().limit("commands_a_second")) * kBurstSeconds;
}

// What was not read where it came in is read here.
template <typename Use>
auto with_message(const ClientText& text, const Use& use) {
    if (text.message) return use(*text.message);
    return use(Protocol::get().read(text.text));
}

}  // namespace

void Call::fail(const Error& error) const {
    fail(code_of(error.code), error.what);
}

Desk::Desk(Access access, Outside outside)
    : access_(std::move(access)),
      outside_(std::move(outside)),
      log_(outside_.log),
      epoch_(outside_.random()) {}

void Desk::command(const std::string& name, std::function<void(const Call&)> obey) {
    commands_[name] = std::move(obey);
}

Json Desk::people() const {
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
        return with_message(
            *text, [&](const Message& message) { on_message(text->client, message, now); });
    }
    if (const auto* took = std::get_if<ClientTook>(&event)) return on_took(*took);
    if (const auto* closed = std::get_if<ClientClosed>(&event)) {
        return on_closed(closed->client, now);
    }
    if (const auto* stop = std::get_if<StopAsked>(&event)) return on_stop_asked(*stop);
    log(std::get<WebNote>(event).text);
}

void Desk::hear(std::vector<WebEvent> events, Time now) {
    const auto stops = [this](const WebEvent& event) { return is_stop(event); };
    const bool posted = std::any_of(events.begin(), events.end(), [](const WebEvent& event) {
        return std::holds_alternative<StopAsked>(event);
    });
    // Where a request of its own came among the others, nobody knows: it counts as the last.
    const auto last =
        posted ? events.end() : std::find_if(events.rbegin(), events.rend(), stops).base();
    const auto overtaken = std::stable_partition(events.begin(), last, stops);
    for (auto event = events.begin(); event != events.end(); ++event) {
        overtaken_ = event >= overtaken && event < last;
        hear(*event, now);
    }
    overtaken_ = false;
}

// A command of a page that is known.
bool Desk::is_stop(const WebEvent& event) const {
    if (std::holds_alternative<StopAsked>(event)) return true;
    const auto* text = std::get_if<ClientText>(&event);
    if (!text) return false;
    const auto from = connections_.find(text->client);
    if (from == connections_.end() || !from->second.known) return false;
    return with_message(*text, [](const Message& message) {
        const auto* request = std::get_if<Request>(&message);
        return request && request->type->kind == CommandKind::Stop;
    });
}

// Of someone without a page: what comes of it is in the log, once it is obeyed.
void Desk::on_stop_asked(const StopAsked& asked) {
    const auto found = commands_.find("stop");
    if (found != commands_.end()) {
        const auto answered = [this](const Call::Outcome& outcome) {
            if (const auto* problem = std::get_if<Problem>(&outcome)) log("stop: " + problem->what);
        };
        const Call call(Json::object(), asked.client, answered, "POST /stop from " + asked.address);
        if (const auto thrown = thrown_by([&] { found->second(call); })) log("stop: " + *thrown);
    }
    log(asked.address + ": POST /stop");
}

void Desk::on_opened(const ClientOpened& opened, Time now) {
    Connection& connection = connections_[opened.client];
    connection.address = opened.address;
    connection.opened = connection.allowance_at = now;
    connection.allowance = allowance_max();  // a page that has just come brings its subscriptions
    make_room();
}

void Desk::on_took(const ClientTook& took) {
    const auto found = connections_.find(took.client);
    if (found == connections_.end()) return;
    found->second.unsent -= std::min(found->second.unsent, took.bytes);
    found->second.silent = {};
    found->second.took = true;
}

void Desk::on_closed(ClientId client, Time now) {
    connections_.erase(client);
    topics_.drop(client);
    clients_.leave(client, now);
    settle_twins(client, std::nullopt, now);
    people_changed_();
}

void Desk::on_message(ClientId client, const Message& message, Time now) {
    const auto found = connections_.find(client);
    if (found == connections_.end() || found->second.dropped) return;
    if (found->second.refuse_at || found->second.twin) return;
    hear_life(found->second);
    take(client, found->second, message, now);
}

void Desk::take(ClientId client, Connection& connection, const Message& message, Time now) {
    if (const auto* refusal = std::get_if<Refusal>(&message)) {
        log(fmt::format("{}: refused a message: {}", connection.address, refusal->problem.what));
        send(client, false, answer_text(refusal->id, refusal->problem));
        if (!connection.known) drop(client, "expected the command hello");
        return;
    }
    const auto* pong = std::get_if<Pong>(&message);
    if (pong && connection.known) return on_pong(client, *pong, now);
    if (pong) return drop(client, "expected the command hello");
    const Request& request = std::get<Request>(message);
    Clients::Member* member = clients_.find(client);
    if (request.name == "hello") return greet(client, request, now);
    if (!member) {
        send(client, false,
             answer_text(request.id,
                         Problem{"not_allowed", "say hello first, with the token", "do"}));
        return drop(client, "expected the command hello");
    }
    const bool stops = request.type->kind == CommandKind::Stop;
    if (!within_rate(connection, now) && !stops) {
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
    const double passed = seconds_of(now - connection.allowance_at);
    connection.allowance_at = now;
    connection.allowance =
        std::min(connection.allowance + passed * allowance_max() / kBurstSeconds, allowance_max());
    if (connection.allowance < 1) return false;
    connection.allowance -= 1;
    return true;
}

std::optional<Problem> Desk::refusal(const Clients::Member& member, const Request& request) const {
    switch (request.type->may) {
        case May::Any:
        case May::Look:
            break;
        case May::Drive:
            if (member.role == Role::Drive) break;
            return Problem{"not_allowed", "this token may only look", ""};
        case May::Driver:
            if (clients_.drives(member)) break;
            if (member.role == Role::Look) {
                return Problem{"not_allowed", "this token may only look", ""};
            }
            return Problem{"not_driver",
                           fmt::format("{} has control; request control first",
                                       clients_.driver() ? clients_.driver()->name : "nobody"),
                           ""};
    }
    if (only_on_robot_.empty() || request.type->on_robot) return std::nullopt;
    return Problem{"not_allowed", only_on_robot_, ""};
}

// A command that can move something is not done later than the person who gave it expects.
std::optional<Problem> Desk::lateness(const Clients::Member& member, const Request& request,
                                      Time now) const {
    if (request.type->kind != CommandKind::Act) return std::nullopt;
    if (overtaken_) return Problem{"failed", kStoppedBefore, ""};
    if (request.stops.value_or(member.stops) < member.stops) {
        return Problem{"failed",
                       request.name +
                           " was asked for before somebody else pressed Stop; it was not done. "
                           "Give it again",
                       "stops"};
    }
    if (!request.until) {
        return Problem{"late",
                       request.name +
                           " can move something and has no deadline; it was not done. Send until, "
                           "a time of the server in milliseconds (docs/protocol.md)",
                       "until"};
    }
    const double ms = server_ms(now);
    const auto most = static_cast<double>(Protocol::get().limit("act_ms"));
    if (*request.until < ms) {
        return Problem{"late",
                       fmt::format("{} came {:.0f} ms too late; it was not done. Give it again",
                                   request.name, ms - *request.until),
                       "until"};
    }
    if (*request.until <= ms + most + kUntilAheadMax) return std::nullopt;
    return Problem{
        "late",
        fmt::format("{} names a deadline {:.0f} ms ahead; at most {:.0f} are allowed, so "
                    "it was not done. Give it again",
                    request.name, *request.until - ms, most),
        "until"};
}

// Whatever a command meets, it is answered, and the server goes on.
void Desk::obey(Clients::Member& member, ClientId client, const Request& request, Time now) {
    const uint32_t number = member.number;
    const auto thrown = thrown_by([&] { obey_new(member, client, request, now); });
    if (!thrown) return;
    log(fmt::format("{}: {}", request.name, *thrown));
    const Problem problem{"failed", fmt::format("{} could not be done: {}", request.name, *thrown),
                          "do"};
    const bool only_here = request.name == "watch" || request.name == "unwatch";
    if (only_here) return send(client, false, answer_text(request.id, problem));
    answer(number, request.id, problem);
}

void Desk::obey_new(Clients::Member& member, ClientId client, const Request& request, Time now) {
    // What only concerns this connection begins again with each.
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
    if (const auto problem = lateness(member, request, now)) {
        log(fmt::format("{}: {}", member.name, problem->what));
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

void Desk::count_stop(uint32_t by) {
    clients_.count_stop(by);
    tells_stops_ = true;
}

bool Desk::is_here(const std::string& name) const {
    return name.starts_with("driver.") || name == "access.renew";
}

void Desk::obey_here(Clients::Member& member, ClientId client, const Request& request, Time now) {
    if (request.name == "watch") {
        const auto problem = topics_.watch(client, request.in, now);
        return send(
            client, false,
            problem ? answer_text(request.id, *problem) : answer_text(request.id, Json::object()));
    }
    if (request.name == "unwatch") {
        topics_.unwatch(client, request.in["watch"]);
        return send(client, false, answer_text(request.id, Json::object()));
    }
    if (request.name == "access.renew") return renew_access(member, client, request.id);
    Json out = Json::object();
    if (request.name == "driver.ask") out["driver"] = clients_.ask(member, now);
    if (request.name == "driver.answer") clients_.answer(request.in["give"]);
    if (request.name == "driver.leave") clients_.let_go();
    answer(member.number, request.id, out);
    people_changed_();
}

void Desk::answer(uint32_t number, uint64_t id, const Call::Outcome& outcome) {
    Clients::Member* member = clients_.find(number);
    if (!member || Clients::is_answered(*member, id)) return;
    const std::string text = answer_text(id, outcome);
    clients_.finish(*member, id, text);
    if (member->connection) send(*member->connection, false, text);
}

void Desk::send(ClientId client, bool binary, std::string bytes) {
    const auto found = connections_.find(client);
    if (found == connections_.end()) return;
    if (found->second.dropped) return;
    found->second.unsent += bytes.size();
    found->second.on_the_way.add(bytes.size());
    outside_.send(client, binary, std::move(bytes));
    if (found->second.known && found->second.on_the_way.wants_mark()) send_ping(client, now_);
    if (found->second.unsent > Protocol::get().limit("unsent_bytes")) {
        drop(client, "this page read too slowly and was disconnected; reload it");
    }
}

void Desk::drop(ClientId client, const std::string& why) {
    connections_.at(client).dropped = true;
    outside_.close(client, why);
}

void Desk::tick(Time now) {
    const Duration since = now - std::exchange(ticked_, now);
    now_ = now;
    log_.tick(now);
    if (clients_.tick(now)) people_changed_();
    ping(now);
    tell_stops(now);
    const auto has_room = [this](ClientId client) {
        const auto found = connections_.find(client);
        return found != connections_.end() && !found->second.dropped &&
               found->second.unsent < kRoomBytes && !found->second.on_the_way.is_much();
    };
    const auto to_page = [this](ClientId client, bool binary, std::string bytes) {
        send(client, binary, std::move(bytes));
    };
    for (const std::string& fault : topics_.flush(now, has_room, to_page)) {
        log("a document cannot be shown: " + fault);
    }
    const Duration passed = since < kOnTime ? since : Duration{};
    for (auto& [client, connection] : connections_) {
        if (!connection.dropped) look_after(client, connection, passed, now);
    }
}

Time Desk::next_tick(Time now) const {
    Time next = std::min(topics_.next_due(now), clients_.next_tick());
    if (!connections_.empty()) next = std::min(next, std::max(now, next_ping_));
    if (tells_stops_) next = now;
    for (const auto& [client, connection] : connections_) {
        if (connection.twin) next = std::min(next, connection.twin->until);
        if (connection.refuse_at && !connection.dropped) {
            next = std::min(next, *connection.refuse_at);
        }
    }
    return next;
}

}  // namespace vagus::serve
