#include "serve/web/origin.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vagus::serve {

namespace {

std::string lower(std::string text) {
    for (char& letter : text) {
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    }
    return text;
}

std::string in_brackets(const std::string& address) {
    return address.find(':') == std::string::npos ? address : "[" + address + "]";
}

std::vector<std::string> allowed_hosts(const Asked& asked, const std::vector<std::string>& names) {
    std::vector<std::string> hosts = {in_brackets(asked.local_address)};
    if (is_loopback(asked.local_address)) hosts.emplace_back("localhost");
    for (const std::string& name : names) hosts.push_back(lower(name));
    std::vector<std::string> all;
    for (const std::string& host : hosts) {
        all.push_back(fmt::format("{}:{}", host, asked.port));
        if (asked.port == (asked.secure ? 443 : 80)) all.push_back(host);
    }
    return all;
}

}  // namespace

bool is_loopback(std::string_view address) {
    return address == "::1" || address.starts_with("127.");
}

std::optional<std::string> refusal_of(const Asked& asked, const std::vector<std::string>& names) {
    const std::vector<std::string> hosts = allowed_hosts(asked, names);
    const std::string host = lower(asked.host);
    if (std::find(hosts.begin(), hosts.end(), host) == hosts.end()) {
        return fmt::format(
            "Host “{:.100}” is not this server; open it by the address that it has printed, or "
            "name the host with --host",
            asked.host);
    }
    if (!asked.origin) return std::nullopt;
    if (lower(*asked.origin) == (asked.secure ? "https://" : "http://") + host) return std::nullopt;
    return fmt::format("Origin “{:.100}” is another page; only the studio's own may ask here",
                       *asked.origin);
}

}  // namespace vagus::serve
