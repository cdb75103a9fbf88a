// Where pages and the parts of the studio meet: who they are, what they may do, their commands to
// the part that obeys them, and what they watch. One thread; told the time.
//
//     Desk desk(access, {.send = …, .close = …, .log = …, .wall_ms = …});
//     desk.command("node.run", [&](const Call& call) { call.done(run(call.in)); });
//     desk.topics().document("robot", [&](const Json&) { return target_document(); });
//     desk.hear(event, now);                       // of the web server
//     desk.tick(now);
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "base/result.hpp"
#include "serve/access.hpp"
#include "serve/json.hpp"
#include "serve/studio/calm_log.hpp"
#include "serve/studio/clients.hpp"
#include "serve/studio/topics.hpp"
#include "serve/web/server.hpp"

namespace vagus::serve {

// The answer to what was asked for before a Stop, and would have run behind it.
constexpr const char* kStoppedBefore = "it was stopped before it ran";

constexpr size_t kRoomBytes = 256 * 1024;  // unsent to a page, above which it gets nothing new
// Sent to a page, and perhaps still on its way: above which it gets nothing new. On a line of
// 50 kB/s, whose buffers hold much more, it sees what was a second and a half ago, not a minute.
constexpr size_t kOnTheWayBytes = 64 * 1024;
constexpr size_t kMarkEvery = 16 * 1024;  // bytes; then a ping asks how far it has read
constexpr size_t kMarksMax = 4096;        // pings of a client that are not answered
constexpr uint64_t kPingsMissedMax = 3;   // a client that left so many unanswered is silent
constexpr size_t kSlowBytes = 64 * 1024;  // unsent to a client: our ping waits behind that
constexpr Duration kTwinWithin = 1s;      // a page that may have a twin answers a ping
constexpr Duration kOnTime = 2s;          // a tick so long after the last: our own loop was late
constexpr Duration kPingLateMax = 500ms;  // so was it for a ping that left this much behind time
constexpr double kUntilAheadMax = 1000;   // ms by which a page may take our clock to be ahead

// One command under way. Its answer may come later; it is kept for a client that lost its
// connection meanwhile.
class Call {
public:
    using Outcome = std::variant<Json, Problem>;
    Call(Json its_in, uint32_t its_member, std::function<void(Outcome)> answer,
         std::string its_way = {})
        : in(std::move(its_in)),
          member(its_member),
          way(std::move(its_way)),
          answer_(std::move(answer)) {}

    // Exactly one of these, once.
    void done(Json out = Json::object()) const { answer_(std::move(out)); }
    void fail(Problem problem) const { answer_(std::move(problem)); }
    void fail(std::string code, std::string what) const {
        answer_(Problem{std::move(code), std::move(what), ""});
    }
    void fail(const Error& error) const;
    // Done without more to say, or why not.
    void answer(const Status& status) const { status.ok() ? done() : fail(status.error()); }

    const Json in;
    const uint32_t member;  // who asks
    const std::string way;  // how, without a page: "POST /stop from 127.0.0.1"

private:
    std::function<void(Outcome)> answer_;
};

class Desk {
public:
    struct Outside {
        Topics::Send send;
        std::function<void(ClientId, std::string reason)> close;
        std::function<void(const std::string&)> log;
        std::function<double()> wall_ms;  // milliseconds since 1970
        // The client has shown a right token: its connection has a place of its own from now on.
        std::function<void(ClientId)> know = [](ClientId) {};
        // Makes a new token of those who drive, in the place of the one that Access has.
        std::function<Result<std::string>()> renew = {};
        std::function<std::string()> random = [] { return std::string("0"); };  // 32 digits
    };

    Desk(Access access, Outside outside);

    void command(const std::string& name, std::function<void(const Call&)> obey);
    // A robot that serves itself: only commands that protocol.json marks are obeyed, others hear
    // why.
    void allow_only_on_robot(std::string why_not) { only_on_robot_ = std::move(why_not); }
    Topics& topics() { return topics_; }
    double wall_ms() const { return outside_.wall_ms(); }
    const std::string& epoch() const { return epoch_; }
    const Clients& clients() const { return clients_; }
    // Is it connected, and does it answer? Slow is not gone: what we did not send it in time, and a
    // ping behind much that it is just taking, is not its silence.
    bool is_there(uint32_t member) const;
    // How many are.
    size_t present() const;
    // Version, driver, who asks, how many: what the topic studio says of them.
    Json people() const;
    // Somebody has pressed Stop: the client with that number, or nobody's page (0). What another
    // page asked for before it has heard of that is refused, however long it was on its way.
    void count_stop(uint32_t by);
    // Called when the driver, who is connected or who is there changes.
    void on_people(std::function<void()> changed) { people_changed_ = std::move(changed); }

    void hear(const WebEvent& event, Time now);
    // All of one turn: what stops comes before everything else.
    void hear(std::vector<WebEvent> events, Time now);
    // Sends what is due; drops who takes nothing.
    void tick(Time now);
    Time next_tick(Time now) const;

private:
    // A page whose name another one has, too: it waits until that one answered a ping, or did not.
    struct Twin {
        Request request;
        Role role = Role::Look;
        ClientId other;
        uint64_t ping = 0;
        Time until{};
    };
    // What a client has read is known from the pings behind it that it answered. Of one that never
    // answers nothing is known: it is no page.
    class OnTheWay {
    public:
        void add(size_t bytes) { sent_ += bytes; }
        bool wants_mark() const { return sent_ - marked_ >= kMarkEvery; }
        void mark(uint64_t ping);
        void answered(uint64_t ping);
        bool is_much() const { return answers_ && sent_ - came_ >= kOnTheWayBytes; }

    private:
        struct Mark {
            uint64_t ping = 0, sent = 0;
        };
        uint64_t sent_ = 0, came_ = 0, marked_ = 0;  // bytes
        std::deque<Mark> marks_;
        bool answers_ = false;
    };
    struct Connection {
        std::string address;
        std::string nonce = {};  // of the page load
        std::optional<Twin> twin = {};
        uint64_t pings_missed = 0;
        bool took = false;  // something of what was unsent, since the last ping
        Time opened{};
        bool known = false;                  // said hello
        bool dropped = false;                // sent away; what it says is not heard any more
        std::optional<Time> refuse_at = {};  // it had a wrong token, and hears so then
        uint64_t refused_id = 0;
        size_t unsent = 0;  // bytes
        OnTheWay on_the_way = {};
        Duration silent{};     // it took nothing of that, while our own loop was on time
        double allowance = 0;  // commands it may send now
        Time allowance_at{};
    };

    void on_opened(const ClientOpened& opened, Time now);
    void on_message(ClientId client, const Message& message, Time now);
    void on_took(const ClientTook& took);
    void on_closed(ClientId client, Time now);
    void on_stop_asked(const StopAsked& asked);
    bool is_stop(const WebEvent& event) const;
    void take(ClientId client, Connection& connection, const Message& message, Time now);

    // ---- greeting.cpp: who comes ----
    void make_room();
    void greet(ClientId client, const Request& request, Time now);
    bool wait_for_twin(ClientId client, const Request& request, Role role, Time now);
    void settle_twins(ClientId other, std::optional<uint64_t> ponged, Time now);
    void settle_twin(ClientId client, bool are_two, Time now);
    void welcome(ClientId client, const Request& request, Role role, Time now);
    void refuse(ClientId client, Connection& connection);
    void refuse_hello(ClientId client, uint64_t id, Problem problem);
    void on_pong(ClientId client, const Pong& pong, Time now);
    void hear_life(Connection& connection);
    static bool is_silent(const Connection& connection);
    void ping(Time now);
    void send_ping(ClientId client, Time now);
    void tell_stops(Time now);
    void look_after(ClientId client, Connection& connection, Duration passed, Time now);
    void renew_access(const Clients::Member& member, ClientId client, uint64_t id);

    // ---- obeying ----
    void obey(Clients::Member& member, ClientId client, const Request& request, Time now);
    void obey_new(Clients::Member& member, ClientId client, const Request& request, Time now);
    void obey_here(Clients::Member& member, ClientId client, const Request& request, Time now);
    std::optional<Problem> lateness(const Clients::Member& member, const Request& request,
                                    Time now) const;
    bool is_here(const std::string& name) const;
    std::optional<Problem> refusal(const Clients::Member& member, const Request& request) const;
    bool within_rate(Connection& connection, Time now) const;
    void answer(uint32_t member, uint64_t id, const Call::Outcome& outcome);
    void send(ClientId client, bool binary, std::string bytes);
    void drop(ClientId client, const std::string& why);

    void log(const std::string& line) { log_.add(line, now_); }

    Access access_;
    Outside outside_;
    CalmLog log_;
    const std::string epoch_;  // of this life of the server
    std::string only_on_robot_;
    Topics topics_;
    Clients clients_;
    std::map<ClientId, Connection> connections_;
    std::map<std::string, std::function<void(const Call&)>> commands_;
    std::function<void()> people_changed_ = [] {};
    bool overtaken_ = false;  // what is heard now came before a Stop that was obeyed first
    Time now_{}, ticked_{};
    uint64_t pings_ = 0;
    Time next_ping_{};
    bool tells_stops_ = false;  // pages do not know of the last Stop yet
};

}  // namespace vagus::serve
