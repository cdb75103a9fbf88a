#include "fleet/target.hpp"

#include <fmt/format.h>

#include "base/text.hpp"
#include "fleet/topic.hpp"

namespace vagus::fleet {
namespace {

constexpr std::string_view kPlain = "mqtt://";
constexpr std::string_view kSecure = "mqtts://";

}  // namespace

Result<FleetTarget> parse_fleet_target(std::string_view text) {
    const auto refuse = [text](const std::string& why) {
        return Error{Code::BadInput,
                     fmt::format("\"{}\": {}; write mqtt://HOST[:PORT]/FLEET, or mqtts:// for TLS",
                                 visible(text), why)};
    };
    FleetTarget target;
    std::string_view rest = text;
    target.tls = rest.starts_with(kSecure);
    if (!target.tls && !rest.starts_with(kPlain)) return refuse("this is no fleet");
    rest.remove_prefix(target.tls ? kSecure.size() : kPlain.size());
    target.port = target.tls ? kMqttsPort : kMqttPort;
    const size_t slash = rest.find('/');
    if (slash != rest.npos && slash + 1 < rest.size()) {
        const auto fleet = unescape(rest.substr(slash + 1));
        if (!fleet) return refuse("the name of the fleet is none");
        target.fleet = *fleet;
    }
    rest = rest.substr(0, slash);
    const size_t bracket = rest.starts_with('[') ? rest.find(']') : rest.npos;
    const size_t colon = rest.find(':', bracket == rest.npos ? 0 : bracket);
    if (colon != rest.npos) {
        const auto port = decimal_number(rest.substr(colon + 1));
        if (!port || *port == 0 || *port > UINT16_MAX)
            return refuse("the port is no number from 1 to 65535");
        target.port = static_cast<uint16_t>(*port);
    }
    target.host = rest.substr(0, colon);
    if (bracket != rest.npos) target.host = rest.substr(1, bracket - 1);
    if (target.host.empty()) return refuse("it names no host");
    return target;
}

std::string to_string(const FleetTarget& target) {
    const bool v6 = target.host.find(':') != std::string::npos;
    return fmt::format("{}{}{}{}:{}{}{}", target.tls ? kSecure : kPlain, v6 ? "[" : "", target.host,
                       v6 ? "]" : "", target.port, target.fleet.empty() ? "" : "/",
                       escape(target.fleet));
}

Result<Login> read_login(std::string_view text, const std::string& file) {
    std::vector<std::string_view> lines = split(text, '\n');
    while (!lines.empty() && lines.back().empty()) lines.pop_back();
    if (lines.size() == 2 && !lines[0].empty() && !lines[1].empty()) {
        return Login{std::string(lines[0]), std::string(lines[1])};
    }
    return Error{
        Code::BadInput,
        fmt::format("{}: expected two lines, a user and a password, found {}", file, lines.size())};
}

}  // namespace vagus::fleet
