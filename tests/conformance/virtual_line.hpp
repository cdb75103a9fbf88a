// A software node on a line in the same thread, with a clock that stands still unless somebody
// waits. What goes in and out can be changed on the way: so is a node made that has one fault.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "conformance/examine.hpp"
#include "session/live_node.hpp"
#include "session/standard_target.hpp"

namespace vagus::conformance {

// Gives the frames that arrive instead of this one: none, itself, another, several.
using Change = std::function<std::vector<wire::Frame>(const wire::Frame&)>;

struct Fault {
    Change to_node = {};
    Change from_node = {};
};

class VirtualLine : public Line {
public:
    explicit VirtualLine(aesl::Target target, Fault fault = {}, uint16_t id = 1);

    Status send(const wire::Frame& frame) override;
    Result<std::optional<wire::Frame>> receive(Time deadline) override;
    Time now() const override { return now_; }

    // After so many more frames to the node nothing goes in or out.
    void break_after(int frames) { frames_left_ = frames; }

private:
    Fault fault_;
    Time now_{};
    std::optional<int> frames_left_;
    std::deque<wire::Frame> arrived_;
    std::unique_ptr<session::LiveNode> node_;
};

// The node of `vagus node`, or one with other memories.
struct Memories {
    uint16_t bytecode = 512;
    uint16_t stack = 64;
    uint16_t variables = 1060;
};
aesl::Target node_with(Memories memories = {});

Report examine_virtual(aesl::Target target, Fault fault = {}, const std::string& only = "");
// "GROUP: NAME: what was found", a line each, of the rows with this verdict.
std::string rows_with(const Report& report, Verdict verdict);
bool failed(const Report& report, const std::string& name);

}  // namespace vagus::conformance
