#include "serve/target/target.hpp"

#include "base/time.hpp"
#include "serve/json.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vagus::serve {

namespace {

std::vector<std::string> sentences(const std::vector<std::pair<uint16_t, std::string>>& failed) {
    std::vector<std::string> list;
    for (const auto& [node, why] : failed) list.push_back(fmt::format("node {}: {}", node, why));
    return list;
}

}  // namespace

Json Target::Batch::failures() const {
    Json list = Json::array();
    for (const auto& [node, why] : failed) list.push_back({{"node", node}, {"why", why}});
    return list;
}

Json Target::Batch::answers() const {
    Json list = Json::array();
    for (const auto& [node, what] : notes) list.push_back({{"node", node}, {"what", what}});
    return list;
}

Target::Target(Desk& desk, Files& files, Scripts& scripts, ScriptBreakpoints& breakpoints)
    : desk_(desk), files_(files), scripts_(scripts), breakpoints_(breakpoints) {
    safe_stop_ = session::shipped_safe_stop();
    declare_topics();
    declare_commands();
}

Target::~Target() = default;

// ---- the target ----

void Target::connect(Carrier& carrier, const std::string& target, const std::string& name,
                     const std::string& kind, Time now) {
    disconnect();
    carrier_ = &carrier;
    target_ = target;
    name_ = name;
    kind_ = kind;
    now_ = due_ = looked_at_ = now;
    heard_ = carrier.heard();
    connection_ = Connection::Connecting;
    network_ = std::make_unique<debug::Network>();
    name_events();
    desk_.topics().touch("robot");
}

// Events that come before anything is loaded have the names of the project.
void Target::name_events() {
    const std::vector<ScriptPart>& parts = scripts_.parts();
    if (parts.empty()) return;
    const aesl::CommonDefinitions* common = scripts_.common(parts.front().file);
    if (common) network_->set_common(*common);
}

void Target::disconnect() {
    stopping_.end();
    end_rest();
    brake_causes_.clear();
    braked_.clear();
    leases_.clear();
    in_charge_ = moved_ = quiet_ = rests_ = mute_ = more_ = false;
    silence_ = {};
    carrier_ = nullptr;
    target_.clear();
    name_.clear();
    kind_ = "none";
    network_.reset();
    known_.clear();
    values_.clear();
    watched_.clear();
    traffic_.clear();
    events_ = events_before_ = 0;
    events_a_second_ = 0;
    dropped_.forget();
    for (auto& batch : std::exchange(batches_, {})) {
        for (const auto& [request, node] : batch->waiting) {
            batch->failed.emplace_back(node, "the target was left");
        }
        batch->finish(*batch);
    }
    desk_.topics().touch("robot");
    desk_.topics().touch("network");
}

std::vector<DescribedNode> Target::described() const {
    std::vector<DescribedNode> found;
    if (!network_) return found;
    for (const debug::NodeId node : network_->nodes()) {
        const debug::NodeView* view = network_->node(node);
        if (view->described) found.push_back({node, view->name, view->target});
    }
    return found;
}

std::vector<std::string> Target::names_of_nodes() const {
    std::vector<std::string> names;
    if (!network_) return names;
    for (const debug::NodeId node : network_->nodes()) {
        const debug::NodeView* view = network_->node(node);
        if (view->described) names.push_back(view->name);
    }
    return names;
}

std::optional<aesl::Target> Target::target_of(const std::string& name, uint16_t id) const {
    return target_among(described(), name, id);
}

std::optional<aesl::Target> target_among(const std::vector<DescribedNode>& nodes,
                                         const std::string& name, uint16_t id) {
    std::optional<aesl::Target> found;
    for (const DescribedNode& node : nodes) {
        if (!name.empty() && node.name != name) continue;
        if (node.id == id) return node.target;
        if (!found) found = node.target;
    }
    return found;
}

std::vector<uint16_t> Target::live_nodes() const {
    std::vector<uint16_t> live;
    if (!network_) return live;
    for (const debug::NodeId node : network_->nodes()) {
        const debug::NodeView* view = network_->node(node);
        if (view->connected && view->described) live.push_back(node);
    }
    return live;
}

std::vector<uint16_t> Target::nodes_of(const Json& node) const {
    if (node.get<uint16_t>() == 0) return live_nodes();
    return {node.get<uint16_t>()};
}

std::string Target::described_name(uint16_t node) const {
    const debug::NodeView* view = network_ ? network_->node(node) : nullptr;
    return view && view->described ? view->name : std::string();
}

TargetCounts Target::counts() const {
    TargetCounts counts{.events = events_};
    if (!network_) return counts;
    counts.lost = network_->counts().dropped;
    for (const LinkView& link : carrier_->links()) counts.lost += link.lost;
    for (const uint16_t node : live_nodes()) {
        ++counts.nodes;
        if (network_->node(node)->state == debug::ProgramState::Running) ++counts.running;
    }
    return counts;
}

std::vector<uint16_t> Target::without_script() const {
    std::vector<uint16_t> nodes = live_nodes();
    std::erase_if(nodes, [this](uint16_t node) { return !doc_of(node).empty(); });
    return nodes;
}

std::string Target::name_of(uint16_t node) const {
    const debug::NodeView* view = network_ ? network_->node(node) : nullptr;
    if (view && !view->name.empty()) return view->name;
    if (network_ && !view) {
        for (const auto& [id, name] : network_->left()) {
            if (id == node && !name.empty()) return name;
        }
    }
    return fmt::format("node {}", node);
}

std::string Target::source_of(uint16_t node) const {
    return node == wire::kHostId ? kHostName : name_of(node);
}

std::string Target::doc_of(uint16_t node) const {
    const debug::NodeView* view = network_ ? network_->node(node) : nullptr;
    if (!view || !view->described) return {};
    const ScriptPart* part = scripts_.for_node(view->name, node);
    return part ? part->doc : std::string();
}

// ---- acting ----

void Target::start_batch(const std::vector<uint16_t>& nodes, const Ask& ask,
                         std::function<void(Batch&)> finish, const char* busy) {
    auto batch = std::make_unique<Batch>();
    batch->finish = std::move(finish);
    for (const uint16_t node : nodes) {
        const auto asked = ask(node);
        if (!asked.ok()) {
            batch->failed.emplace_back(node, asked.error().what);
            continue;
        }
        batch->waiting.emplace(asked.value().value, node);
        known_[node].busy = busy;
    }
    batches_.push_back(std::move(batch));
    desk_.topics().touch("robot");
}

void Target::finish_batches() {
    for (size_t i = 0; i < batches_.size();) {
        if (!batches_[i]->waiting.empty()) {
            ++i;
            continue;
        }
        const auto batch = std::move(batches_[i]);
        batches_.erase(batches_.begin() + static_cast<std::ptrdiff_t>(i));
        batch->finish(*batch);
    }
}

void Target::hear(const debug::RequestDone& done) {
    for (auto& batch : batches_) {
        const auto found = batch->waiting.find(done.request.value);
        if (found == batch->waiting.end()) continue;
        const uint16_t node = found->second;
        batch->waiting.erase(found);
        // The line that it stepped over may have set what drives.
        if (known_[node].busy == "stepping") after_step(node);
        known_[node].busy.clear();
        desk_.topics().touch("robot");
        if (done.error) {
            batch->failed.emplace_back(node, done.error->what);
        } else {
            batch->done.push_back(node);
            if (!done.note.empty()) batch->notes.emplace_back(node, done.note);
        }
        return;
    }
}

void Target::act(const Call& call, Act what, const char* busy) {
    act(
        call, [this, what](uint16_t node) { return (this->*what)(node); }, busy);
}

void Target::act(const Call& call, const Ask& ask, const char* busy) {
    if (!network_) return call.fail("unavailable", "there is no robot; choose a target first");
    start_batch(
        nodes_of(call.in["node"]), ask,
        [call](Batch& batch) {
            call.done({{"failed", batch.failures()}});
        },
        busy);
}

void Target::load(const std::vector<uint16_t>& nodes, bool run,
                  std::function<void(Batch&)> finish) {
    std::vector<std::pair<uint16_t, std::string>> failed;
    std::vector<uint16_t> good;
    for (const uint16_t node : nodes) {
        const CompiledScript* script = scripts_.compiled(doc_of(node));
        if (!script) {
            failed.emplace_back(node, "the project has no script for " + name_of(node));
        } else if (!script->result.ok()) {
            const auto& first = script->result.errors.front();
            failed.emplace_back(node, fmt::format("line {}: {}", first.at.line, first.message));
        } else {
            good.push_back(node);
        }
    }
    in_charge_ = true;
    for (const uint16_t node : good) {
        // What it does until its program is there is not for its old one to say.
        if (live() && moves(node)) (void)network_->stop_now(node);
        brake(node);
    }
    start_batch(
        good,
        [&, run, several = good.size() > 1](uint16_t node) -> Result<debug::RequestId> {
            const CompiledScript* script = scripts_.compiled(doc_of(node));
            network_->set_common(script->common);
            // Among several, what moves waits for the last one: until then a reflex is missing.
            const bool waits = run && several && live() && moves(node);
            const auto then = run && !waits ? debug::AfterLoad::Run : debug::AfterLoad::Stay;
            auto asked = network_->load(node, script->result.program, then);
            if (!asked.ok()) return asked;
            Known& known = known_[node];
            will_move();
            if (run) stopping_.forget(node);
            if (waits) braked_.insert(node);
            known.loaded = script->source;
            known.has_program = true;
            known.lost_program = known.in_doubt = known.away = false;
            known.fault.clear();
            known.why.clear();
            return asked;
        },
        [this, run, failed = std::move(failed), finish = std::move(finish)](Batch& batch) {
            for (const uint16_t node : batch.done) {
                happen(loaded_now(node, name_of(node)));
                if (run && is_ready(node)) release(node);
            }
            note_failed_loads(batch);
            batch.failed.insert(batch.failed.end(), failed.begin(), failed.end());
            desk_.topics().touch("node");  // it has the variables of its new program
            place_breakpoints();
            finish(batch);
        },
        "loading");
}

// Its first lines may have been its last ones.
bool Target::is_ready(uint16_t node) const {
    const debug::NodeView* view = network_ ? network_->node(node) : nullptr;
    return braked_.contains(node) || (view && view->state == debug::ProgramState::Running);
}

// What such a node has is neither the old program nor the new one.
void Target::note_failed_loads(const Batch& batch) {
    for (const auto& [node, why] : batch.failed) {
        known_[node].has_program = false;
        braked_.erase(node);
        if (network_) network_->forget_program(node);
    }
}

void Target::load_changed(bool run, std::function<void(std::vector<std::string>)> done) {
    std::vector<uint16_t> changed;
    for (const uint16_t node : live_nodes()) {
        const CompiledScript* script = scripts_.compiled(doc_of(node));
        const Known& known = known_[node];
        const bool unsure = known.in_doubt || known.away;
        if (script && (unsure || !known.has_program || known.loaded != script->source)) {
            changed.push_back(node);
        }
    }
    load(changed, run, [done](Batch& batch) { done(sentences(batch.failed)); });
}

// Restart what was stopped.
Result<debug::RequestId> Target::let_run(uint16_t node) {
    in_charge_ = true;
    will_move();
    stopping_.forget(node);
    if (std::exchange(known_[node].stopped, false)) (void)network_->reset(node).ok();
    braked_.erase(node);
    release(node);
    return network_->run(node);
}

void Target::let_run(const std::vector<uint16_t>& nodes,
                     std::function<void(std::vector<std::string>)> done) {
    release_all();
    start_batch(
        nodes, [this](uint16_t node) { return let_run(node); },
        [done = std::move(done)](Batch& batch) { done(sentences(batch.failed)); }, "starting");
}

void Target::run_all(std::function<void(std::vector<std::string>)> done) {
    let_run(live_nodes(), std::move(done));
}

void Target::pause_all(std::function<void(std::vector<std::string>)> done) {
    start_batch(
        live_nodes(), [this](uint16_t node) { return pause(node); },
        [done = std::move(done)](Batch& batch) { done(sentences(batch.failed)); }, "pausing");
}

void Target::run_paused(std::function<void(std::vector<std::string>)> done) {
    let_run(paused_nodes(), std::move(done));
}

void Target::step_paused(std::function<void(std::vector<std::string>)> done) {
    start_batch(
        paused_nodes(), [this](uint16_t node) { return step(node); },
        [done = std::move(done)](Batch& batch) { done(sentences(batch.failed)); }, "stepping");
}

// Why it was paused before is no longer why it is paused.
Result<debug::RequestId> Target::step(uint16_t node) {
    in_charge_ = true;
    will_move();
    stopping_.forget(node);
    known_[node].why = "step";
    known_[node].held = true;
    return network_->step(node);
}

// Those that were stopped or paused and have a program.
std::vector<uint16_t> Target::paused_nodes() const {
    std::vector<uint16_t> paused = live_nodes();
    std::erase_if(paused, [this](uint16_t node) {
        return network_->node(node)->state == debug::ProgramState::Running;
    });
    return paused;
}

bool Target::is_paused_inside() const {
    const auto paused = paused_nodes();
    return std::any_of(paused.begin(), paused.end(), [this](uint16_t node) {
        const debug::NodeView* view = network_->node(node);
        return view->state == debug::ProgramState::Paused && view->at.line > 0 && !is_stopped(node);
    });
}

void Target::stop_all(std::function<void(const StopReport&)> done) {
    if (!network_) return done({});
    in_charge_ = true;
    brake_causes_.clear();  // nothing is left that would run again by itself
    braked_.clear();
    leases_.clear();
    for (const debug::NodeId node : network_->nodes()) {
        known_[node].why = "asked";
        known_[node].stopped = true;
        known_[node].held = false;
        known_[node].lost_program = false;
    }
    std::vector<uint16_t> heard;
    for (const LinkView& link : carrier_->links()) {
        heard.insert(heard.end(), link.nodes.begin(), link.nodes.end());
    }
    end_rest();
    rests_ = false;
    stopping_.begin(*network_, safe_stop_, heard, state() == Connection::Connected, now_,
                    std::move(done));
    send_frames();
    moved_ = false;  // what is done from here on is done behind Stop
    quiet_ = true;
    desk_.topics().touch("robot");
}

void Target::acknowledge_stop() {
    stopping_.acknowledge();
    resting_.acknowledge();
    if (network_) network_->acknowledge_left();
    desk_.topics().touch("robot");
}

Result<debug::RequestId> Target::stop(uint16_t node) {
    if (!network_->node(node)) return network_->stop(node);  // there is none: says so
    in_charge_ = true;
    known_[node].why = "asked";
    known_[node].stopped = true;
    known_[node].held = false;
    const auto asked = network_->stop_now(node);
    brake(node);
    return *asked;
}

// A node that was just being started has said meanwhile that it runs.
void Target::note_stopped(const Batch& batch) {
    for (const uint16_t node : batch.done) known_[node].stopped = true;
}

void Target::script_changed(const std::string& file) {
    desk_.topics().touch("robot");
    follow_lines(file);
    const aesl::CommonDefinitions* common = scripts_.common(file);
    // What nodes have loaded tells numbers of events by its own list.
    const bool loaded = std::any_of(known_.begin(), known_.end(),
                                    [](const auto& one) { return one.second.has_program; });
    if (network_ && common && !loaded) network_->set_common(*common);
}

// ---- time ----

void Target::tick(Time now) {
    now_ = now;
    if (!carrier_) return finish_batches();
    if (state() != connection_) link_changed();
    const std::vector<Carried> taken = carrier_->take();
    more_ = taken.size() >= kTakenAtOnce;
    for (const Carried& carried : taken) {
        network_->receive(now, carried.frame);
        heard_t_ = carried.t;
        hear_all();
    }
    heard_t_.reset();
    const uint64_t heard = carrier_->heard();
    watch_link(now, std::exchange(heard_, heard) != heard);
    watch_what_is_shown();
    network_->tick(now);
    hear_all();
    stopping_.tick(now);
    tick_rest(now);
    end_leases();
    load_lost_programs();
    finish_batches();
    look_at_handlers(now);
    send_frames();
    count_rates(now);
    due_ = next_tick();
}

void Target::hear_all() {
    for (const debug::Event& event : network_->take_events()) hear(event);
}

void Target::send_frames() {
    for (const wire::Frame& frame : network_->take_frames()) carrier_->send(frame);
}

Time Target::next_tick() const {
    const bool finished = std::any_of(batches_.begin(), batches_.end(),
                                      [](const auto& batch) { return batch->waiting.empty(); });
    if (finished || more_) return now_;
    if (!network_) return Time::max();
    return std::min({network_->next_tick(), stopping_.next_tick(), resting_.next_tick(),
                     rested_ ? rest_until_ : Time::max(),
                     looks_for_endless_ ? look_at_ : Time::max(), rates_at_ + kRatesEvery});
}

void Target::count_rates(Time now) {
    if (now < rates_at_ + kRatesEvery) return;
    const double seconds = seconds_of(now - rates_at_);
    events_a_second_ = static_cast<double>(events_ - events_before_) / seconds;
    events_before_ = events_;
    rates_at_ = now;
    desk_.topics().touch("robot");
    desk_.topics().touch("network");
}

}  // namespace vagus::serve
