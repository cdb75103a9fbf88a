#include "toolbox/carbot/templates.hpp"

namespace vagus::toolbox {

std::vector<run::Coded> carbot_templates(const Parts& parts) {
    return {carbot::look_around(parts),   carbot::search_wall(parts), carbot::wall_forward(parts),
            carbot::navigate_to(parts),   carbot::find_object(parts), carbot::follow_object(parts),
            carbot::find_infrared(parts), carbot::read_colour(parts)};
}

}  // namespace vagus::toolbox
