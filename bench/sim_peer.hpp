// The simulator beside its peer, libenki.
#pragma once

// Prints microseconds a robot and step of both, and the ratio.
void compare_with_peer();
