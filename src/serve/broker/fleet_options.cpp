#include "serve/broker/fleet_options.hpp"

#include "base/file.hpp"
#include "base/text.hpp"
#include "serve/process.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kNameBytes = 6;
constexpr size_t kInstanceBytes = 8;

}  // namespace

std::string robot_name(const FleetOptions& options) {
    return options.robot.empty() ? host_name() : options.robot;
}

Result<LinkOptions> link_options(const FleetOptions& options, const std::string& client) {
    LinkOptions link{.target = TRY(fleet::parse_fleet_target(options.target)), .client = client};
    for (const std::string& file : {options.ca, options.certificate, options.key}) {
        if (!file.empty()) (void)TRY(read_file(file));
    }
    link.ca = options.ca;
    link.certificate = options.certificate;
    link.key = options.key;
    if (options.login.empty()) return link;
    const std::string login = TRY(read_file(options.login));
    link.login = TRY(fleet::read_login(login, options.login));
    return link;
}

Result<LinkOptions> link_of_fleet(const FleetOptions& options, const std::string& client) {
    LinkOptions link = TRY(link_options(options, client));
    if (link.target.fleet.empty()) {
        return Error{Code::BadInput,
                     options.target + ": which fleet? Write mqtt://HOST[:PORT]/FLEET"};
    }
    return link;
}

std::string operator_name() {
    return "operator-" + hex_of(random_bytes(kNameBytes));
}

std::pair<std::string, int64_t> member_identity() {
    return {hex_of(random_bytes(kInstanceBytes)), random_number()};
}

}  // namespace vagus::serve
