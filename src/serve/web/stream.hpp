// A connection, plain or over TLS, as one type: what Boost.Beast makes of a stream is compiled once
// for both, and what TLS is made of, in stream.cpp alone.
//
//     Stream stream(boost::beast::tcp_stream(std::move(tcp)));
//     if (co_await stream.accept_tls(context) != TlsBegins::Yes) co_return;
//     websocket::stream<Stream> socket(std::move(stream));
//
// For one thread: what waits is called by the thread of the executor of the connection.
#pragma once

#include <array>
#include <boost/asio/async_result.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/buffer.hpp>
#include <boost/beast/core/role.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace boost::asio::ssl {
class context;
}

namespace vagus::serve {

using SystemError = boost::system::error_code;

// What a client says first on a port for TLS.
enum class TlsBegins { Yes, Plain, Lost };

class Stream {
public:
    using Done = std::function<void(SystemError, size_t)>;
    using executor_type = boost::beast::tcp_stream::executor_type;
    // What one call writes at most; the caller comes again for the rest.
    using Pieces = std::array<boost::asio::const_buffer, 4>;

    // What carries the bytes.
    class Layer {
    public:
        virtual ~Layer() = default;
        virtual boost::beast::tcp_stream& tcp() = 0;
        virtual void read(boost::asio::mutable_buffer into, Done done) = 0;
        virtual void write(const Pieces& pieces, Done done) = 0;
        virtual void tear_down(boost::beast::role_type role, Done done) = 0;
    };

    explicit Stream(boost::beast::tcp_stream tcp);

    // Meets a client on a port for TLS. Plain: it speaks without, and can be answered; Lost: it has
    // gone, or there was no agreement.
    boost::asio::awaitable<TlsBegins> accept_tls(boost::asio::ssl::context& context);
    // Speaks TLS to the server `host` from now on; else why its certificate is not accepted. Throws
    // boost::system::system_error where it is something else.
    boost::asio::awaitable<std::optional<std::string>> connect_tls(
        boost::asio::ssl::context& context, std::string host);

    // The limit of what is asked for from now on.
    void expires_after(std::chrono::nanoseconds time) { layer_->tcp().expires_after(time); }
    void expires_never() { layer_->tcp().expires_never(); }
    // Says that nothing more comes from here.
    void shut_down_sending();
    void close() { layer_->tcp().close(); }

    // ---- what Boost.Asio calls an AsyncStream ----
    executor_type get_executor() { return layer_->tcp().get_executor(); }

    template <typename Buffers, typename Token>
    auto async_read_some(const Buffers& into, Token&& token) {
        return boost::asio::async_initiate<Token, void(SystemError, size_t)>(
            [this](auto handler, boost::asio::mutable_buffer first) {
                layer_->read(first, erased(std::move(handler)));
            },
            token, first_of(into));
    }

    template <typename Buffers, typename Token>
    auto async_write_some(const Buffers& from, Token&& token) {
        return boost::asio::async_initiate<Token, void(SystemError, size_t)>(
            [this](auto handler, const Pieces& pieces) {
                layer_->write(pieces, erased(std::move(handler)));
            },
            token, pieces_of(from));
    }

    // Boost.Beast finds these by their names.
    template <typename Handler>
    friend void async_teardown(boost::beast::role_type role, Stream& stream, Handler&& handler) {
        const auto held = std::make_shared<std::decay_t<Handler>>(std::forward<Handler>(handler));
        stream.layer_->tear_down(role, [held](SystemError failed, size_t) { (*held)(failed); });
    }
    friend void beast_close_socket(Stream& stream) { stream.close(); }

private:
    template <typename Handler>
    static Done erased(Handler handler) {
        const auto held = std::make_shared<Handler>(std::move(handler));
        return [held](SystemError failed, size_t size) { (*held)(failed, size); };
    }

    template <typename Buffers>
    static boost::asio::mutable_buffer first_of(const Buffers& buffers) {
        const auto end = boost::asio::buffer_sequence_end(buffers);
        for (auto at = boost::asio::buffer_sequence_begin(buffers); at != end; ++at) {
            if (boost::asio::mutable_buffer buffer = *at; buffer.size() > 0) return buffer;
        }
        return {};
    }

    template <typename Buffers>
    static Pieces pieces_of(const Buffers& buffers) {
        Pieces pieces;
        size_t count = 0;
        const auto end = boost::asio::buffer_sequence_end(buffers);
        for (auto at = boost::asio::buffer_sequence_begin(buffers);
             at != end && count < pieces.size(); ++at) {
            if (boost::asio::const_buffer buffer = *at; buffer.size() > 0) pieces[count++] = buffer;
        }
        return pieces;
    }

    std::unique_ptr<Layer> layer_;
};

}  // namespace vagus::serve
