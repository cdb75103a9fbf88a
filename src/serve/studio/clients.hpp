// Who is connected, what each may do, and who has control (docs/protocol.md). A client
// is known by the key that its page made, so that it may lose its connection and come back: its
// control and the answers that it missed wait for it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "serve/protocol/protocol.hpp"
#include "serve/web/server.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

enum class Role { Look, Drive };

constexpr Duration kWheelAnswerWithin = 10s;  // of a driver who is asked; then it is refused
// After a restart, behind the page that connected first.
constexpr Duration kControlBackWithin = 10s;
constexpr Duration kForgetAfter = 600s;        // a client that has gone
constexpr size_t kAnswersKept = 200;           // of a client, for commands that come twice
constexpr size_t kAnswerBytesKept = 4u << 20;  // of a client; the newest one in any case
constexpr size_t kKnownMax = 256;              // clients that are remembered

// A command of one client, for which one answer is due.
struct CommandKey {
    uint32_t member = 0;  // number of the client
    uint64_t id = 0;
};

class Clients {
public:
    struct Member {
        uint32_t number = 0;
        std::string key = {}, name = {};
        Role role = Role::Look;
        std::optional<ClientId> connection = {};
        Time gone_since{};
        // Answers by id; empty while the command is under way.
        std::map<uint64_t, std::string> answers = {};
        size_t answer_bytes = 0;
        uint64_t forgotten = 0;  // ids up to this one were answered long ago
        uint64_t stops = 0;      // how often others have pressed Stop
    };
    struct Ask {
        uint32_t member = 0;
        Time until{};
    };

    // A page with a good token. A connection that the same client had before is given back, to be
    // closed. The first who may drive has control.
    Member& enter(ClientId connection, const std::string& key, const std::string& name, Role role,
                  Time now, std::optional<ClientId>& replaced);
    void leave(ClientId connection, Time now);

    // The page that connects with this key and role now, if any.
    const Member* connected_with(const std::string& key, Role role) const;
    Member* find(ClientId connection);
    Member* find(uint32_t number);
    const Member* find(uint32_t number) const;
    const Member* driver() const;
    bool drives(const Member& member) const { return member.number == driver_; }
    size_t connected() const;
    const std::optional<Ask>& asked() const { return asked_; }

    // ---- commands that come twice ----
    enum class Seen { New, UnderWay, Done, TooOld };
    Seen begin(Member& member, uint64_t id);
    static bool is_answered(const Member& member, uint64_t id);
    // The text of the answer, kept for a repetition.
    void finish(Member& member, uint64_t id, const std::string& answer);

    // Somebody has pressed Stop: the client with that number, or nobody's page (0).
    void count_stop(uint32_t by);

    // ---- control ----
    // True: the page has it now, as no connected page had it. False: the driver is asked; if its
    // page closes meanwhile, control is released.
    bool ask(Member& member, Time now);
    void answer(bool give);
    void let_go() { driver_ = 0; }
    // A page that has just entered had control when the server before this one ended: it has it
    // again, if the one that has it now only came first.
    void take_back(const Member& member, Time now);
    // Refuses what the driver did not answer. True if pages must be told.
    bool tick(Time now);
    Time next_tick() const;

private:
    bool is_here(uint32_t number) const;
    void forget(Time now);
    static void forget_oldest(Member& member);

    std::map<uint32_t, Member> members_;
    std::map<ClientId, uint32_t> connections_;
    uint32_t last_ = 0;
    uint32_t driver_ = 0;
    Time back_until_{};  // of a driver who only came first
    std::optional<Ask> asked_;
};

}  // namespace vagus::serve
