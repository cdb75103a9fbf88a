// One run, in a process of its own: a world, its nodes, its bus and a plan on one clock that is
// paced by the wall clock. It hears what to do, and tells all there is to see, over a socket pair;
// packets of kind J are JSON, F a frame of the bus, P poses, R rays, I a picture.
//
//     vagus run-host      (not for people: the studio starts it)
//
// Told:  { "do": "open", "world": FILE, "plan": FILE?, "toolboxes": [], "set": {}, "robot": "",
//          "poses": [[x, y, angle], …]? }, then any of
//        { "do": "pace", "paused": bool, "speed": X } · "step" { ms } · "plan.step" · "plan.stop" ·
//        "move" "put" "take" "press" "tap" "light" · "show" { "rays": bool, "picture": "robot" }
// Tells: { "say": "opened", "scene": … } or { "say": "failed", "why": … } · "clock" ten times a
//        second, also when paused · "scene" when it changes · "plan" · "trace" · "line" ·
//        "loaded" { node, path, source }
#pragma once

namespace vagus::serve {

// Until the other end closes. The exit status of the process.
int run_host();

}  // namespace vagus::serve
