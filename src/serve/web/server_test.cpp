// The server with real connections on loopback.
#include "serve/web/server.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/read_until.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/websocket.hpp>
#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <mutex>

namespace vagus::serve {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using testing::HasSubstr;
using testing::StartsWith;
using Tcp = asio::ip::tcp;

struct WebServerTest : testing::Test {
    void SetUp() override {
        std::filesystem::create_directories(folder / "assets");
        std::ofstream(folder / "index.html") << "<!doctype html>hello";
        std::ofstream(folder / "assets/a-1.js") << "1";
        std::ofstream(folder / "assets/a-1.js.gz") << "zipped";
        begin({});
    }
    void TearDown() override { server.reset(); }
    void begin(WebOptions options) {
        options.pages = folder.string();
        auto started = WebServer::start(options, [this] {
            const std::lock_guard lock(mutex);
            woken = true;
            changed.notify_all();
        });
        ASSERT_TRUE(started.ok()) << started.error().what;
        server = std::move(started.value());
    }
    Tcp::socket connect() {
        Tcp::socket socket(io);
        socket.connect({asio::ip::make_address("127.0.0.1"), server->port()});
        return socket;
    }
    std::string host() const { return "127.0.0.1:" + std::to_string(server->port()); }
    // What comes back until the server closes.
    std::string ask(const std::string& text) {
        Tcp::socket socket = connect();
        boost::system::error_code ignored;
        asio::write(socket, asio::buffer(text), ignored);
        std::string answer;
        asio::read(socket, asio::dynamic_buffer(answer), ignored);
        return answer;
    }
    std::string get(const std::string& path, const std::string& more = "") {
        return ask("GET " + path + " HTTP/1.1\r\nHost: " + host() + "\r\nConnection: close\r\n" +
                   more + "\r\n");
    }
    // Waits for the next event of a kind.
    template <typename Event>
    Event next() {
        for (;;) {
            while (!events.empty()) {
                WebEvent event = std::move(events.front());
                events.erase(events.begin());
                if (auto* wanted = std::get_if<Event>(&event)) return *wanted;
            }
            std::unique_lock lock(mutex);
            changed.wait(lock, [this] { return woken; });
            woken = false;
            lock.unlock();
            for (WebEvent& event : server->take()) events.push_back(std::move(event));
        }
    }
    std::unique_ptr<beast::websocket::stream<Tcp::socket>> live() {
        auto socket = std::make_unique<beast::websocket::stream<Tcp::socket>>(connect());
        socket->set_option(
            beast::websocket::stream_base::decorator([](beast::websocket::request_type& request) {
                request.set(beast::http::field::sec_websocket_protocol, kLiveProtocol);
            }));
        socket->handshake(host(), "/live");
        return socket;
    }

    // Of this process, in which the server is.
    static size_t open_files() {
        const std::filesystem::directory_iterator files("/proc/self/fd");
        return static_cast<size_t>(
            std::distance(std::filesystem::begin(files), std::filesystem::end(files)));
    }

    test::Folder folder;
    asio::io_context io;
    std::mutex mutex;
    std::condition_variable changed;
    bool woken = false;
    std::vector<WebEvent> events;
    std::unique_ptr<WebServer> server;
};

TEST_F(WebServerTest, PagesComeWithTheirHeaders) {
    const std::string page = get("/");
    EXPECT_THAT(page, StartsWith("HTTP/1.1 200 OK"));
    EXPECT_THAT(page, HasSubstr("<!doctype html>hello"));
    EXPECT_THAT(page, HasSubstr("Content-Security-Policy: default-src 'none'"));
    EXPECT_THAT(page, HasSubstr("frame-ancestors 'none'"));
    EXPECT_THAT(page, HasSubstr("X-Content-Type-Options: nosniff"));
    EXPECT_THAT(page, HasSubstr("Permissions-Policy: accelerometer=()"));
    EXPECT_THAT(page, Not(HasSubstr("Strict-Transport-Security")));  // not without TLS
    EXPECT_THAT(page, Not(HasSubstr("Access-Control-Allow-Origin")));
    EXPECT_THAT(get("/assets/a-1.js"), HasSubstr("immutable"));
    EXPECT_THAT(get("/assets/a-1.js", "Accept-Encoding: gzip, br\r\n"), HasSubstr("zipped"));
    EXPECT_THAT(get("/healthz"), HasSubstr("\r\n\r\nok\n"));
}

TEST_F(WebServerTest, HealthSaysWhatIsWrong) {
    server->publish_health("the plan ended in an error: no wall");
    EXPECT_THAT(get("/healthz"), StartsWith("HTTP/1.1 503"));
    EXPECT_THAT(get("/healthz"), HasSubstr("\r\n\r\nthe plan ended in an error: no wall\n"));
    server->publish_health("");
    EXPECT_THAT(get("/healthz"), HasSubstr("\r\n\r\nok\n"));
}

TEST_F(WebServerTest, WhatIsNoPageDoesNotExist) {
    for (const char* path : {"/../etc/passwd", "/assets/../../x", "//etc/passwd", "/%2e%2e/x",
                             "/index.html%00", "/assets", "/assets/a-1.js.gz", "/index.html?x=1"}) {
        EXPECT_THAT(get(path), StartsWith("HTTP/1.1 404")) << path;
    }
}

TEST_F(WebServerTest, OtherHostsOriginsMethodsAreRefused) {
    EXPECT_THAT(ask("GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n"), StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(ask("GET / HTTP/1.1\r\n\r\n"), StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(get("/", "Origin: http://evil.example\r\n"), StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(next<WebNote>().text, HasSubstr("evil.example"));
    EXPECT_THAT(ask("POST / HTTP/1.1\r\nHost: " + host() + "\r\nContent-Length: 0\r\n\r\n"),
                StartsWith("HTTP/1.1 405"));
    auto socket = beast::websocket::stream<Tcp::socket>(connect());
    socket.set_option(
        beast::websocket::stream_base::decorator([](beast::websocket::request_type& request) {
            request.set(beast::http::field::origin, "http://evil.example");
            request.set(beast::http::field::sec_websocket_protocol, kLiveProtocol);
        }));
    boost::system::error_code failed;
    socket.handshake(host(), "/live", failed);
    EXPECT_TRUE(failed);
}

TEST_F(WebServerTest, GarbageAndOversizeAreAnsweredOnce) {
    EXPECT_THAT(ask(std::string("\x16\x03\x01\x02 nonsense\r\n\r\n")), StartsWith("HTTP/1.1 400"));
    EXPECT_THAT(get("/" + std::string(20'000, 'a')), StartsWith("HTTP/1.1 431"));
    EXPECT_THAT(get("/", "Content-Length: 5000\r\n"), StartsWith("HTTP/1.1 431"));
    EXPECT_THAT(get("/"), StartsWith("HTTP/1.1 200"));
}

TEST_F(WebServerTest, MessagesGoBothWaysAndAreCounted) {
    auto page = live();
    const ClientId client = next<ClientOpened>().client;
    page->write(asio::buffer(std::string("hello")));
    EXPECT_EQ(next<ClientText>().text, "hello");
    server->know(client);
    server->send(client, "answer");
    server->send_binary(client, std::string("\x01\x00", 2));
    beast::flat_buffer buffer;
    page->read(buffer);
    EXPECT_EQ(beast::buffers_to_string(buffer.data()), "answer");
    EXPECT_TRUE(page->got_text());
    EXPECT_EQ(next<ClientTook>().bytes, 6u);
    buffer.clear();
    page->read(buffer);
    EXPECT_TRUE(page->got_binary());
    server->close(client, "enough");
    boost::system::error_code failed;
    buffer.clear();
    page->read(buffer, failed);
    EXPECT_EQ(page->reason().reason, "enough");
    EXPECT_EQ(next<ClientClosed>().client, client);
}

TEST_F(WebServerTest, AnOversizedMessageEndsItsPageOnly) {
    server.reset();
    begin({.message_bytes_max = 100});
    auto large = live();
    server->know(next<ClientOpened>().client);
    auto other = live();
    server->know(next<ClientOpened>().client);
    large->write(asio::buffer(std::string(101, 'x')));
    beast::flat_buffer buffer;
    boost::system::error_code failed;
    large->read(buffer, failed);
    EXPECT_EQ(large->reason().code, beast::websocket::close_code::too_big);
    EXPECT_THAT(next<WebNote>().text, HasSubstr("above the limit"));
    next<ClientClosed>();
    other->write(asio::buffer(std::string(100, 'y')));
    EXPECT_EQ(next<ClientText>().text.size(), 100u);
}

// Above the limit the one that is silent the longest goes, and who is known is none of them.
TEST_F(WebServerTest, WhoHoldsConnectionsKeepsNobodyOut) {
    server.reset();
    begin({.strangers_of_address_max = 3});
    auto page = live();
    const ClientId client = next<ClientOpened>().client;
    page->write(asio::buffer(std::string("hello")));
    EXPECT_EQ(next<ClientText>().text, "hello");
    server->know(client);
    std::vector<Tcp::socket> idle;
    for (int i = 0; i < 100; ++i) idle.push_back(connect());
    EXPECT_THAT(get("/healthz"), StartsWith("HTTP/1.1 200"));
    auto another = live();
    EXPECT_NE(next<ClientOpened>().client, client);
    page->write(asio::buffer(std::string("still here")));
    EXPECT_EQ(next<ClientText>().text, "still here");
    std::string nothing;
    boost::system::error_code ended;
    asio::read(idle.front(), asio::dynamic_buffer(nothing), ended);
    EXPECT_TRUE(ended == asio::error::eof || ended == asio::error::connection_reset);
}

// What was seen: a request with a wrong token that was cut off kept its socket for five seconds.
TEST_F(WebServerTest, WrongTokensHoldNoMoreSocketsThanOtherStrangers) {
    server.reset();
    begin({.strangers_of_address_max = 3, .now = [] { return Time{}; }});  // nobody's wait ends
    const std::string wrong = "POST /stop HTTP/1.1\r\nHost: " + host() +
                              "\r\nContent-Length: 0\r\nAuthorization: Bearer wrong\r\n\r\n";
    EXPECT_THAT(ask(wrong), StartsWith("HTTP/1.1 401"));  // the first one, at once
    const size_t before = open_files();
    for (int i = 0; i < 200; ++i) {
        Tcp::socket gone = connect();
        asio::write(gone, asio::buffer(wrong));
        next<WebNote>();  // it has been heard, and waits
    }
    EXPECT_THAT(get("/healthz"), StartsWith("HTTP/1.1 200"));
    // Two for each connection; a few may be on their way out.
    EXPECT_LT(open_files(), before + 50);
}

// The same for pages that say hello with one, while the loop that refuses them is busy.
TEST_F(WebServerTest, WrongHellosHoldNoMoreSocketsThanOtherStrangers) {
    server.reset();
    begin({.strangers_of_address_max = 3});
    const size_t before = open_files();
    for (int i = 0; i < 100; ++i) {
        auto page = live();
        page->write(asio::buffer(std::string("hello")));
        next<ClientText>();
    }
    EXPECT_THAT(get("/healthz"), StartsWith("HTTP/1.1 200"));
    EXPECT_LT(open_files(), before + 50);
}

// By a clock that a look at it puts a quarter of a second on: the third wrong token is answered
// 0.5 s and 1 s after the first one.
TEST_F(WebServerTest, WrongTokensAreAnsweredSlowerAndSlower) {
    server.reset();
    std::atomic<int> looks = 0;
    begin({.now = [&looks] { return std::chrono::milliseconds(250) * looks++; }});
    const std::string wrong =
        "GET /metrics HTTP/1.1\r\nHost: " + host() + "\r\nAuthorization: Bearer wrong\r\n\r\n";
    server->publish_metrics("vagus_up 1\n");
    for (int i = 0; i < 3; ++i) EXPECT_THAT(ask(wrong), StartsWith("HTTP/1.1 401"));
    EXPECT_GE(250 * looks, 1500);
    server.reset();
}

// The loop is busy and has not heard its hello: others open connections meanwhile.
TEST_F(WebServerTest, WhoShowsARightTokenGivesWayToNobody) {
    server.reset();
    begin({.may_look = [](std::string_view token) { return token == "right"; },
           .strangers_of_address_max = 3});
    auto page = live();
    const ClientId client = next<ClientOpened>().client;
    page->write(asio::buffer(
        std::string(R"({"id":1,"do":"hello","in":{"token":"right","client":"0123456789"}})")));
    next<ClientText>();
    std::vector<Tcp::socket> idle;
    for (int i = 0; i < 20; ++i) idle.push_back(connect());
    EXPECT_THAT(get("/healthz"), StartsWith("HTTP/1.1 200"));
    server->know(client);
    server->close(client, "seen to the end");
    beast::flat_buffer buffer;
    boost::system::error_code failed;
    page->read(buffer, failed);
    EXPECT_EQ(page->reason().reason, "seen to the end");
}

TEST_F(WebServerTest, AStrangerSaysOneShortMessage) {
    auto page = live();
    const ClientId client = next<ClientOpened>().client;
    page->write(asio::buffer(std::string(4096, 'x')));
    page->write(asio::buffer(std::string(5000, 'y')));
    EXPECT_EQ(next<ClientText>().text.size(), 4096u);
    server->know(client);
    EXPECT_EQ(next<ClientText>().text.size(), 5000u);
    auto other = live();
    next<ClientOpened>();
    other->write(asio::buffer(std::string(4097, 'x')));
    beast::flat_buffer buffer;
    boost::system::error_code failed;
    other->read(buffer, failed);
    EXPECT_EQ(other->reason().code, beast::websocket::close_code::too_big);
    EXPECT_THAT(next<WebNote>().text, HasSubstr("above the limit"));
}

TEST_F(WebServerTest, ALongMessageIsTakenPieceByPiece) {
    auto page = live();
    const ClientId client = next<ClientOpened>().client;
    const std::string whole(1'000'000, 'x');
    server->send(client, whole);
    beast::flat_buffer buffer;
    page->read(buffer);
    EXPECT_TRUE(beast::buffers_to_string(buffer.data()) == whole);
    EXPECT_LT(next<ClientTook>().bytes, whole.size());
}

TEST_F(WebServerTest, StopNeedsATokenAndNothingElse) {
    server.reset();
    begin({.may_look = [](std::string_view token) { return token == "right"; }});
    auto page = live();
    page->write(asio::buffer(std::string("hello")));
    const std::string head = "POST /stop HTTP/1.1\r\nHost: " + host() + "\r\nContent-Length: 0\r\n";
    EXPECT_THAT(ask(head + "\r\n"), StartsWith("HTTP/1.1 401"));
    EXPECT_THAT(ask(head + "Authorization: Bearer wrong\r\n\r\n"), StartsWith("HTTP/1.1 401"));
    EXPECT_THAT(ask(head + "Origin: http://evil.example\r\nAuthorization: Bearer right\r\n\r\n"),
                StartsWith("HTTP/1.1 403"));
    EXPECT_THAT(ask(head + "Authorization: Bearer right\r\n\r\n"), StartsWith("HTTP/1.1 202"));
    const std::vector<WebEvent> taken = server->take();
    ASSERT_FALSE(taken.empty());
    EXPECT_TRUE(std::holds_alternative<StopAsked>(taken.front()));  // before the hello
    const std::string own = "POST /stop?client=7 HTTP/1.1\r\nHost: " + host() +
                            "\r\nContent-Length: 0\r\nAuthorization: Bearer right\r\n\r\n";
    EXPECT_THAT(ask(own), StartsWith("HTTP/1.1 202"));
    EXPECT_EQ(std::get<StopAsked>(server->take().front()).client, 7u);
    EXPECT_THAT(get("/stop"), StartsWith("HTTP/1.1 404"));
}

TEST_F(WebServerTest, WhatCanBeReadInTwoWaysIsRefused) {
    EXPECT_THAT(get("/", "Host: " + host() + "\r\n"), StartsWith("HTTP/1.1 400"));
    EXPECT_THAT(get("/", "Transfer-Encoding: gzip\r\n"), StartsWith("HTTP/1.1 400"));
}

TEST_F(WebServerTest, AConnectionMayRestBetweenRequestsButNotWithinOne) {
    begin({.request_within = std::chrono::milliseconds(200)});
    const std::string request = "GET /healthz HTTP/1.1\r\nHost: " + host() + "\r\n\r\n";
    Tcp::socket kept = connect();
    const auto answered = [&] {
        asio::write(kept, asio::buffer(request));
        std::string answer;
        asio::read_until(kept, asio::dynamic_buffer(answer), "\r\n\r\nok\n");
        return answer;
    };
    EXPECT_THAT(answered(), StartsWith("HTTP/1.1 200"));
    // Begun after that, and cut off for its slowness: so long the other has rested.
    EXPECT_EQ(ask("GET /healthz HT"), "");
    EXPECT_THAT(answered(), StartsWith("HTTP/1.1 200"));
}

TEST_F(WebServerTest, WithoutPagesItSaysWhoMakesThem) {
    WebOptions options;
    options.pages = (folder / "nothing").string();
    const auto started = WebServer::start(options, [] {});
    ASSERT_FALSE(started.ok());
    EXPECT_THAT(started.error().what, HasSubstr("./run builds them"));
    options.pages = folder.string();
    options.address = "not an address";
    EXPECT_THAT(WebServer::start(options, [] {}).error().what, HasSubstr("expected an IP address"));
}

}  // namespace
}  // namespace vagus::serve
