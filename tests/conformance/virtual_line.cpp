#include "virtual_line.hpp"

#include <algorithm>

namespace vagus::conformance {
namespace {

constexpr Duration kFrameTakes = std::chrono::microseconds(100);

Error pulled() {
    return Error{Code::Unavailable, "the cable was pulled"};
}

}  // namespace

VirtualLine::VirtualLine(aesl::Target target, Fault fault, uint16_t id) : fault_(std::move(fault)) {
    session::LiveNodeOptions options{.id = id};
    options.transmit = [this](const wire::Frame& frame) {
        if (!fault_.from_node) return arrived_.push_back(frame);
        for (const wire::Frame& changed : fault_.from_node(frame)) arrived_.push_back(changed);
    };
    node_ = std::move(session::LiveNode::make(std::move(target), std::move(options)).value());
}

Status VirtualLine::send(const wire::Frame& frame) {
    if (frames_left_ && (*frames_left_)-- <= 0) return pulled();
    now_ += kFrameTakes;
    if (!fault_.to_node) {
        node_->receive(frame);
        return Status::done();
    }
    for (const wire::Frame& changed : fault_.to_node(frame)) node_->receive(changed);
    return Status::done();
}

Result<std::optional<wire::Frame>> VirtualLine::receive(Time deadline) {
    if (frames_left_ && *frames_left_ < 0) return pulled();
    Time next = node_->step(now_);
    while (arrived_.empty() && now_ < deadline) {
        now_ = std::min(deadline, next);
        next = node_->step(now_);
    }
    if (arrived_.empty()) return std::optional<wire::Frame>{};
    const wire::Frame frame = arrived_.front();
    arrived_.pop_front();
    return std::optional<wire::Frame>(frame);
}

aesl::Target node_with(Memories memories) {
    aesl::Target target = session::standard_target("virtual");
    target.variables.push_back({"_program", 2});
    target.bytecode_size = memories.bytecode;
    target.stack_size = memories.stack;
    target.variables_size = memories.variables;
    return target;
}

Report examine_virtual(aesl::Target target, Fault fault, const std::string& only) {
    VirtualLine line(target, std::move(fault));
    return examine(line, {.node = 1, .nobody = 2, .only = only}, target);
}

std::string rows_with(const Report& report, Verdict verdict) {
    std::string text;
    for (const Row& row : report.rows) {
        if (row.verdict != verdict) continue;
        text += row.check.group + ": " + row.check.name + ": " + row.found + "\n";
    }
    return text;
}

bool failed(const Report& report, const std::string& name) {
    return std::ranges::any_of(report.rows, [&name](const Row& row) {
        return row.check.name == name && row.verdict == Verdict::Failed;
    });
}

}  // namespace vagus::conformance
