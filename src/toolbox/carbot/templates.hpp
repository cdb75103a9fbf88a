// Carbot's templates that are written in C++: what needs more than one answer of its nodes.
#pragma once

#include <vector>

#include "run/code.hpp"
#include "toolbox/parts.hpp"

namespace vagus::toolbox {

// All of them; the parts are borrowed by their code.
std::vector<run::Coded> carbot_templates(const Parts& parts);

namespace carbot {

run::Coded look_around(const Parts& parts);
run::Coded search_wall(const Parts& parts);
run::Coded wall_forward(const Parts& parts);
run::Coded navigate_to(const Parts& parts);
run::Coded find_object(const Parts& parts);
run::Coded follow_object(const Parts& parts);
run::Coded find_infrared(const Parts& parts);
run::Coded read_colour(const Parts& parts);

}  // namespace carbot
}  // namespace vagus::toolbox
