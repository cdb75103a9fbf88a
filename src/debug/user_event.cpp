#include "debug/user_event.hpp"

#include "wire/reports.hpp"

namespace vagus::debug {

UserEvent user_event_of(const wire::Frame& frame, const aesl::CommonDefinitions& common) {
    UserEvent event;
    event.number = frame.type;
    if (frame.type < common.events.size()) event.name = common.events[frame.type].name;
    event.arguments = wire::arguments_of<std::vector<int16_t>>(frame);
    return event;
}

std::string name_or_number(const UserEvent& event) {
    return event.name.empty() ? std::to_string(event.number) : event.name;
}

}  // namespace vagus::debug
