// The top view of the world.
#pragma once

#include "cli/screen/canvas.hpp"

namespace vagus::cli {

// Floor, things, trails, sensor rays, robots with the direction in which they look.
void draw_arena(Grid& grid, Area area, const View& view, const Look& look);

}  // namespace vagus::cli
