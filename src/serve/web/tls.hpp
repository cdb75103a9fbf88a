// What the studio is to others by TLS: its certificate and key, and which versions it speaks.
#pragma once

#include <boost/asio/ssl/context.hpp>
#include <string>

#include "base/result.hpp"

namespace vagus::serve {

// From PEM files. The Error names the file that does not fit.
Result<boost::asio::ssl::context> tls_context(const std::string& certificate_file,
                                              const std::string& key_file);

}  // namespace vagus::serve
