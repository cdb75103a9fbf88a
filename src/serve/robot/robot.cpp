#include "serve/robot/robot.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "serve/robot/stand.hpp"

namespace vagus::serve {

using Json = nlohmann::json;

namespace {

std::vector<std::string> sentences(const std::vector<std::pair<uint16_t, std::string>>& failed) {
    std::vector<std::string> list;
    for (const auto& [node, why] : failed) list.push_back(fmt::format("node {}: {}", node, why));
    return list;
}

}  // namespace

Json Robot::Batch::failures() const {
    Json list = Json::array();
    for (const auto& [node, why] : failed) list.push_back({{"node", node}, {"why", why}});
    return list;
}

Json Robot::Batch::answers() const {
    Json list = Json::array();
    for (const auto& [node, what] : notes) list.push_back({{"node", node}, {"what", what}});
    return list;
}

Robot::Robot(Desk& desk, Files& files, Scripts& scripts, ScriptBreakpoints& breakpoints)
    : desk_(desk), files_(files), scripts_(scripts), breakpoints_(breakpoints) {
    declare_topics();
    declare_commands();
}

Robot::~Robot() = default;

// ---- the target ----

void Robot::connect(Carrier& carrier, const std::string& target, const std::string& name,
                    const std::string& kind, Time now) {
    disconnect();
    carrier_ = &carrier;
    target_ = target;
    name_ = name;
    kind_ = kind;
    now_ = now;
    network_ = std::make_unique<debug::Network>();
    desk_.board().touch("robot");
}

void Robot::disconnect() {
    carrier_ = nullptr;
    target_.clear();
    name_.clear();
    kind_ = "none";
    network_.reset();
    known_.clear();
    values_.clear();
    watched_.clear();
    traffic_.clear();
    dropped_.forget();
    for (auto& batch : std::exchange(batches_, {})) {
        for (const auto& [request, node] : batch->waiting) {
            batch->failed.emplace_back(node, "the target was left");
        }
        batch->finish(*batch);
    }
    desk_.board().touch("robot");
    desk_.board().touch("network");
}

std::optional<aesl::Target> Robot::target_of(const std::string& name, uint16_t id) const {
    if (!network_) return std::nullopt;
    std::optional<aesl::Target> found;
    for (const debug::NodeId node : network_->nodes()) {
        const debug::NodeView* view = network_->node(node);
        if (!view->described || (!name.empty() && view->name != name)) continue;
        if (node == id) return view->target;
        if (!found) found = view->target;
    }
    return found;
}

std::vector<uint16_t> Robot::live_nodes() const {
    std::vector<uint16_t> live;
    if (!network_) return live;
    for (const debug::NodeId node : network_->nodes()) {
        const debug::NodeView* view = network_->node(node);
        if (view->connected && view->described) live.push_back(node);
    }
    return live;
}

std::vector<uint16_t> Robot::nodes_of(const Json& node) const {
    if (node.get<uint16_t>() == 0) return live_nodes();
    return {node.get<uint16_t>()};
}

std::string Robot::described_name(uint16_t node) const {
    const debug::NodeView* view = network_ ? network_->node(node) : nullptr;
    return view && view->described ? view->name : std::string();
}

RobotCounts Robot::counts() const {
    RobotCounts counts{.events = events_};
    if (!network_) return counts;
    counts.lost = network_->counts().dropped;
    for (const LinkView& link : carrier_->links()) counts.lost += link.lost;
    for (const uint16_t node : live_nodes()) {
        ++counts.nodes;
        if (network_->node(node)->state == debug::ProgramState::Running) ++counts.running;
    }
    return counts;
}

std::vector<uint16_t> Robot::without_script() const {
    std::vector<uint16_t> nodes = live_nodes();
    std::erase_if(nodes, [this](uint16_t node) { return !doc_of(node).empty(); });
    return nodes;
}

std::string Robot::name_of(uint16_t node) const {
    const debug::NodeView* view = network_ ? network_->node(node) : nullptr;
    return view && !view->name.empty() ? view->name : fmt::format("node {}", node);
}

std::string Robot::doc_of(uint16_t node) const {
    const debug::NodeView* view = network_ ? network_->node(node) : nullptr;
    if (!view || !view->described) return {};
    const ScriptPart* part = scripts_.for_node(view->name, node);
    return part ? part->doc : std::string();
}

// ---- acting ----

void Robot::start_batch(const std::vector<uint16_t>& nodes, const Ask& ask,
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
    desk_.board().touch("robot");
}

void Robot::finish_batches() {
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

void Robot::hear(const debug::RequestDone& done) {
    for (auto& batch : batches_) {
        const auto found = batch->waiting.find(done.request.value);
        if (found == batch->waiting.end()) continue;
        const uint16_t node = found->second;
        batch->waiting.erase(found);
        known_[node].busy.clear();
        desk_.board().touch("robot");
        if (done.error) {
            batch->failed.emplace_back(node, done.error->what);
        } else {
            batch->done.push_back(node);
            if (!done.note.empty()) batch->notes.emplace_back(node, done.note);
        }
        return;
    }
}

void Robot::act(const Call& call, Act what, const char* busy) {
    act(
        call, [this, what](uint16_t node) { return (network_.get()->*what)(node); }, busy);
}

void Robot::act(const Call& call, const Ask& ask, const char* busy) {
    if (!network_) return call.fail("unavailable", "there is no robot; choose a target first");
    start_batch(
        nodes_of(call.in["node"]), ask,
        [call](Batch& batch) {
            call.done({{"failed", batch.failures()}});
        },
        busy);
}

void Robot::load(const std::vector<uint16_t>& nodes, bool run, std::function<void(Batch&)> finish) {
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
    start_batch(
        good,
        [&, run](uint16_t node) -> Result<debug::RequestId> {
            const CompiledScript* script = scripts_.compiled(doc_of(node));
            network_->set_common(script->common);
            auto asked = network_->load(node, script->result.program);
            if (!asked.ok()) return asked;
            // What was loaded runs by itself; who wants it to stand says so behind it, and before
            // anybody says something else.
            if (!run) (void)network_->stop(node).ok();
            Known& known = known_[node];
            known.loaded = script->source;
            known.has_program = true;
            known.lost_program = false;
            known.fault.clear();
            known.why.clear();
            return asked;
        },
        [this, failed = std::move(failed), finish = std::move(finish)](Batch& batch) {
            for (const uint16_t node : batch.done) happen("loaded", node, name_of(node), "");
            batch.failed.insert(batch.failed.end(), failed.begin(), failed.end());
            desk_.board().touch("node");  // it has the variables of its new program
            place_breakpoints();
            finish(batch);
        },
        "loading");
}

void Robot::load_changed(bool run, std::function<void(std::vector<std::string>)> done) {
    std::vector<uint16_t> changed;
    for (const uint16_t node : live_nodes()) {
        const CompiledScript* script = scripts_.compiled(doc_of(node));
        const Known& known = known_[node];
        if (script && (!known.has_program || known.loaded != script->source)) {
            changed.push_back(node);
        }
    }
    load(changed, run, [done](Batch& batch) { done(sentences(batch.failed)); });
}

void Robot::act_on(const std::vector<uint16_t>& nodes, Act what, const char* busy,
                   std::function<void(std::vector<std::string>)> done) {
    start_batch(
        nodes, [&](uint16_t node) { return (network_.get()->*what)(node); },
        [done = std::move(done)](Batch& batch) { done(sentences(batch.failed)); }, busy);
}

// What was stopped begins anew.
Result<debug::RequestId> Robot::let_run(uint16_t node) {
    if (std::exchange(known_[node].stopped, false)) (void)network_->reset(node).ok();
    return network_->run(node);
}

void Robot::let_run(const std::vector<uint16_t>& nodes,
                    std::function<void(std::vector<std::string>)> done) {
    start_batch(
        nodes, [this](uint16_t node) { return let_run(node); },
        [done = std::move(done)](Batch& batch) { done(sentences(batch.failed)); }, "starting");
}

void Robot::run_all(std::function<void(std::vector<std::string>)> done) {
    let_run(live_nodes(), std::move(done));
}

void Robot::pause_all(std::function<void(std::vector<std::string>)> done) {
    act_on(live_nodes(), &debug::Network::pause, "pausing", std::move(done));
}

void Robot::run_standing(std::function<void(std::vector<std::string>)> done) {
    let_run(standing_nodes(), std::move(done));
}

void Robot::step_standing(std::function<void(std::vector<std::string>)> done) {
    start_batch(
        standing_nodes(), [this](uint16_t node) { return step(node); },
        [done = std::move(done)](Batch& batch) { done(sentences(batch.failed)); }, "stepping");
}

// Why it stood before is no longer why it stands.
Result<debug::RequestId> Robot::step(uint16_t node) {
    known_[node].why = "step";
    return network_->step(node);
}

// Those that were stopped or paused and have a program.
std::vector<uint16_t> Robot::standing_nodes() const {
    std::vector<uint16_t> standing = live_nodes();
    std::erase_if(standing, [this](uint16_t node) {
        return network_->node(node)->state == debug::ProgramState::Running;
    });
    return standing;
}

bool Robot::stands_inside() const {
    const auto standing = standing_nodes();
    return std::any_of(standing.begin(), standing.end(), [this](uint16_t node) {
        const debug::NodeView* view = network_->node(node);
        return view->state == debug::ProgramState::Paused && view->at.line > 0 && !is_stopped(node);
    });
}

void Robot::stop_all(std::function<void(std::vector<uint16_t>)> done) {
    if (!network_) return done({});
    start_batch(
        live_nodes(), [this](uint16_t node) { return stop(node); },
        [this, done](Batch& batch) {
            note_stopped(batch);
            done(batch.done);
        },
        "stopping");
    // Queued behind Stop: the script can no longer set them.
    for (const uint16_t node : live_nodes()) {
        for (const std::string& name : driving_variables(network_->node(node)->target)) {
            const auto range = network_->variable(node, name);
            const int16_t zero = 0;
            if (range.ok()) (void)network_->set(node, range.value(), {&zero, 1}).ok();
        }
    }
}

Result<debug::RequestId> Robot::stop(uint16_t node) {
    known_[node].why = "asked";
    known_[node].stopped = true;
    return network_->stop(node);
}

// A node that was just being started has said meanwhile that it runs.
void Robot::note_stopped(const Batch& batch) {
    for (const uint16_t node : batch.done) known_[node].stopped = true;
}

// The program that the node has is known by its text: names, lines, breakpoints.
void Robot::restore(uint16_t node) {
    const CompiledScript* script = scripts_.compiled(doc_of(node));
    const Known& known = known_[node];
    if (!script || !script->result.ok() || !known.has_program) return;
    network_->set_common(script->common);
    if (known.loaded == script->source) (void)network_->adopt(node, script->result.program).ok();
    place_breakpoints();
    desk_.board().touch("robot");
    desk_.board().touch("node");
}

void Robot::script_changed(const std::string& file) {
    desk_.board().touch("robot");
    const aesl::CommonDefinitions* common = scripts_.common(file);
    // What nodes have loaded tells numbers of events by its own list.
    const bool loaded = std::any_of(known_.begin(), known_.end(),
                                    [](const auto& one) { return one.second.has_program; });
    if (network_ && common && !loaded) network_->set_common(*common);
}

// ---- time ----

void Robot::tick(Time now) {
    now_ = now;
    if (!carrier_) return finish_batches();
    if (carrier_->connection() != connection_) {
        if (connection_ == Connection::Connected) network_->link_lost();
        connection_ = carrier_->connection();
        if (connection_ == Connection::Connected) network_->list_nodes();
        desk_.board().touch("robot");
    }
    for (const Carried& carried : carrier_->take()) {
        network_->receive(now, carried.frame);
        heard_t_ = carried.t;
        for (const debug::Event& event : network_->take_events()) hear(event);
    }
    heard_t_.reset();
    watch_what_is_shown();
    network_->tick(now);
    for (const debug::Event& event : network_->take_events()) hear(event);
    // A node that came back without its program gets it again, and stands.
    for (auto& [node, known] : known_) {
        if (!known.lost_program) continue;
        known.lost_program = false;
        say_("note", name_of(node) + " came back without its script; it gets it again and stands");
        load({node}, false, [](Batch&) {});
    }
    finish_batches();
    for (const wire::Frame& frame : network_->take_frames()) carrier_->send(frame);
    count_rates(now);
}

Time Robot::next_tick() const {
    const bool finished = std::any_of(batches_.begin(), batches_.end(),
                                      [](const auto& batch) { return batch->waiting.empty(); });
    if (finished) return now_;
    if (!network_) return Time::max();
    return std::min(network_->next_tick(), rates_at_ + kRatesEvery);
}

void Robot::count_rates(Time now) {
    if (now < rates_at_ + kRatesEvery) return;
    const double seconds = std::chrono::duration<double>(now - rates_at_).count();
    events_a_second_ = static_cast<double>(events_ - events_before_) / seconds;
    events_before_ = events_;
    rates_at_ = now;
    desk_.board().touch("robot");
    desk_.board().touch("network");
}

}  // namespace vagus::serve
