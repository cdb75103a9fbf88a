#include "session/live_node.hpp"

#include <algorithm>

#include "session/stored_program.hpp"

namespace vagus::session {

void NodeTimer::set_period(int16_t period_ms, Time now) {
    const Duration period = std::chrono::milliseconds(std::max<int16_t>(period_ms, 0));
    if (period == period_) return;
    period_ = period;
    next_ = period_ > Duration(0) ? now + period_ : Time::max();
}

bool NodeTimer::elapsed(Time now) {
    if (now < next_) return false;
    next_ += period_;
    if (next_ <= now) next_ = now + period_;
    return true;
}

namespace {

// Behind all other variables, unless its words would not find room there.
void describe_program(aesl::Target& target) {
    const auto is_named = [](const aesl::NamedVariable& one) { return one.name == "_program"; };
    if (std::ranges::any_of(target.variables, is_named)) return;
    size_t words = 2;
    for (const aesl::NamedVariable& variable : target.variables) words += variable.size;
    if (words <= target.variables_size) target.variables.push_back({"_program", 2});
}

}  // namespace

Result<std::unique_ptr<LiveNode>> LiveNode::make(aesl::Target target, LiveNodeOptions options) {
    // The constructor is private, and the node must not move: its callbacks point to it.
    describe_program(target);
    std::unique_ptr<LiveNode> live(new LiveNode(std::move(options.flash)));
    SoftwareNodeOptions inner;
    inner.id = options.id;
    inner.transmit = std::move(options.transmit);
    inner.notify = [raw = live.get()](vm::Notice notice) { raw->obey(notice); };
    live->node_ = TRY(SoftwareNode::make(std::move(target), std::move(inner)));
    live->start();
    return live;
}

void LiveNode::start() {
    for (const char* name : {"id", "_id"}) {
        const auto place = node_->find_variable(name);
        if (place) node_->variables()[place->address] = static_cast<int16_t>(node_->id());
    }
    if (flash_.empty()) return;
    const Result<Stored> stored = load_stored_program(*node_, flash_);
    if (!stored.ok()) {
        flash_trouble_ = stored.error().what +
                         "; the node starts without a program, and the next "
                         "one that is saved replaces the file";
    } else if (stored.value() == Stored::Loaded) {
        node_->start_program();
    }
}

void LiveNode::receive(const wire::Frame& frame) {
    node_->receive(frame);
    node_->run(kInstructionsAtOnce);
}

Time LiveNode::step(Time now) {
    look_at_period(now);
    if (timer_.elapsed(now)) node_->local_event(*node_->find_local_event("timer"));
    node_->run(kInstructionsAtOnce);
    look_at_period(now);  // the script may have set a new one
    return node_->can_run() ? std::min(now + kInstructionsEvery, timer_.next()) : timer_.next();
}

// A node has the timer if its description has both the event and the variable.
void LiveNode::look_at_period(Time now) {
    const auto place = node_->find_variable("timer.period");
    if (!place || !node_->find_local_event("timer")) return;
    timer_.set_period(node_->variables()[place->address], now);
}

// A desktop node has no boot loader, and nothing to save by sleeping.
void LiveNode::obey(vm::Notice notice) {
    if (notice == vm::Notice::WriteBytecode) save();
}

// The words of success are those that hosts know from robots (section 2.3).
void LiveNode::save() {
    if (flash_.empty())
        return node_->report("Flashing failed: this node was started without --flash");
    const Status stored = store_program(*node_, flash_);
    node_->report(stored.ok() ? "Flashing OK" : "Flashing failed: " + stored.error().what);
}

}  // namespace vagus::session
