#include "serve/web/stream.hpp"

#include <openssl/ssl.h>
#include <openssl/x509_vfy.h>

#include <boost/asio/redirect_error.hpp>
#include <boost/asio/ssl/context.hpp>
#include <boost/asio/ssl/host_name_verification.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <boost/beast/core/detect_ssl.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/ssl/ssl_stream.hpp>
#include <boost/beast/websocket/ssl.hpp>
#include <boost/beast/websocket/teardown.hpp>

namespace vagus::serve {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::awaitable;
using asio::use_awaitable;

namespace {

using Secure = beast::ssl_stream<beast::tcp_stream>;

template <typename Carrier>
class LayerOf final : public Stream::Layer {
public:
    explicit LayerOf(Carrier carrier) : carrier_(std::move(carrier)) {}

    Carrier& carrier() { return carrier_; }
    beast::tcp_stream& tcp() override { return beast::get_lowest_layer(carrier_); }
    void read(asio::mutable_buffer into, Stream::Done done) override {
        carrier_.async_read_some(into, std::move(done));
    }
    void write(const Stream::Pieces& pieces, Stream::Done done) override {
        carrier_.async_write_some(pieces, std::move(done));
    }
    void tear_down(beast::role_type role, Stream::Done done) override {
        using beast::websocket::async_teardown;
        async_teardown(role, carrier_,
                       [done = std::move(done)](SystemError failed) { done(failed, 0); });
    }

private:
    Carrier carrier_;
};

// What OpenSSL found of a certificate, and how to fix it.
std::string why_not_accepted(long found, const std::string& host) {
    std::string why = "its certificate is not accepted: ";
    switch (found) {
        case X509_V_ERR_UNSPECIFIED:  // what the check of the name gives
            return why + "it is not for the name " + host + "; name one that is";
        case X509_V_ERR_CERT_HAS_EXPIRED:
        case X509_V_ERR_CERT_NOT_YET_VALID:
            return why + X509_verify_cert_error_string(found) +
                   "; make another one, or set the clock of the computer that reads it";
        default:
            return why + X509_verify_cert_error_string(found) +
                   "; name who signed it, as --tls-ca ca.crt or --tls-cert robot.crt";
    }
}

using PlainLayer = LayerOf<beast::tcp_stream>;
using SecureLayer = LayerOf<Secure>;

}  // namespace

Stream::Stream(beast::tcp_stream tcp) : layer_(std::make_unique<PlainLayer>(std::move(tcp))) {}

awaitable<TlsBegins> Stream::accept_tls(asio::ssl::context& context) {
    beast::flat_buffer begun;
    beast::tcp_stream& tcp = layer_->tcp();
    try {
        if (!co_await beast::async_detect_ssl(tcp, begun, use_awaitable)) {
            co_return TlsBegins::Plain;
        }
        auto secure = std::make_unique<SecureLayer>(Secure(std::move(tcp), context));
        co_await secure->carrier().async_handshake(asio::ssl::stream_base::server, begun.data(),
                                                   use_awaitable);
        layer_ = std::move(secure);
        co_return TlsBegins::Yes;
    } catch (const boost::system::system_error&) {
        co_return TlsBegins::Lost;
    }
}

awaitable<std::optional<std::string>> Stream::connect_tls(asio::ssl::context& context,
                                                          std::string host) {
    auto secure = std::make_unique<SecureLayer>(Secure(std::move(layer_->tcp()), context));
    secure->carrier().set_verify_callback(asio::ssl::host_name_verification(host));
    SSL_set_tlsext_host_name(secure->carrier().native_handle(), host.c_str());
    SystemError failed;
    co_await secure->carrier().async_handshake(asio::ssl::stream_base::client,
                                               asio::redirect_error(use_awaitable, failed));
    if (failed) {
        const long found = SSL_get_verify_result(secure->carrier().native_handle());
        if (found != X509_V_OK) co_return why_not_accepted(found, host);
        throw boost::system::system_error(failed);
    }
    layer_ = std::move(secure);
    co_return std::nullopt;
}

void Stream::shut_down_sending() {
    SystemError ignored;
    layer_->tcp().socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
}

}  // namespace vagus::serve
