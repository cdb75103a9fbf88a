// For tests: the process of a run, in this process, and the server at the other end of its pipe.
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <thread>

#include "base/file.hpp"
#include "base/test_folder.hpp"
#include "serve/runner/runner.hpp"
#include "serve/talk/codec.hpp"

namespace vagus::serve {

constexpr int kLooksMax = 200'000;  // a process that talks much is read in small pieces

class RunnerTest : public testing::Test {
protected:
    RunnerTest() {
        int pair[2];
        EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
        server.emplace(pair[0]);
        thread = std::thread([this, end = pair[1]] { ended = run_runner(Pipe(end)); });
    }
    ~RunnerTest() override { leave(); }
    int leave() {
        server.reset();
        if (thread.joinable()) thread.join();
        return ended.status;
    }
    void say(const talk::Order& order) { ASSERT_TRUE(server->send(talk::encode(order))); }
    // The next thing that it says of that kind and that is so.
    template <typename One>
    One wait(const std::function<bool(const One&)>& is_so = [](const One&) { return true; }) {
        One found;
        const bool said = wait_all([&](const talk::News& news) {
            const One* one = std::get_if<One>(&news);
            if (!one || !is_so(*one)) return false;
            found = *one;
            return true;
        });
        EXPECT_TRUE(said) << "it never said " << One::kName;
        return found;
    }
    // Everything that it says until that was it; false: that never came.
    bool wait_all(const std::function<bool(const talk::News&)>& is_it) {
        for (int look = 0; look < kLooksMax && !server->closed(); ++look) {
            server->flush();
            for (const Packet& packet : server->receive()) {
                auto news = talk::decode_news(packet);
                EXPECT_TRUE(news.ok()) << (news.ok() ? "" : news.error().what);
                if (news.ok()) heard.push_back(std::move(news.value()));
            }
            while (!heard.empty()) {
                const talk::News news = std::move(heard.front());
                heard.pop_front();
                if (is_it(news)) return true;
            }
            server->wait(100);
        }
        return false;
    }
    // Until it has closed its end.
    void wait_end() {
        for (int look = 0; look < kLooksMax && !server->closed(); ++look) {
            server->wait(100);
            (void)server->receive();
        }
        EXPECT_TRUE(server->closed());
    }
    std::string write(const std::string& name, const std::string& text) {
        const std::string path = (folder / name).string();
        EXPECT_TRUE(write_file(path, text).ok());
        return path;
    }
    std::string world() {
        return write("room.world.json",
                     R"({"format": "vagus-world/1", "name": "Room", "size": [2, 2], "robots":
                         [{"name": "alice", "type": "thymio2", "at": [1, 1]}]})");
    }
    static talk::Open order(uint64_t number, const std::string& world,
                            const std::string& plan = "") {
        talk::Open open;
        open.order = number;
        open.world = world;
        open.plan = plan;
        return open;
    }
    // Waits until an event that never comes.
    std::string waiting_plan(const std::string& help = "") {
        return write("wait.plan.json", R"({"format": "vagus-plan/1", "name": "P", "help": ")" +
                                           help + R"(", "start": {"actor": "a"}, "actors": {
            "a": {"template": "WaitForever", "states": {}}}})");
    }

    test::Folder folder;
    std::optional<Pipe> server;
    std::thread thread;
    RunnerEnd ended{-1, {}};
    std::deque<talk::News> heard;
};

}  // namespace vagus::serve
