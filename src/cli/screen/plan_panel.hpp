// The column of figures beside the arena when a plan runs: its actors, who watches, its variables,
// what happened last, the load of the bus.
#pragma once

#include "cli/screen/canvas.hpp"

namespace vagus::cli {

// What does not fit is left out; each list has its share of the height.
void draw_plan_panel(Grid& grid, Area area, const View& view, const Look& look);

}  // namespace vagus::cli
