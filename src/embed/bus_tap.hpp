// Who follows a run on a bus: each frame, what the plan hears and does, in their order.
//
//     class Counting final : public BusTap { … } tap;
//     prepared.tap(&tap);                     // before run()
//     (void)prepared.run();
//     prepared.tap(nullptr);
//
// None of these may wait: a robot is driven meanwhile.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "aesl/target.hpp"
#include "base/time.hpp"
#include "debug/network.hpp"
#include "run/code.hpp"
#include "toolbox/bus.hpp"
#include "wire/frame.hpp"

namespace vagus::embed {

class BusTap {
public:
    virtual ~BusTap() = default;

    // ---- first, on the thread that calls tap() ----
    // The clock is a steady one, which can be asked from any thread until tap(nullptr).
    virtual void begin(const aesl::CommonDefinitions& common, std::function<Time()> clock) = 0;

    // ---- on the thread of the bus; of the nodes that are there already, with begin() ----
    virtual void described(const debug::NodeView& node) = 0;
    virtual void happened(const debug::Event& event) = 0;  // all that the network has to tell
    virtual void node(const std::string& name, toolbox::BusNodes::Change change) = 0;
    // As it comes or goes. With `sent` it is an event of the plan: by whom, and after which frame.
    // Gives its number, from 1 on.
    virtual uint32_t frame(const wire::Frame& frame, const run::BusEvent* sent) = 0;
    // The tokens of the run count from this one; the first time on the deciding thread.
    virtual void tokens(uint16_t first) = 0;
    // The run is ended with an error.
    virtual void fails(const std::string& why) = 0;

    // ---- on the deciding thread ----
    virtual void hears(const run::BusEvent& event, Time at) = 0;

    // ---- on any thread ----
    virtual void aborts(const std::string& by) = 0;
};

}  // namespace vagus::embed
