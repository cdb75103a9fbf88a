// What became of a node that was told to stop.
#pragma once

#include <cstdint>
#include <string>

namespace vagus::session {

struct StopNode {
    enum class State {
        Asked,    // nothing more is known: it may not even have told its name
        Stopped,  // read back
        Moving,   // it answered; what was read is not at rest
        Silent,   // it did not answer
        Gone,     // it is not there any more, or was away before it was asked
    };
    uint16_t node = 0;
    std::string name;
    State state = State::Asked;
};

}  // namespace vagus::session
