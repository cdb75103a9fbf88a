// One run, in a process of its own: a world, its nodes, its bus and a plan on one clock that is
// paced by the wall clock. It hears what to do, and tells all there is to see, over a socket pair;
// packets of kind J are JSON, F a frame of the bus, P poses, R rays, I a picture, H records for the
// history (serve/history/record.hpp). What it tells of F, P, R, I begins with the time, a double.
//
//     vagus run-host      (not for people: the studio starts it)
//
// Told:  { "do": "open", "order": N, "world": FILE, "plan": FILE?, "toolboxes": [], "set": {},
//          "robot": "", "bus": TARGET?, "project": FILE?, "poses": [[x, y, angle], …]?,
//          "from": ACTOR? }, then any of { "do": "pace", "paused": bool, "speed": X } ·
//          "step" { ms } · "plan.step" · "plan.stop" · "show" { "rays": bool,
//          "pictures": [robot, …] }, and with a "request": N "plan.set" "plan.change" { files }
//          "plan.check" { texts } "move" "put" "take" "press" "tap" "light"
// Tells: { "say": "opening", "order": N }, then "opened" { scene? } or "failed" { why } of that
//        order, "over" when a plan on a bus has ended · "clock" ten times a second, also when
//        paused · "scene" when it changes · "plan" · "trace" · "line" · "answer" { request, why,
//        reasons? }, one to each request
#pragma once

namespace vagus::serve {

// Until the other end closes. The exit status of the process.
int run_host();

}  // namespace vagus::serve
