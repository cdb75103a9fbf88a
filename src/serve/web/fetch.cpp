#include "serve/web/fetch.hpp"

#include <fmt/format.h>

#include <boost/asio/ssl/context.hpp>
#include <boost/asio/use_future.hpp>

#include "serve/web/beast.hpp"
#include "serve/web/live_client.hpp"

namespace vagus::serve {

// g++ 12 does not see that the frame of a coroutine is allocated by the function that belongs to
// its delete.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace {

struct Url {
    ServerAddress server;
    std::string path;
};

// "https://HOST:PORT/PATH"
Result<Url> parse_url(const std::string& url) {
    const size_t scheme = url.find("://");
    const size_t path = scheme == url.npos ? url.npos : url.find('/', scheme + 3);
    if (path == url.npos) {
        return Error{Code::BadInput, url + ": expected https://HOST:PORT/PATH"};
    }
    Url parsed{TRY(parse_address(url.substr(0, path))), url.substr(path)};
    const std::string& host = parsed.server.host;
    const bool here = host == "localhost" || host == "127.0.0.1" || host == "::1";
    if (parsed.server.secure || here) return parsed;
    return Error{Code::Refused, url + ": expected https, for it is not on this computer"};
}

struct Fetched {
    std::string bytes;
    std::string refused;  // why nothing was asked for; empty: it was
};

awaitable<Fetched> get(asio::io_context& io, asio::ssl::context& tls, Url url, size_t bytes_max) {
    const ServerAddress& server = url.server;
    Tcp::resolver resolver(io);
    const auto found =
        co_await resolver.async_resolve(server.host, std::to_string(server.port), use_awaitable);
    beast::tcp_stream tcp(io);
    tcp.expires_after(kFetchWithin);
    co_await tcp.async_connect(found, use_awaitable);
    Stream stream(std::move(tcp));
    if (server.secure) {
        const auto why = co_await stream.connect_tls(tls, server.host);
        if (why) co_return Fetched{"", *why};
    }
    stream.expires_after(kFetchWithin);
    http::request<http::empty_body> asked(http::verb::get, url.path, 11);
    asked.set(http::field::host, fmt::format("{}:{}", server.host, server.port));
    asked.keep_alive(false);
    co_await http::async_write(stream, asked, use_awaitable);
    beast::flat_buffer buffer;
    http::response_parser<http::string_body> answer;
    answer.body_limit(bytes_max);
    co_await http::async_read(stream, buffer, answer, use_awaitable);
    if (answer.get().result() != http::status::ok) {
        throw boost::system::system_error(
            make_error_code(boost::system::errc::no_such_file_or_directory),
            std::to_string(answer.get().result_int()));
    }
    co_return Fetched{std::move(answer.get().body()), ""};
}

}  // namespace

Result<std::string> fetch(const std::string& url, const std::string& authority, size_t bytes_max) {
    Url parsed = TRY(parse_url(url));
    try {
        asio::io_context io{1};
        asio::ssl::context tls{asio::ssl::context::tls_client};
        tls.set_default_verify_paths();
        if (!authority.empty()) tls.load_verify_file(authority);
        tls.set_verify_mode(asio::ssl::verify_peer);
        auto future =
            asio::co_spawn(io, get(io, tls, std::move(parsed), bytes_max), asio::use_future);
        io.run();
        Fetched fetched = future.get();
        if (fetched.refused.empty()) return std::move(fetched.bytes);
        return Error{Code::Unavailable,
                     fmt::format("{}: cannot be fetched: {}", url, fetched.refused)};
    } catch (const boost::system::system_error& failed) {
        return Error{Code::Unavailable,
                     fmt::format("{}: cannot be fetched: {}", url, failed.code().message())};
    }
}

}  // namespace vagus::serve
