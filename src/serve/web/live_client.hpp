// The other end of the WebSocket: a program that talks to a server as a page does
// (docs/protocol.md).
// One command at a time, each waited for; what the server says of itself is not heard.
//
//     const ServerAddress address = TRY(parse_address("http://robot:8910/#token=…"));
//     auto client = TRY(LiveClient::connect(address, "vagus deploy"));
//     const Json out = TRY(client->ask("deploy.list", Json::object()));
#pragma once

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "base/result.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

constexpr auto kMeetWithin = std::chrono::seconds(10);
// A robot that puts another version in force has 10 s for its start, and may be slow before.
constexpr auto kAnswerWithin = std::chrono::seconds(120);

struct ServerAddress {
    bool secure = false;
    std::string host = {};  // IPv6 without brackets
    uint16_t port = 0;
    std::string token = {};        // of the fragment; may be empty
    std::string certificate = {};  // PEM file that is trusted, too
};

// "http://HOST:PORT/#token=…", "https://…", "HOST:PORT", "HOST"; without a port 8910.
Result<ServerAddress> parse_address(const std::string& text);

class LiveClient {
public:
    // Connects and says hello. The Error says what was tried and what came of it.
    static Result<std::unique_ptr<LiveClient>> connect(const ServerAddress& address,
                                                       const std::string& name);
    ~LiveClient();

    // The answer's `ok`. The Error has the sentence of its `error`; Refused if another drives.
    Result<Json> ask(const std::string& command, Json in);
    void wait(std::chrono::milliseconds so_long);

private:
    class Insides;
    explicit LiveClient(std::unique_ptr<Insides> insides);
    std::unique_ptr<Insides> insides_;
};

}  // namespace vagus::serve
