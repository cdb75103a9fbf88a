// The column of figures beside the arena: the selected robot, its sensors and wheels, the variables
// of its script, the events on the bus.
#pragma once

#include "cli/screen/canvas.hpp"

namespace vagus::cli {

// What does not fit is left out from below; each list says how much is missing.
void draw_panel(Grid& grid, Area area, const View& view, const Look& look);

}  // namespace vagus::cli
