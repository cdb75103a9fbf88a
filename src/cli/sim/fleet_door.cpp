#include "cli/sim/fleet_door.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/shell_word.hpp"
#include "fleet/topic.hpp"
#include "net/wall_clock.hpp"
#include "serve/broker/mosquitto_link.hpp"

namespace vagus::cli {
namespace {

// Each robot has a login of its own, for it may write below its own name alone.
Result<std::unique_ptr<fleet::Link>> connect(serve::FleetOptions broker, const std::string& logins,
                                             const fleet::MemberOptions& member, fleet::Post will) {
    if (!logins.empty()) {
        const std::string file = fleet::escape(member.robot) + ".login";
        broker.login = (std::filesystem::path(logins) / file).string();
        if (!std::filesystem::exists(broker.login)) {
            return Error{Code::NotFound,
                         fmt::format("{}: there is no such login; `vagus fleet init {} --robot {}` "
                                     "makes it (t1..t30: thirty of them)",
                                     broker.login, shell_word(logins), member.robot)};
        }
    }
    serve::LinkOptions link =
        TRY(serve::link_options(broker, member.robot + "-" + member.instance));
    link.target.fleet = member.fleet;
    link.will = std::move(will);
    // The world polls its links at each instant, so nothing has to be woken.
    return std::unique_ptr<fleet::Link>(
        std::make_unique<serve::MosquittoLink>(std::move(link), [] {}));
}

}  // namespace

Result<std::optional<session::WorldFleet::Door>> door_to_fleet(const SimRunOptions& options) {
    if (options.fleet.target.empty()) return std::optional<session::WorldFleet::Door>();
    const fleet::FleetTarget target = TRY(fleet::parse_fleet_target(options.fleet.target));
    const auto way = [broker = options.fleet, logins = options.logins](
                         const fleet::MemberOptions& member, fleet::Post will) {
        return connect(broker, logins, member, std::move(will));
    };
    return std::optional(session::WorldFleet::Door{.fleet = target.fleet,
                                                   .instance_and_epoch = serve::member_identity,
                                                   .connect = way,
                                                   .now = net::wall_now});
}

}  // namespace vagus::cli
