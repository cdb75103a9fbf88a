// A node in memory, made from a description: the node of `vagus node`, of `vagus exec`, and of
// tests. It has the memories that its Target asks for, finds the code of each native by its name,
// and talks through two callbacks.
//
//     const auto send = [&](const wire::Frame& frame) { hub.receive(own, frame); };
//     auto made = session::SoftwareNode::make(target, {.id = 3, .transmit = send});
//     if (!made.ok()) return complain(made.error());
//     session::SoftwareNode& node = *made.value();
//     node.receive(frame);
//     node.run(1000);
//
// It does not know: time, sockets, files.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/target.hpp"
#include "base/result.hpp"
#include "fastvm/run.hpp"
#include "node/frame_maker.hpp"
#include "node/node.hpp"
#include "wire/frame.hpp"

namespace vagus::session {

struct SoftwareNodeOptions {
    uint16_t id = 1;
    node::LocalEventSource local_event_source = node::LocalEventSource::Kept;
    // Called from inside receive(), run(), local_event() and start_program(); must not call them.
    std::function<void(const wire::Frame&)> transmit = [](const wire::Frame&) {};
    std::function<void(vm::Notice)> notify = [](vm::Notice) {};
};

struct VariableRange {
    uint16_t address = 0;
    uint16_t size = 0;
};

class SoftwareNode {
public:
    // Fails if a native has no code here (the 30 standard ones, sys.nop and sys.sum have) or other
    // parameters than its code, or if the variables do not fit the memory.
    static Result<std::unique_ptr<SoftwareNode>> make(aesl::Target target,
                                                      SoftwareNodeOptions options);
    SoftwareNode(const SoftwareNode&) = delete;
    SoftwareNode& operator=(const SoftwareNode&) = delete;

    // See node.hpp.
    void receive(const wire::Frame& frame) { node::receive(node_, frame); }
    void local_event(uint16_t index) { node::local_event(node_, index); }
    void start_program();
    uint16_t run(uint16_t limit) { return fastvm::run(node_.vm, bytecode_, limit); }
    void host_left() { node::host_left(node_); }
    // At most 255 bytes are sent.
    void report(const std::string& text) { node::report(node_, text.c_str()); }

    // Starts the handler of any event, without telling the bus. False if the program has none.
    bool start_event(uint16_t event) { return vm::start_event(node_.vm, event); }
    bool is_active() const { return vm::is_active(node_.vm); }
    // An event that run() would go on with.
    bool can_run() const { return is_active() && !vm::is_paused_in_event(node_.vm); }
    uint16_t pc() const { return node_.vm.pc; }

    const aesl::Target& target() const { return target_; }
    uint16_t id() const { return config_.id; }
    std::span<int16_t> variables() { return variables_; }
    std::span<const uint16_t> bytecode() const { return bytecode_.words(); }
    // Of the bytecode what was loaded; all of it if that is not known.
    std::span<const uint16_t> program() const;
    // Where the variable of that name in the description lies.
    std::optional<VariableRange> find_variable(std::string_view name) const;
    // Its place among the local events of the description.
    std::optional<uint16_t> find_local_event(std::string_view name) const;

    // Puts a program into the bytecode memory; the rest of the memory becomes 0. Does not start it.
    Status load(std::span<const uint16_t> program);

private:
    SoftwareNode(aesl::Target target, SoftwareNodeOptions options);
    Status describe();
    void notice(vm::Notice notice);

    const aesl::Target target_;
    const SoftwareNodeOptions options_;
    fastvm::Bytecode bytecode_;
    std::vector<int16_t> variables_;
    std::vector<int16_t> stack_;
    uint16_t breakpoints_[vm::kBreakpointsMax] = {};
    // The description: its texts are those of target_.
    std::vector<node::Variable> variable_list_;
    std::vector<node::LocalEvent> event_list_;
    std::vector<std::vector<node::Parameter>> parameter_lists_;
    std::vector<node::Native> native_list_;
    node::Description description_ = {};
    vm::Config config_ = {};
    node::Node node_ = {};
    uint16_t loaded_ = 0;  // words, by load()
    node::FrameMaker maker_;
};

}  // namespace vagus::session
