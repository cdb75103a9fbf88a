#include "session/sim_session.hpp"

#include <algorithm>
#include <cassert>
#include <filesystem>

#include "base/file.hpp"
#include "session/diagnostic_text.hpp"
#include "session/trace.hpp"

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
    : world_(std::move(world)),
      options_(std::move(options)),
      link_(world_.bus().add({.name = "session"}).value()) {
    for (const sim::RobotView& robot : world_.robots()) {
        robots_.push_back({robot.id, std::string(robot.name), robot.node, std::nullopt, ""});
    }
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
    const std::vector<wire::Frame> delivered = take_frames();
    world_.begin_instant();
    listen(delivered);
}

void SimSession::end_instant() {
    const size_t told = world_.happenings().size();
    world_.end_instant();
    if (options_.traced) trace_happenings(told);
    speak();
}

bool SimSession::settle() {
    assert(now() == Time{});
    for (Duration held{}; !settled() && held < kSettleWithin; held += kExchangeEvery) {
        const std::vector<wire::Frame> delivered = take_frames();
        world_.hold_instant();
        listen(delivered);
        speak();
    }
    return settled();
}

// What was sent before this instant reaches the host at it, as it does the nodes.
std::vector<wire::Frame> SimSession::take_frames() {
    std::vector<wire::Frame> frames;
    wire::Frame frame;
    while (world_.bus().take(link_, frame)) frames.push_back(frame);
    return frames;
}

void SimSession::listen(const std::vector<wire::Frame>& delivered) {
    clock_ += kExchangeEvery;
    if (options_.traced) trace_happenings(0);
    for (const wire::Frame& frame : delivered) network_.receive(clock_, frame);
    if (network_.next_tick() <= clock_) network_.tick(clock_);
    for (const debug::Event& event : network_.take_events()) hear(event);
}

void SimSession::speak() {
    if (!waiting_.empty() && all_described()) place_files();
    send_ready();
    for (const wire::Frame& out : network_.take_frames()) world_.bus().receive(link_, out);
}

// ---- a plan beside it ----

Status SimSession::emit(const std::string& event, std::span<const int16_t> arguments) {
    const Status sent = network_.emit(event, arguments);
    if (!sent.ok() || !options_.traced) return sent;
    trace_ += TraceLine(now(), "event")
                  .number("node", wire::kHostId)
                  .text("name", event)
                  .words("args", arguments)
                  .done();
    return sent;
}

std::vector<debug::UserEvent> SimSession::take_heard() {
    return std::exchange(heard_, {});
}

void SimSession::reset() {
    world_.reset();
    rest_ = {};
    events_.clear();
    if (options_.traced) trace_ += TraceLine(world_.now(), "reset").done();
    for (Robot& robot : robots_) {
        robot.fault.clear();
        if (robot.script && !robot.script->program.bytecode.empty()) {
            robot.script->stage = Stage::Ready;
        }
    }
}

bool SimSession::settled() const {
    const auto waits = [](const Robot& robot) {
        return robot.script && robot.script->stage != Stage::Runs &&
               robot.script->stage != Stage::Failed;
    };
    return waiting_.empty() && std::none_of(robots_.begin(), robots_.end(), waits);
}

// ---- what the bus says ----

void SimSession::hear(const debug::Event& event) {
    if (const auto* sent = std::get_if<debug::UserEvent>(&event.what)) {
        hear_user_event(event, *sent);
        return;
    }
    Robot* robot = robot_of(event.node);
    if (robot == nullptr) return;
    if (const auto* fault = std::get_if<debug::Fault>(&event.what)) {
        hear_fault(*robot, *fault);
    } else if (const auto* done = std::get_if<debug::RequestDone>(&event.what)) {
        hear_done(*robot, *done);
    } else if (const auto* changed = std::get_if<debug::StateChanged>(&event.what)) {
        if (!options_.traced) return;
        trace_ += TraceLine(now(), "state")
                      .number("node", event.node)
                      .text("state", debug::name_of(changed->state))
                      .done();
    }
}

void SimSession::hear_user_event(const debug::Event& event, const debug::UserEvent& sent) {
    const std::string name = sent.name.empty() ? std::to_string(sent.number) : sent.name;
    if (options_.heard && heard_.size() < kHeardMax) heard_.push_back(sent);
    if (events_.size() < kEventNamesMax || events_.contains(name)) {
        EventCount& count = events_[name];
        count = {name, count.count + 1, sent.arguments, now()};
    }
    const Robot* robot = robot_of(event.node);
    const std::string from = robot != nullptr ? label(*robot) : "a host";
    note(NoteKind::Event, from + ": " + name + words_of(sent.arguments));
    // Events of nodes are traced as they happen (trace_happenings); hosts speak between the steps.
    if (!options_.traced || robot != nullptr) return;
    trace_ += TraceLine(now(), "event")
                  .number("node", event.node)
                  .text("name", name)
                  .words("args", sent.arguments)
                  .done();
}

void SimSession::hear_fault(Robot& robot, const debug::Fault& fault) {
    std::string where = label(robot);
    if (robot.script && fault.at.line > 0) {
        const int line = fault.at.line + robot.script->script.first_line - 1;
        where = robot.script->path + ":" + std::to_string(line);
    }
    const std::string sentence = where + ": " + fault.text;
    if (fault.kind == debug::FaultKind::Killed) return;  // the script goes on with its next event
    robot.fault = sentence;
    note(NoteKind::Fault, sentence);
}

void SimSession::hear_done(Robot& robot, const debug::RequestDone& done) {
    if (!robot.script || !(robot.script->request == done.request)) return;
    Assignment& script = *robot.script;
    if (script.stage != Stage::Sent) return;
    if (done.error) {
        script.stage = Stage::Failed;
        note(NoteKind::Trouble, script.path + ": " + done.error->what);
        return;
    }
    script.stage = Stage::Runs;
    robot.fault.clear();
    note(NoteKind::Loaded, script.path + " runs on " + label(robot) + ", " +
                               std::to_string(script.program.bytecode.size()) + " words");
}

void SimSession::trace_happenings(size_t first) {
    for (const sim::Happening& happening : world_.happenings().subspan(first)) {
        const Robot* robot = robot_of(happening.robot);
        const std::string name = robot != nullptr ? robot->name : "";
        if (const auto* sent = std::get_if<sim::Emitted>(&happening.what)) {
            const auto& events = network_.common().events;
            const std::string event = sent->event < events.size() ? events[sent->event].name
                                                                  : std::to_string(sent->event);
            trace_ += TraceLine(happening.at, "event")
                          .number("node", happening.node)
                          .text("name", event)
                          .words("args", sent->arguments)
                          .done();
        } else if (const auto* fault = std::get_if<sim::Fault>(&happening.what)) {
            trace_ += TraceLine(happening.at, "fault")
                          .number("node", happening.node)
                          .text("what", fault->what)
                          .number("pc", fault->pc)
                          .done();
        } else if (const auto* pose = std::get_if<sim::PoseNote>(&happening.what)) {
            trace_ += TraceLine(happening.at, "pose")
                          .text("robot", name)
                          .real("x", pose->pose.at.x)
                          .real("y", pose->pose.at.y)
                          .real("angle", pose->pose.angle)
                          .done();
        } else if (const auto* contact = std::get_if<sim::Contact>(&happening.what)) {
            trace_ += TraceLine(happening.at, "contact")
                          .text("robot", name)
                          .text("with", contact->with)
                          .done();
        }
    }
}

void SimSession::note(NoteKind kind, std::string text) {
    // Robots that share a script share its mistakes.
    const bool about_script = kind == NoteKind::Mistakes || kind == NoteKind::Warnings;
    const bool again =
        about_script && !notes_.empty() && notes_.back().kind == kind && notes_.back().text == text;
    if (notes_.size() < kNotesMax && !again) notes_.push_back({now(), kind, std::move(text)});
}

// ---- looking ----

std::vector<RobotState> SimSession::robots() const {
    std::vector<RobotState> states;
    for (const Robot& robot : robots_) {
        RobotState state{robot.id, robot.node, "", {}, robot.script.has_value(), robot.fault};
        if (const debug::NodeView* node = network_.node(robot.node)) {
            state.node_name = node->name;
            state.state = node->state;
        }
        states.push_back(std::move(state));
    }
    return states;
}

std::vector<std::pair<std::string, std::span<const int16_t>>> SimSession::script_variables(
    sim::RobotId id) const {
    std::vector<std::pair<std::string, std::span<const int16_t>>> list;
    const Robot* robot = robot_of(id);
    const debug::NodeView* node = robot != nullptr ? network_.node(robot->node) : nullptr;
    if (node == nullptr || !node->program) return list;
    size_t own = 0;
    for (const aesl::NamedVariable& variable : node->target.variables) own += variable.size;
    const std::span<const int16_t> memory = world_.variables(id);
    for (const aesl::VariablePlace& place : node->program->variables) {
        if (place.address < own || size_t{place.address} + place.size > memory.size()) continue;
        list.emplace_back(place.name, memory.subspan(place.address, place.size));
    }
    return list;
}

std::span<const int16_t> SimSession::node_variable(sim::RobotId id, std::string_view name) const {
    const Robot* robot = robot_of(id);
    const debug::NodeView* node = robot != nullptr ? network_.node(robot->node) : nullptr;
    if (node == nullptr) return {};
    const std::span<const int16_t> memory = world_.variables(id);
    size_t address = 0;
    for (const aesl::NamedVariable& variable : node->target.variables) {
        if (address + variable.size > memory.size()) return {};
        if (variable.name == name) return memory.subspan(address, variable.size);
        address += variable.size;
    }
    return {};
}

const aesl::Target* SimSession::target(sim::RobotId id) const {
    const Robot* robot = robot_of(id);
    const debug::NodeView* node = robot != nullptr ? network_.node(robot->node) : nullptr;
    return node != nullptr && node->described ? &node->target : nullptr;
}

std::vector<EventCount> SimSession::events() const {
    std::vector<EventCount> list;
    for (const auto& [name, count] : events_) list.push_back(count);
    std::stable_sort(list.begin(), list.end(),
                     [](const EventCount& a, const EventCount& b) { return a.last > b.last; });
    return list;
}

std::vector<std::string> SimSession::mistakes() const {
    std::vector<std::string> lines;
    for (const auto& [path, sentence] : file_mistakes_) lines.push_back(sentence);
    for (const Robot& robot : robots_) {
        if (!robot.script) continue;
        const auto& more = robot.script->mistakes;
        // The same script on several robots has the same mistakes: said once.
        const bool known =
            !more.empty() && std::find(lines.begin(), lines.end(), more.front()) != lines.end();
        if (!known) lines.insert(lines.end(), more.begin(), more.end());
    }
    return lines;
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

SimSession::Robot* SimSession::robot_of(debug::NodeId node) {
    const auto found = std::find_if(robots_.begin(), robots_.end(),
                                    [node](const Robot& robot) { return robot.node == node; });
    return found == robots_.end() ? nullptr : &*found;
}

const SimSession::Robot* SimSession::robot_of(sim::RobotId id) const {
    const auto found = std::find_if(robots_.begin(), robots_.end(),
                                    [id](const Robot& robot) { return robot.id == id; });
    return found == robots_.end() ? nullptr : &*found;
}

std::string SimSession::label(const Robot& robot) const {
    return robot.name.empty() ? "node " + std::to_string(robot.node) : robot.name;
}

Result<SimSession> open_sim(const std::string& path, SimOptions options) {
    namespace fs = std::filesystem;
    const std::string text = TRY(read_file(path));
    options.world.folder = fs::path(path).parent_path().string();
    if (options.world.folder.empty()) options.world.folder = ".";
    SimSession session(TRY(sim::World::load(text, path, options.world)), options);
    const auto& robots = session.world().definition().robots;
    const auto views = session.world().robots();
    for (size_t i = 0; i < robots.size() && i < views.size(); i++) {
        if (robots[i].script.empty()) continue;
        const std::string script = (fs::path(options.world.folder) / robots[i].script).string();
        const std::string source = TRY(read_file(script));
        session.load_for(views[i].id, script, source);
    }
    return session;
}

}  // namespace vagus::session
