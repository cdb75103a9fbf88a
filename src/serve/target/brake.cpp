// A live robot brakes as a whole: where one node is paused, is lost or gets another program, a
// reflex is missing. The nodes that move are paused and made safe; those that only sense go on, so
// that one can look at them. What they did before is not taken up by itself: Run lets exactly those
// run that were paused here.
//
// A world whose clock stops with a breakpoint needs none of this.
#include <algorithm>

#include "session/brake.hpp"

#include "serve/target/target.hpp"

namespace vagus::serve {

bool Target::moves(uint16_t node) const {
    const debug::NodeView* view = network_ ? network_->node(node) : nullptr;
    return view && session::moves(*view, safe_stop_);
}

void Target::make_safe(uint16_t node) {
    const auto found = safe_stop_.find(described_name(node));
    if (found == safe_stop_.end()) return;
    for (const auto& [name, values] : found->second.set) {
        const auto range = network_->variable(node, name);
        if (range.ok()) (void)network_->write(node, range.value(), values).ok();
    }
}

void Target::make_safe(std::function<void(const StopReport&)> done) {
    if (!network_) return done({});
    using How = session::Stopping::How;
    std::vector<debug::NodeId> nodes;
    for (const debug::NodeId node : network_->nodes()) {
        if (moves(node)) nodes.push_back(node);
    }
    const session::Stopping::Manner manner{.how = How::Rest,
                                           .until = session::Stopping::Until::Forgotten,
                                           .link = state() == Connection::Connected};
    resting_.begin(*network_, safe_stop_, manner, now_, nodes);
    rest_until_ = now_ + kRestWithin;
    rested_ = std::move(done);
    rests_ = true;
}

void Target::end_rest() {
    resting_.end();
    rested_ = nullptr;
}

// Who moves by then does so by a script of its own; who did not answer is asked on.
void Target::tick_rest(Time now) {
    const bool over = now >= rest_until_;
    if (over) resting_.let_move();
    resting_.tick(now);
    if (!rested_ || !(over || resting_.settled())) return;
    if (!resting_.settled()) resting_.note_silence();
    std::exchange(rested_, nullptr)({resting_.nodes()});
}

// As it is now, for as long as nobody lets the nodes run; empty while nobody has been told yet.
StopReport Target::stop_report() const {
    if (!rests_) return stopping_.report();
    return rested_ ? StopReport() : StopReport{resting_.nodes()};
}

void Target::note_move() {
    moved_ = true;
    quiet_ = false;
}

void Target::will_move() {
    end_rest();
    note_move();
}

// Outputs stay closed until Run, also where nothing else is paused: the node of a real robot keeps
// what the line has set, although its script does not run.
void Target::after_step(uint16_t node) {
    const debug::NodeView* const view = network_->node(node);
    if (live() && view && view->state != debug::ProgramState::Running) make_safe(node);
}

// A host that has only looked so far does not interfere.
void Target::brake(uint16_t cause) {
    if (!live() || !in_charge_) return;
    braked_.erase(cause);
    brake_causes_.insert(cause);
    for (const uint16_t node : live_nodes()) {
        if (!moves(node)) continue;
        if (node != cause) brake_one(node);
        make_safe(node);
    }
    desk_.topics().touch("robot");
}

// One that somebody else has to let run again is left to him. One that is being loaded stands until
// then: it gets the rest of its program, since half of one helps nobody, and is not let run.
void Target::brake_one(uint16_t node) {
    if (braked_.contains(node)) return;
    Known& known = known_[node];
    const bool loading = known.busy == "loading";
    const bool running = network_->node(node)->state == debug::ProgramState::Running;
    const bool left = brake_causes_.contains(node) && !known.busy.empty() && !loading;
    if (left || (known.busy != "starting" && !loading && !running)) return;
    braked_.insert(node);
    known.why = "robot";
    if (loading && network_->stay_after_load(node)) return;
    known.braking = network_->pause_now(node);
}

// A node that moves gets its pause before everything else: what makes it safe is behind that, for
// its script would write over it.
Result<debug::RequestId> Target::pause(uint16_t node) {
    in_charge_ = true;
    known_[node].held = true;
    const bool now = live() && moves(node);
    const auto at_once = now ? network_->pause_now(node) : std::nullopt;
    auto asked = at_once ? Result<debug::RequestId>(*at_once) : network_->pause(node);
    brake(node);
    return asked;
}

Result<debug::RequestId> Target::reset(uint16_t node) {
    in_charge_ = true;
    known_[node].held = true;
    if (live() && moves(node)) (void)network_->stop_now(node);
    auto asked = network_->reset(node);
    brake(node);
    return asked;
}

void Target::release(uint16_t cause) {
    if (brake_causes_.erase(cause) == 0 || !brake_causes_.empty()) return;
    release_all();
}

void Target::release_all() {
    brake_causes_.clear();
    if (!braked_.empty()) note_move();
    for (const uint16_t node : std::exchange(braked_, {})) {
        if (network_) (void)network_->run(node).ok();
    }
    desk_.topics().touch("robot");
}

// ---- who debugs: a plan waits for that ----

// One that said that it runs just before it was paused is not let go by that.
void Target::note_held(uint16_t node, const debug::StateChanged& state) {
    Known& known = known_[node];
    const bool is_told_to_stand = known.busy == "pausing" || known.busy == "restarting";
    if (state.at_breakpoint) known.held = true;
    if (state.state == debug::ProgramState::Running && !is_told_to_stand) known.held = false;
}

bool Target::is_held(uint16_t node) const {
    const auto known = known_.find(node);
    if (known == known_.end()) return false;
    return known->second.held || known->second.busy == "loading";
}

std::vector<uint16_t> Target::held_nodes() const {
    const bool braked = std::any_of(brake_causes_.begin(), brake_causes_.end(),
                                    [this](uint16_t cause) { return is_held(cause); });
    std::vector<uint16_t> held;
    for (const auto& [node, known] : known_) {
        if (is_held(node) || (braked && braked_.contains(node))) held.push_back(node);
    }
    return held;
}

}  // namespace vagus::serve
