#include "serve/web/tls.hpp"

#include <fmt/format.h>

#include <boost/asio/buffer.hpp>

#include "base/file.hpp"

namespace vagus::serve {

namespace ssl = boost::asio::ssl;

Result<ssl::context> tls_context(const std::string& certificate_file, const std::string& key_file) {
    const std::string certificate = TRY(read_file(certificate_file));
    const std::string key = TRY(read_file(key_file));
    ssl::context context(ssl::context::tls_server);
    boost::system::error_code failed;
    context.set_options(
        ssl::context::default_workarounds | ssl::context::no_tlsv1 | ssl::context::no_tlsv1_1,
        failed);
    context.use_certificate_chain(boost::asio::buffer(certificate), failed);
    if (failed) {
        return Error{Code::BadInput, fmt::format("{}: expected a certificate in PEM form: {}",
                                                 certificate_file, failed.message())};
    }
    context.use_private_key(boost::asio::buffer(key), ssl::context::pem, failed);
    if (failed) {
        return Error{Code::BadInput,
                     fmt::format("{}: expected the private key of {} in PEM form: {}", key_file,
                                 certificate_file, failed.message())};
    }
    return context;
}

}  // namespace vagus::serve
