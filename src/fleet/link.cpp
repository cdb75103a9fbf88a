#include "fleet/link.hpp"

#include <utility>

namespace vagus::fleet {

std::optional<LinkEvent> event_of(std::string_view fleet, std::string_view topic,
                                  std::string_view payload, bool retained) {
    if (payload.empty()) {
        auto known = parse_topic(fleet, topic);
        if (!known) return std::nullopt;
        return TakenBack{std::move(*known)};
    }
    auto heard = read(fleet, topic, payload);
    if (heard.ok()) return Received{std::move(heard.value()), retained};
    if (heard.error().code == Code::NotFound) return std::nullopt;
    return Malformed{heard.error().what};
}

}  // namespace vagus::fleet
