// Whether a request means this server: Host against names that only pretend to be this machine (DNS
// rebinding), Origin against other pages in the same browser.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vagus::serve {

// An address of this computer that no other one reaches: 127.0.0.1, ::1.
bool is_loopback(std::string_view address);

struct Asked {
    std::string host;                   // the header, "localhost:8080"; empty: missing
    std::optional<std::string> origin;  // the header
    std::string local_address;          // of the connection at our end: "127.0.0.1"
    uint16_t port = 0;                  // the same
    bool secure = false;                // HTTPS
};

// A sentence if it is refused. Host may be the address of the connection, localhost on a loopback
// one, or one of `names`; with the port, which may be missing if it is the usual one. A request
// without Origin comes from no page; with one it must be this very server.
std::optional<std::string> refusal_of(const Asked& asked, const std::vector<std::string>& names);

}  // namespace vagus::serve
