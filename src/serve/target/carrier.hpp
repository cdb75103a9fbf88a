// What brings frames to and from the nodes of a target: a bus that others are on, or a simulation.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/time.hpp"
#include "wire/frame.hpp"

namespace vagus::serve {

// A link of the bus, as far as it can be seen from here.
struct LinkView {
    std::string name;
    std::vector<uint16_t> nodes;
    uint64_t frames_in = 0, frames_out = 0, lost = 0;
};

// A frame, and when it travelled by the clock of a simulation.
struct Carried {
    wire::Frame frame;
    std::optional<double> t = {};
};

// A flood of events must not keep a loop from what people say.
constexpr size_t kTakenAtOnce = 256;

enum class Connection { Connecting, Connected, Lost, Failed };

class Carrier {
public:
    virtual ~Carrier() = default;
    virtual void send(const wire::Frame& frame) = 0;
    // What came since; a carrier may keep what is behind the first kTakenAtOnce for the next time.
    virtual std::vector<Carried> take() = 0;
    // Frames that came from the nodes' side so far; who is on this side of the link, as a plan's
    // process that came by a door, does not count.
    virtual uint64_t heard() const = 0;
    virtual Connection connection() const = 0;
    // Why it is lost or failed: a sentence.
    virtual std::string why() const = 0;
    virtual std::vector<LinkView> links() const = 0;
};

}  // namespace vagus::serve
