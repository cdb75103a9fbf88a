#include "session/sim_session.hpp"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <set>

#include "base/file.hpp"
#include "base/project_border.hpp"
#include "debug/user_event.hpp"
#include "session/diagnostic_text.hpp"
#include "session/trace.hpp"
#include "sim/world_file.hpp"

namespace vagus::session {
namespace {

// How often the host's side and the bus exchange frames: the step of the nodes themselves.
constexpr Duration kExchangeEvery = sim::kNodeStep;

std::string words_of(std::span<const int16_t> values) {
    std::string text;
    for (const int16_t value : values) text += " " + std::to_string(value);
    return text;
}

}  // namespace

SimSession::SimSession(sim::World world, SimOptions options)
    : owned_(std::make_unique<sim::World>(std::move(world))),
      world_(owned_.get()),
      options_(std::move(options)),
      link_(bus().add({.name = "session"}).value()),
      over_can_(world_->bus_load().has_value()) {
    for (const sim::RobotView& robot : world_->robots()) {
        if (!robot.own_bus) add_nodes_of(robot);
    }
    open_chaos();
}

SimSession::SimSession(sim::World& world, sim::RobotId robot, SimOptions options)
    : world_(&world),
      robot_(robot),
      robot_name_(world.definition().robots[robot.number - 1].name),
      options_(std::move(options)),
      link_(bus().add({.name = "session"}).value()),
      over_can_(world.bus_load(robot).has_value()) {
    add_nodes_of(world.robots()[robot.number - 1]);
    open_chaos();
}

void SimSession::add_nodes_of(const sim::RobotView& robot) {
    for (uint16_t place = 0; place < robot.nodes; place++) {
        nodes_.push_back({robot.id, std::string(robot.name),
                          static_cast<uint16_t>(robot.node + place), place, robot.nodes,
                          std::nullopt, ""});
        index_of_.emplace(nodes_.back().id, nodes_.size() - 1);
    }
}

TraceLine SimSession::trace_line(Time at, std::string_view kind) const {
    TraceLine line(at, kind);
    if (robot_) line.text("robot", robot_name_);
    return line;
}

bool SimSession::is_of_its_bus(sim::RobotId robot) const {
    if (robot_) return *robot_ == robot;
    return world_->definition().robots[robot.number - 1].project.empty();
}

// ---- time ----

void SimSession::step(Duration span) {
    rest_ += span;
    while (rest_ >= kExchangeEvery) {
        rest_ -= kExchangeEvery;
        begin_instant();
        end_instant();
    }
}

void SimSession::begin_instant() {
    before_nodes();
    world_->begin_instant();
    after_nodes();
}

void SimSession::before_nodes() {
    if (chaos_) {
        chaos_->reseed(world_->chaos_seed());
        chaos_->advance(now() + kExchangeEvery);
    }
    send_frames();  // what was emitted since the last
    // On an ideal bus nodes put into our queue at this instant what arrives at the next one.
    if (!over_can_) delivered_ = take_frames();
}

void SimSession::after_nodes() {
    if (over_can_) delivered_ = take_frames();
    if (!world_->chaos().empty()) tell_chaos();
    listen(delivered_);
}

void SimSession::end_instant() {
    const size_t told = world_->happenings().size();
    world_->end_instant();
    after_bodies(told);
}

void SimSession::after_bodies(size_t told) {
    if (options_.traced) trace_happenings(told);
    speak();
    for (const hub::SharedId& shared : bus().take_shared_ids()) {
        note(NoteKind::Trouble, sentence(shared));
    }
    for (const auto& listener : told_of_instant_) listener();
}

void SimSession::before_hold() {
    delivered_ = take_frames();
}

void SimSession::after_hold() {
    listen(delivered_);
    speak();
}

bool SimSession::settle() {
    assert(now() == Time{});
    const Duration within = settles_within();
    for (Duration held{}; !settled() && held < within; held += kExchangeEvery) {
        before_hold();
        world_->hold_instant();
        after_hold();
    }
    return settled();
}

Duration SimSession::settles_within() const {
    return kSettleWithin + kSettleWithinMore * static_cast<int>(nodes_.size());
}

// What was sent before this instant reaches the host at it, as it does the nodes.
std::vector<wire::Frame> SimSession::take_frames() {
    std::vector<wire::Frame> frames = std::exchange(put_off_, {});
    wire::Frame frame;
    while (bus().take(link_, frame)) {
        if (chaos_) {
            chaos_->from_bus().put(frame, now());
        } else {
            frames.push_back(frame);
        }
    }
    while (chaos_ && chaos_->from_bus().take(frame, now())) frames.push_back(frame);
    return frames;
}

void SimSession::listen(const std::vector<wire::Frame>& delivered) {
    clock_ += kExchangeEvery;
    if (options_.traced) trace_happenings(0);
    for (const wire::Frame& frame : delivered) {
        number_heard(frame);
        network_.receive(clock_, frame);
    }
    if (network_.next_tick() <= clock_) network_.tick(clock_);
    for (debug::Event& event : network_.take_events()) hear(std::move(event));
    if (guests_) guests_->tick(clock_);
}

void SimSession::speak() {
    if (!waiting_.empty() && all_described()) place_files();
    send_ready();
    send_frames();
}

void SimSession::send_frames() {
    for (const wire::Frame& out : network_.take_frames()) {
        number_own(out);
        if (chaos_) {
            chaos_->to_bus().put(out, now());
        } else {
            send_on(out);
        }
    }
    wire::Frame late;
    while (chaos_ && chaos_->to_bus().take(late, now())) send_on(late);
}

void SimSession::send_on(const wire::Frame& frame) {
    if (emits_to_ && wire::is_user_event(frame.type)) {
        world_->send_to(*emits_to_, link_, frame);
    } else {
        bus().receive(link_, frame);
    }
}

// ---- which frame is which ----

void SimSession::number_own(const wire::Frame& frame) {
    sim::FrameNumbers* const numbers = world_->frame_numbers();
    uint32_t cause = 0;
    if (wire::is_user_event(frame.type) && !emit_causes_.empty()) {
        cause = emit_causes_.front();
        emit_causes_.pop_front();
    }
    const uint32_t number = numbers == nullptr ? 0 : numbers->sent(on_bus(frame), cause);
    if (numbers != nullptr) {
        for (const FrameListener& told : told_of_frame_) told(frame, number);
    }
    if (wire::is_user_event(frame.type)) tell_own(frame, number);
}

void SimSession::tell_own(const wire::Frame& frame, uint32_t number) {
    if (told_of_heard_.empty()) return;
    const debug::Event own{clock_, wire::kHostId, debug::user_event_of(frame, common()), number};
    for (const HeardListener& told : told_of_heard_) told(own);
}

void SimSession::number_heard(const wire::Frame& frame) {
    sim::FrameNumbers* const numbers = world_->frame_numbers();
    if (numbers == nullptr) return;
    const uint32_t number = numbers->find(on_bus(frame), last_frame_);
    if (number != 0) last_frame_ = number;
    if (wire::is_user_event(frame.type)) event_frames_.push_back(number);
    for (const FrameListener& told : told_of_frame_) told(frame, number);
}

// ---- a plan beside it ----

Status SimSession::emit(const std::string& event, std::span<const int16_t> arguments, Time at,
                        uint32_t cause) {
    const Status sent = network_.emit(event, arguments);
    if (sent.ok()) emit_causes_.push_back(cause);
    if (!sent.ok() || !options_.traced) return sent;
    trace_ += trace_line(at, "event")
                  .number("node", wire::kHostId)
                  .text("name", event)
                  .words("args", arguments)
                  .done();
    return sent;
}

std::vector<debug::Event> SimSession::take_heard() {
    return std::exchange(heard_, {});
}

void SimSession::hear_ahead() {
    if (bus().waiting(link_) == 0) return;
    if (told_of_ahead_) told_of_ahead_();
    for (const wire::Frame& frame : take_frames()) {
        if (wire::is_user_event(frame.type)) {
            number_heard(frame);
            network_.receive(clock_, frame);
        } else {
            put_off_.push_back(frame);
        }
    }
    for (debug::Event& event : network_.take_events()) hear(std::move(event));
}

void SimSession::reset() {
    world_->reset();
    if (options_.traced) trace_ += TraceLine(world_->now(), "reset").done();
    begin_again();
}

void SimSession::begin_again() {
    rest_ = {};
    if (chaos_) chaos_->restart();
    events_.clear();
    held_ = false;
    for (Node& node : nodes_) {
        node.fault.clear();
        node.killed.clear();
        if (!node.script || node.script->program->bytecode.empty()) continue;
        // A node that was unplugged is there again, and has not been heard yet.
        const debug::NodeView* const view = network_.node(node.id);
        node.awaited = view == nullptr || !view->connected;
        enter(*node.script, node.awaited ? Stage::Waiting : Stage::Ready);
        if (node.awaited) network_.list_nodes();
    }
}

bool SimSession::settled() const {
    const size_t on_their_way = count(Stage::Waiting) + count(Stage::Ready) + count(Stage::Sent);
    return waiting_.empty() && on_their_way == 0;
}

void SimSession::stop_nodes() {
    for (const Node& node : nodes_) (void)network_.stop_now(node.id);
    send_frames();
}

bool SimSession::stop_guests(Stopping::How how) {
    std::vector<debug::NodeId> ids;
    for (const debug::NodeId id : network_.nodes()) {
        const debug::NodeView& node = *network_.node(id);
        const bool meant = how == Stopping::How::Stop || options_.guests.contains(node.name);
        if (meant && !find(id) && node.connected) ids.push_back(id);
    }
    if (ids.empty()) return false;
    guests_.emplace();
    guests_->begin(network_, options_.guests, Stopping::Manner{.how = how}, clock_, ids);
    send_frames();
    return true;
}

std::vector<StopNode> SimSession::guests() const {
    return guests_ ? guests_->report() : std::vector<StopNode>();
}

// ---- what the bus says ----

void SimSession::hear(debug::Event event) {
    if (std::holds_alternative<debug::UserEvent>(event.what) && !event_frames_.empty()) {
        event.frame = event_frames_.front();
        event_frames_.pop_front();
    }
    if (options_.heard && heard_.size() < kHeardMax) heard_.push_back(event);
    for (const HeardListener& told : told_of_heard_) told(event);
    if (guests_) guests_->hear(event);
    if (const auto* sent = std::get_if<debug::UserEvent>(&event.what)) {
        hear_user_event(event, *sent);
        return;
    }
    Node* node = find(event.node);
    if (node == nullptr) return;
    if (const auto* fault = std::get_if<debug::Fault>(&event.what)) {
        hear_fault(*node, *fault);
    } else if (const auto* done = std::get_if<debug::RequestDone>(&event.what)) {
        hear_done(*node, *done);
    } else if (std::holds_alternative<debug::NodeConfirmed>(event.what)) {
        const bool waits = std::exchange(node->awaited, false) && node->script;
        if (waits && node->script->stage == Stage::Waiting) enter(*node->script, Stage::Ready);
    } else if (const auto* changed = std::get_if<debug::StateChanged>(&event.what)) {
        if (!options_.traced) return;
        trace_ += trace_line(now(), "state")
                      .number("node", event.node)
                      .text("state", debug::name_of(changed->state))
                      .done();
    }
}

void SimSession::hear_user_event(const debug::Event& event, const debug::UserEvent& sent) {
    const std::string name = sent.name.empty() ? std::to_string(sent.number) : sent.name;
    if (events_.size() < kEventNamesMax || events_.contains(name)) {
        EventCount& count = events_[name];
        count = {name, count.count + 1, sent.arguments, now()};
    }
    const Node* node = find(event.node);
    const std::string from = node != nullptr ? label(*node) : "a host";
    note(NoteKind::Event, from + ": " + name + words_of(sent.arguments));
    // Events of nodes are traced as they happen (trace_happenings); hosts speak between the steps.
    if (!options_.traced || node != nullptr) return;
    trace_ += trace_line(now(), "event")
                  .number("node", event.node)
                  .text("name", name)
                  .words("args", sent.arguments)
                  .done();
}

void SimSession::hear_fault(Node& node, const debug::Fault& fault) {
    std::string where = label(node);
    if (node.script && fault.at.line > 0) {
        const int line = fault.at.line + node.script->script->first_line - 1;
        where = node.script->path + ":" + std::to_string(line);
    }
    const std::string sentence = where + ": " + fault.text;
    // The script goes on with its next event.
    if (fault.kind == debug::FaultKind::Killed) {
        node.killed = sentence;
        return;
    }
    node.fault = sentence;
    note(NoteKind::Fault, sentence);
}

void SimSession::hear_done(Node& node, const debug::RequestDone& done) {
    if (!node.script || !(node.script->request == done.request)) return;
    Assignment& script = *node.script;
    if (script.stage != Stage::Sent) return;
    if (done.error) {
        enter(script, Stage::Failed);
        note(NoteKind::Trouble, script.path + ": " + done.error->what);
        return;
    }
    enter(script, Stage::Runs);
    node.fault.clear();
    node.killed.clear();
    note(NoteKind::Loaded, script.path + " runs on " + label(node) + ", " +
                               std::to_string(script.program->bytecode.size()) + " words");
}

void SimSession::note(NoteKind kind, std::string text) {
    // Robots that share a script share its mistakes.
    const bool about_script = kind == NoteKind::Mistakes || kind == NoteKind::Warnings;
    const bool again =
        about_script && !notes_.empty() && notes_.back().kind == kind && notes_.back().text == text;
    if (notes_.size() < kNotesMax && !again) notes_.push_back({now(), kind, std::move(text)});
}

void SimSession::warn(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += line + "\n";
    hints_ = lines;
    if (!text.empty()) note(NoteKind::Warnings, text);
}

// ---- looking ----

std::vector<NodeState> SimSession::nodes() const {
    std::vector<NodeState> states;
    for (const Node& node : nodes_) {
        NodeState state{node.robot, node.id,    "", {}, node.script.has_value(),
                        node.fault, node.killed};
        if (const debug::NodeView* view = network_.node(node.id)) {
            state.name = view->name;
            state.state = view->state;
        }
        states.push_back(std::move(state));
    }
    return states;
}

std::optional<std::pair<std::string, int>> SimSession::place_of(uint16_t id, int line) const {
    const Node* const node = find(debug::NodeId{id});
    if (node == nullptr || !node->script || line <= 0) return std::nullopt;
    return std::pair(node->script->path, line + node->script->script->first_line - 1);
}

const aesl::Program* SimSession::program(uint16_t id) const {
    const debug::NodeView* const node = network_.node(id);
    return node != nullptr && node->program ? &*node->program : nullptr;
}

std::vector<std::pair<std::string, std::span<const int16_t>>> SimSession::script_variables(
    uint16_t id) const {
    std::vector<std::pair<std::string, std::span<const int16_t>>> list;
    const debug::NodeView* node = network_.node(id);
    const Node* const own_node = find(id);
    if (node == nullptr || !node->program || own_node == nullptr) return list;
    size_t own = 0;
    for (const aesl::NamedVariable& variable : node->target->variables) own += variable.size;
    const std::span<const int16_t> memory = world_->variables(own_node->robot, id);
    for (const aesl::VariablePlace& place : node->program->variables) {
        if (place.address < own || size_t{place.address} + place.size > memory.size()) continue;
        list.emplace_back(place.name, memory.subspan(place.address, place.size));
    }
    return list;
}

std::span<const int16_t> SimSession::node_variable(sim::RobotId id, std::string_view name) const {
    for (const Node& node : std::ranges::equal_range(nodes_, id, {}, &Node::robot)) {
        const debug::NodeView* view = network_.node(node.id);
        if (view == nullptr) continue;
        const std::span<const int16_t> memory = world_->variables(node.robot, node.id);
        size_t address = 0;
        for (const aesl::NamedVariable& variable : view->target->variables) {
            if (address + variable.size > memory.size()) break;
            if (variable.name == name) return memory.subspan(address, variable.size);
            address += variable.size;
        }
    }
    return {};
}

const aesl::Target* SimSession::target(uint16_t id) const {
    const debug::NodeView* view = network_.node(id);
    return view != nullptr && view->described ? &*view->target : nullptr;
}

std::vector<EventCount> SimSession::events() const {
    std::vector<EventCount> list;
    for (const auto& [name, count] : events_) list.push_back(count);
    std::stable_sort(list.begin(), list.end(),
                     [](const EventCount& a, const EventCount& b) { return a.last > b.last; });
    return list;
}

std::vector<Diagnostic> SimSession::mistakes() const {
    std::vector<Diagnostic> list;
    std::set<std::string> said;
    for (const auto& [path, why] : file_mistakes_) list.push_back(why);
    for (const Node& node : nodes_) {
        if (!node.script || node.script->mistakes.empty()) continue;
        const auto& more = node.script->mistakes;
        // The same script on several nodes has the same mistakes: said once.
        if (said.insert(text_of(more.front())).second) {
            list.insert(list.end(), more.begin(), more.end());
        }
    }
    return list;
}

std::vector<std::string> SimSession::without_script() const {
    std::vector<std::string> names;
    for (const Node& node : nodes_) {
        if (node.script && node.script->stage != Stage::Runs) names.push_back(label(node));
    }
    return names;
}

std::vector<std::string> SimSession::script_paths() const {
    std::vector<std::string> paths;
    for (const auto& [path, only] : sources_) {
        if (std::find(paths.begin(), paths.end(), path) == paths.end()) paths.push_back(path);
    }
    return paths;
}

std::vector<Note> SimSession::take_notes() {
    return std::exchange(notes_, {});
}

std::string SimSession::take_trace() {
    return std::exchange(trace_, {});
}

const SimSession::Node* SimSession::find(debug::NodeId id) const {
    const auto found = index_of_.find(id);
    return found == index_of_.end() ? nullptr : &nodes_[found->second];
}

SimSession::Node* SimSession::find(debug::NodeId id) {
    return const_cast<Node*>(std::as_const(*this).find(id));  // it is ours, and we are not const
}

// "thymio"; of a robot with several nodes "carbot drive".
std::string SimSession::label(const Node& node) const {
    if (node.robot_name.empty()) return "node " + std::to_string(node.id);
    const debug::NodeView* view = network_.node(node.id);
    if (node.places == 1 || view == nullptr || !view->described) return node.robot_name;
    return node.robot_name + " " + view->name;
}

Result<SimSession> open_sim(const std::string& path, SimOptions options) {
    return open_sim_text(path, TRY(read_file(path)), std::move(options));
}

namespace {

// A sentence for those who run the common bus alone.
std::vector<std::string> hints(const sim::World& world, const std::string& path,
                               const std::string& text, Projects projects) {
    std::vector<std::string> lines = sim::hints_of_world(text, path);
    const auto& robots = world.definition().robots;
    const auto standing = std::count_if(robots.begin(), robots.end(),
                                        [](const auto& robot) { return !robot.project.empty(); });
    if (projects == Projects::Run || standing == 0) return lines;
    lines.push_back(path + ": warning: " + std::to_string(standing) +
                    (standing == 1 ? " robot with a project of its own stands"
                                   : " robots with projects of their own stand") +
                    " still here; `vagus sim` runs each on a bus of its own");
    return lines;
}

}  // namespace

Result<SimSession> open_sim_text(const std::string& path, const std::string& text,
                                 SimOptions options, Projects projects) {
    namespace fs = std::filesystem;
    options.world.folder = fs::path(path).parent_path().string();
    if (options.world.folder.empty()) options.world.folder = ".";
    SimSession session(TRY(sim::World::load(text, path, options.world)), options);
    const auto& robots = session.world().definition().robots;
    const auto views = session.world().robots();
    session.warn(hints(session.world(), path, text, projects));
    for (size_t i = 0; i < robots.size() && i < views.size(); i++) {
        if (robots[i].script.empty()) continue;
        const Result<std::string> script = path_beside(path, robots[i].script);
        const Result<std::string> source =
            script.ok() ? read_file(script.value()) : Result<std::string>(script.error());
        if (!source.ok()) {
            const Error& error = source.error();
            const std::string element = "robots[" + std::to_string(i) + "].script: ";
            return sim::error_in_world({error.code, element + error.what}, text, path);
        }
        session.load_for(views[i].id, script.value(), source.value());
    }
    return session;
}

}  // namespace vagus::session
