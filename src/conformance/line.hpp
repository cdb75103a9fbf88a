// What an examination needs of the connection to a node: to send a frame, to wait for one until a
// time, and the time. `vagus conformance` gives it a socket or a serial line, a test gives it a
// node in the same thread and a clock that it moves itself.
#pragma once

#include <optional>

#include "base/result.hpp"
#include "base/time.hpp"
#include "wire/frame.hpp"

namespace vagus::conformance {

class Line {
public:
    virtual ~Line() = default;
    // Fails if the other side has gone.
    virtual Status send(const wire::Frame& frame) = 0;
    // The next frame from the bus; none if the deadline passes first. Fails if the other side has
    // gone.
    virtual Result<std::optional<wire::Frame>> receive(Time deadline) = 0;
    virtual Time now() const = 0;
};

}  // namespace vagus::conformance
