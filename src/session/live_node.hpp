// A software node that lives in time: its timer, its program in a file, at most 1,000 instructions
// a millisecond. Told the time, like everything below `net`; `vagus node` is this and a socket.
//
//     auto made = session::LiveNode::make(target, {.id = 3, .flash = "three.abo", .transmit = …});
//     session::LiveNode& node = *made.value();
//     Time next = node.step(links.now());
//     for (;;) {
//         for (const wire::Frame& frame : arrived) node.receive(frame);  // what came until `next`
//         next = node.step(links.now());
//     }
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "aesl/target.hpp"
#include "base/result.hpp"
#include "base/time.hpp"
#include "session/software_node.hpp"
#include "wire/frame.hpp"

namespace vagus::session {

constexpr uint16_t kInstructionsAtOnce = 1000;
constexpr Duration kInstructionsEvery = std::chrono::milliseconds(1);

struct LiveNodeOptions {
    uint16_t id = 1;
    std::string flash = {};  // file of the saved program; empty: nothing is kept
    std::function<void(const wire::Frame&)> transmit = [](const wire::Frame&) {};
};

// The local event `timer`, every `timer.period` milliseconds: 0 or less is never (section 5.1,
// D18). Periods that have been missed are not made up for.
class NodeTimer {
public:
    // A new period counts from `now`; the same one changes nothing.
    void set_period(int16_t period_ms, Time now);
    // True, once, if the timer has run out.
    bool elapsed(Time now);
    // When it will run out; Time::max() if never.
    Time next() const { return next_; }

private:
    Duration period_{0};
    Time next_ = Time::max();
};

class LiveNode {
public:
    // The node tells which program it has: `_program` becomes the last variable of its description.
    // With a saved program the node starts it at once, in running mode, without a host. Fails as
    // SoftwareNode::make() does. A file that holds no program for this node costs the program, not
    // the node: it starts empty, and flash_trouble() says why.
    static Result<std::unique_ptr<LiveNode>> make(aesl::Target target, LiveNodeOptions options);

    // Answers, and then lets the script run, so that a burst of events is not one long chain of
    // killed handlers.
    void receive(const wire::Frame& frame);
    // Its breakpoints go with it.
    void host_left() { node_->host_left(); }
    // Does what is due at `now`; gives when there will be something to do, Time::max() for never.
    Time step(Time now);

    SoftwareNode& node() { return *node_; }
    // Why the saved program was not started; empty if nothing is wrong.
    const std::string& flash_trouble() const { return flash_trouble_; }

private:
    explicit LiveNode(std::string flash) : flash_(std::move(flash)) {}
    void start();
    void obey(vm::Notice notice);
    void save();
    void look_at_period(Time now);

    const std::string flash_;
    std::string flash_trouble_;
    std::unique_ptr<SoftwareNode> node_;
    NodeTimer timer_;
};

}  // namespace vagus::session
