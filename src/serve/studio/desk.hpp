// Where pages and the parts of the studio meet: who they are, what they may do, their commands to
// the part that obeys them, and what they watch. One thread; told the time.
//
//     Desk desk(access, send, log);
//     desk.command("node.run", [&](const Call& call) { call.done(run(call.in)); });
//     desk.board().document("robot", [&](const Json&) { return robot_document(); });
//     desk.hear(event, now);                       // of the web server
//     desk.tick(now);
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <variant>

#include "base/result.hpp"
#include "serve/access.hpp"
#include "serve/studio/board.hpp"
#include "serve/studio/clients.hpp"
#include "serve/web/server.hpp"

namespace vagus::serve {

constexpr size_t kRoomBytes = 256 * 1024;  // unsent to a page, above which it gets nothing new

// One command under way. Its answer may come later; it is kept for a client that lost its
// connection meanwhile.
class Call {
public:
    using Json = nlohmann::json;
    using Outcome = std::variant<Json, Problem>;
    Call(Json its_in, uint32_t its_member, std::function<void(Outcome)> answer)
        : in(std::move(its_in)), member(its_member), answer_(std::move(answer)) {}

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

private:
    std::function<void(Outcome)> answer_;
};

class Desk {
public:
    using Json = nlohmann::json;
    struct Outside {
        Board::Send send;
        std::function<void(ClientId, std::string reason)> close;
        std::function<void(const std::string&)> log;
        std::function<double()> wall_ms;  // milliseconds since 1970
    };

    Desk(Access access, Outside outside);

    void command(const std::string& name, std::function<void(const Call&)> obey);
    Board& board() { return board_; }
    double wall_ms() const { return outside_.wall_ms(); }
    const Clients& clients() const { return clients_; }
    // Version, driver, who asks, how many: what the topic studio says of them.
    Json people() const;
    // Called when the driver or who is connected changes.
    void on_people(std::function<void()> changed) { people_changed_ = std::move(changed); }

    void hear(const WebEvent& event, Time now);
    // Sends what is due; drops who takes nothing.
    void tick(Time now);
    Time next_tick(Time now) const;

private:
    struct Connection {
        std::string address;
        Time opened{};
        bool known = false;                  // said hello
        bool dropped = false;                // sent away; what it says is not heard any more
        std::optional<Time> refuse_at = {};  // it had a wrong token, and hears so then
        uint64_t refused_id = 0;
        size_t unsent = 0;     // bytes
        Time took{};           // when it last took something, or had nothing to take
        double allowance = 0;  // commands it may send now
        Time allowance_at{};
    };

    void on_opened(const ClientOpened& opened, Time now);
    void on_text(ClientId client, const std::string& text, Time now);
    void on_took(const ClientTook& took, Time now);
    void on_closed(ClientId client, Time now);
    void greet(ClientId client, const Request& request, Time now);
    void welcome(ClientId client, const Request& request, Role role, Time now);
    void refuse(ClientId client, Connection& connection);
    void obey(Clients::Member& member, ClientId client, const Request& request, Time now);
    void obey_here(Clients::Member& member, ClientId client, const Request& request, Time now);
    bool is_here(const std::string& name) const;
    std::optional<Problem> refusal(const Clients::Member& member, const Request& request) const;
    bool within_rate(Connection& connection, Time now) const;
    void answer(uint32_t member, uint64_t id, const Call::Outcome& outcome);
    void send(ClientId client, bool binary, std::string bytes);
    void drop(ClientId client, const std::string& why);

    Access access_;
    Outside outside_;
    Board board_;
    Clients clients_;
    std::map<ClientId, Connection> connections_;
    std::map<std::string, std::function<void(const Call&)>> commands_;
    std::function<void()> people_changed_ = [] {};
    Time now_{};
};

}  // namespace vagus::serve
