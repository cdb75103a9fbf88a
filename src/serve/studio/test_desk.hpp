// For tests: a desk with pages that speak to it, on scripted time.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "serve/json.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::test {}

namespace vagus::serve::test {

using namespace vagus::test;  // what tests of all modules have
using namespace std::chrono_literals;

constexpr const char* kDrive = "0123456789abcdef";
constexpr const char* kLook = "fedcba9876543210";

// A desk with pages that speak to it.
struct Fixture {
    std::map<ClientId, std::vector<Json>> got, pings;
    std::vector<ClientId> known;
    std::string new_token;
    int randoms = 0;
    std::map<ClientId, std::string> closed;
    std::vector<std::string> log;
    int ran = 0;
    std::vector<Call> waiting;
    Time now = 1s;
    Desk desk{Access(kDrive, kLook),
              {.send =
                   [this](ClientId client, bool, std::string bytes) {
                       const Json message = Json::parse(bytes);
                       (message.contains("ping") ? pings : got)[client].push_back(message);
                   },
               .close = [this](ClientId client, std::string why) { closed[client] = why; },
               .log = [this](const std::string& line) { log.push_back(line); },
               .wall_ms = [] { return 1e12; },
               .know = [this](ClientId client) { known.push_back(client); },
               .renew = [this]() -> Result<std::string> { return new_token; },
               .random = [this] { return std::to_string(++randoms) + std::string(31, '0'); }}};

    Fixture() {
        desk.command("node.run", [this](const Call& call) {
            ++ran;
            call.done({{"failed", Json::array()}});
        });
        desk.command("stop", [](const Call& call) { call.done({{"stood", Json::array()}}); });
        desk.command("node.load", [this](const Call& call) { waiting.push_back(call); });
    }
    void open(uint32_t number) { desk.hear(ClientOpened{{number}, "127.0.0.1"}, now); }
    Json say(uint32_t number, Json message) {
        const CommandType* type = Protocol::get().command(message.value("do", ""));
        const bool act = type && type->kind == CommandKind::Act;
        if (act && !message.contains("until"))
            message["until"] = static_cast<double>(now.count()) / 1000 + 3000;
        return say_as_it_is(number, message);
    }
    Json say_as_it_is(uint32_t number, const Json& message) {
        desk.hear(ClientText{{number}, message.dump()}, now);
        const auto& all = got[ClientId{number}];
        return all.empty() ? Json() : all.back();
    }
    Json hello(uint32_t number, const char* token, const char* key, bool had_control = false) {
        open(number);
        Json in = {{"token", token}, {"client", key}};
        if (had_control) in["had_control"] = true;
        return say(number, {{"id", 1}, {"do", "hello"}, {"in", in}});
    }
    Json run(uint32_t number, uint64_t id) {
        return say(number, {{"id", id}, {"do", "node.run"}, {"in", {{"node", 1}}}});
    }
};

}  // namespace vagus::serve::test
