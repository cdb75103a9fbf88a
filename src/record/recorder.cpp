#include "record/recorder.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <algorithm>

#include "base/base64.hpp"
#include "base/json.hpp"
#include "base/seconds.hpp"
#include "record/bus_messages.hpp"
#include "record/scene_update.hpp"
#include "sim/png.hpp"
#include "wire/protocol.hpp"

namespace vagus::record {

namespace {

// Most instants have no sample: they are asked one question.
constexpr Duration kSamplesEvery = kVariablesEvery;
static_assert(kPictureEvery % kSamplesEvery == Duration::zero());
static_assert(kPosesEvery % kSamplesEvery == Duration::zero());
static_assert(kCamerasEvery % kSamplesEvery == Duration::zero());
static_assert(kCheckEvery % kSamplesEvery == Duration::zero());

std::string hex(uint64_t hash) {
    return fmt::format("{:016x}", hash);
}

uint64_t hash_of(std::string_view bytes, uint64_t seed = 0) {
    return XXH3_64bits_withSeed(bytes.data(), bytes.size(), seed);
}

// The bits themselves: a pose that differs in the last of them is another.
std::string bytes_of(const sim::Pose& pose) {
    std::string bytes(sizeof pose, '\0');
    std::array<double, 3> numbers = {pose.at.x, pose.at.y, pose.angle};
    std::copy_n(reinterpret_cast<const char*>(numbers.data()), sizeof numbers, bytes.data());
    return bytes;
}

// ---- foxglove.CompressedImage ----

std::string compressed_image(const sim::Picture& picture, const std::string& robot, Time at) {
    return fmt::format(R"({{"timestamp":{},"frame_id":{},"data":"{}","format":"png"}})",
                       stamp_json(at), json_quote(robot), base64(sim::write_png(picture)));
}

}  // namespace

std::string state_hash(std::string_view check) {
    return hex(hash_of(check));
}

// ---- the recorder ----

Recorder::Recorder(Tape& tape, std::string_view run) : tape_(tape) {
    const uint16_t about = tape_.declare({.name = std::string(kRunTopic)});
    declare();
    tape_.put(about, Time{}, std::string(run));
}

Recorder::Recorder(Tape& tape, session::SimSession& robot) : tape_(tape), of_robot_(true) {
    declare();
    follow_bus(robot);
}

void Recorder::declare() {
    input_ = tape_.declare({.name = std::string(kInputTopic)});
    check_ = tape_.declare({.name = std::string(kCheckTopic)});
    trace_ = tape_.declare({.name = std::string(kTraceTopic)});
    states_ = tape_.declare({.name = std::string(kStatesTopic)});
}

Recorder::~Recorder() {
    if (session_ == nullptr) return;
    session_->forget_listeners();
    if (!of_robot_) session_->world().on_act({});
    session_->bus().on_receive({});
}

void Recorder::follow(session::SimSession& session) {
    follow_bus(session);
    poses_ = tape_.declare({.name = std::string(kPosesTopic),
                            .schema = "foxglove.SceneUpdate",
                            .may_be_dropped = true});
    scene_ = tape_.declare({.name = std::string(kSceneTopic), .schema = "foxglove.SceneUpdate"});
    if (!session.world().chaos().empty()) {
        chaos_ = tape_.declare({.name = std::string(kChaosTopic)});
    }
    session.world().on_act([this](const sim::Act& act) { input(act); });
    scene(now());
    poses(now());
}

Status check_cameras(const sim::World* world) {
    if (world == nullptr) {
        return Error{Code::Refused,
                     "--record-camera: only a simulated world has cameras to record; add --world, "
                     "or leave it out"};
    }
    const auto robots = world->robots();
    const bool any = std::any_of(robots.begin(), robots.end(), [world](const auto& robot) {
        return world->has_camera(robot.id);
    });
    if (any) return Status::done();
    return Error{Code::Refused,
                 "--record-camera: no robot of this world has a camera; a carbot has one"};
}

void Recorder::follow_cameras() {
    for (const sim::RobotView& robot : session_->world().robots()) {
        if (!session_->world().has_camera(robot.id)) continue;
        const std::string name(robot.name);
        const uint16_t topic = tape_.declare({.name = std::string(kCameraTopics) + name,
                                              .schema = "foxglove.CompressedImage",
                                              .may_be_dropped = true});
        cameras_.push_back({robot.id, name, topic});
    }
    pictures(now());
}

// The picture is packed where it is written, if there is time for it.
void Recorder::pictures(Time at) {
    for (const Camera& one : cameras_) {
        sim::Picture picture = std::move(session_->world().render(one.robot).value());
        const size_t bytes = picture.pixels.size();
        tape_.put_later(one.topic, at, bytes, [picture = std::move(picture), name = one.name, at] {
            return compressed_image(picture, name, at);
        });
    }
}

void Recorder::follow_bus(session::SimSession& session) {
    session_ = &session;
    frames_ = tape_.declare({.name = std::string(kFramesTopic), .json = false});
    events_ = tape_.declare({.name = std::string(kEventsTopic)});
    session.world().number_frames();
    session.on_frame([this](const wire::Frame& one, uint32_t number) { frame(one, number); });
    session.on_heard([this](const debug::Event& event) { heard(event); });
    session.on_instant([this] { instant(); });
    session.on_ahead([this] { input(HeardAhead{}); });
    for (const hub::LinkId link : session.bus().links()) {
        last_inside_ = std::max(last_inside_, link);
    }
    session.bus().on_receive(
        [this](hub::LinkId from, const wire::Frame& one) { from_outside(from, one); });
}

void Recorder::instant() {
    const Time at = now();
    if (chaos_ != 0) chaos();
    if (at % kSamplesEvery == Duration::zero()) samples(at);
    if (after_instant_) after_instant_(at);
}

void Recorder::samples(Time at) {
    look_for_nodes();
    const bool all = at % kPictureEvery == Duration::zero();
    for (Node& node : nodes_) variables(node, at, all);
    if (!of_robot_ && at % kPosesEvery == Duration::zero()) poses(at);
    if (at % kCamerasEvery == Duration::zero()) pictures(at);
    if (at % kCheckEvery == Duration::zero()) check(at);
}

void Recorder::input(InputWhat what) {
    input_at(now(), std::move(what));
}

void Recorder::input_at(Time at, InputWhat what) {
    if (std::exchange(turn_begins_, false)) ++turn_;
    tape_.put(input_, at, format_input({at, turn_, std::move(what)}));
}

void Recorder::hold() {
    input(HeldMoment{});
    session_->world().hold_instant();
}

void Recorder::script(const ScriptLoaded& script, const std::string& path) {
    input(script);
    session_->was_loaded(script.node, path, script.text);
}

void Recorder::from_outside(hub::LinkId from, const wire::Frame& frame) {
    if (from <= last_inside_) return;
    (void)session_->world().frame_numbers()->sent(session_->on_bus(frame), 0);
    input(frame);
}

void Recorder::end(Time at) {
    check(at);
}

// ---- the plan ----

void Recorder::trace(const plan::TraceEvent& event) {
    std::string line = plan::format_trace(event);
    plan_hash_ = hash_of(line, plan_hash_);
    // What plotters draw as lanes: names as numbers, in the order in which they came.
    const auto number = [this](std::string_view of, std::string_view name) {
        auto& known = numbers_[std::string(of)];
        return known.emplace(name, static_cast<int>(known.size()) + 1).first->second;
    };
    if (const auto* started = std::get_if<plan::ActorStarted>(&event.what)) {
        tape_.put(states_, event.at,
                  fmt::format(R"({{"t":{},"plan":{},"actor":{},"name":{},"state":0}})",
                              seconds_text(event.at), json_quote(event.plan),
                              number(event.plan, started->actor), json_quote(started->actor)));
    } else if (const auto* ended = std::get_if<plan::ActorEnded>(&event.what)) {
        tape_.put(states_, event.at,
                  fmt::format(R"({{"t":{},"plan":{},"actor":{},"name":{},"state":{},)"
                              R"("state_name":{}}})",
                              seconds_text(event.at), json_quote(event.plan),
                              number(event.plan, ended->actor), json_quote(ended->actor),
                              number(event.plan + "/" + std::string(ended->actor), ended->state),
                              json_quote(ended->state)));
    }
    tape_.put(trace_, event.at, std::move(line));
}

// ---- the bus ----

void Recorder::frame(const wire::Frame& frame, uint32_t number) {
    const Time at = now();
    const uint32_t cause = session_->world().frame_numbers()->cause_of(number);
    tape_.put(frames_, at, format_frame(text_, {number, cause, frame}));
}

void Recorder::heard(const debug::Event& event) {
    const auto* const sent = std::get_if<debug::UserEvent>(&event.what);
    if (sent == nullptr) return;
    tape_.put(events_, now(),
              format_event(text_, recorded_event(now(), event.frame, event.node, *sent)));
}

// ---- nodes ----

std::string Recorder::label_of(sim::RobotId robot, const std::string& name) const {
    const auto& robots = session_->world().definition().robots;
    return of_robot_ || robots.size() == 1 ? name : robots[robot.number - 1].name + "/" + name;
}

void Recorder::look_for_nodes() {
    const bool all_known =
        std::all_of(nodes_.begin(), nodes_.end(), [](const Node& node) { return node.topic != 0; });
    if (!nodes_.empty() && all_known) return;
    const std::vector<session::NodeState> states = session_->nodes();
    nodes_.resize(states.size());
    for (size_t i = 0; i < states.size(); ++i) {
        Node& node = nodes_[i];
        if (node.topic != 0 || states[i].name.empty()) continue;
        node.robot = states[i].robot;
        node.id = states[i].id;
        node.label = label_of(states[i].robot, states[i].name);
        node.topic =
            tape_.declare({.name = "/node/" + node.label + "/variables", .may_be_dropped = true});
    }
}

void Recorder::learn_variables(Node& node) {
    const aesl::Program* const program = session_->program(node.id);
    if (!node.variables.empty() && program == node.program) return;
    const aesl::Target* const target = session_->target(node.id);
    if (target == nullptr) return;
    node.program = program;
    node.pictured = false;
    node.variables.clear();
    uint16_t address = 0;
    for (const aesl::NamedVariable& one : target->variables) {
        node.variables.emplace_back(one.name, address, one.size);
        address = static_cast<uint16_t>(address + one.size);
    }
    if (program != nullptr) {
        for (const aesl::VariablePlace& one : program->variables) {
            if (one.address < address) continue;
            node.variables.emplace_back(one.name, one.address, one.size);
        }
    }
    node.named = 0;
    for (const RecordedVariable& one : node.variables) {
        node.named = std::max(node.named, size_t{one.address} + one.size);
    }
}

void Recorder::variables(Node& node, Time at, bool all) {
    if (node.topic == 0) return;
    learn_variables(node);
    if (node.variables.empty()) return;
    auto words = session_->world().variables(node.robot, node.id);
    words = words.first(std::min(words.size(), node.named));
    const bool picture = all || !node.pictured || words.size() != node.words.size();
    // As bytes: nearly always nothing has changed.
    if (!picture && std::ranges::equal(words, node.words)) return;
    const WordRange changed = picture ? WordRange{} : changed_words(node.words, words);
    told_.clear();
    for (const RecordedVariable& one : node.variables) {
        if (picture || (changed.touches(one) && has_changed(one, node.words, words))) {
            told_.push_back(&one);
        }
    }
    node.words.assign(words.begin(), words.end());
    node.pictured = true;
    tape_.put(node.topic, at, format_variables(text_, {told_, words, picture, at}));
}

// ---- the world ----

void Recorder::poses(Time at) {
    std::vector<Shape> shapes;
    std::string objects;
    for (const sim::RobotView& robot : session_->world().robots()) {
        shapes.push_back(shape_of(robot));
    }
    for (const sim::ObjectView& object : session_->world().objects()) {
        objects += key_of(object) + "\n";
        if (object.definition->mass > 0) shapes.push_back(shape_of(object));
    }
    if (objects != objects_) scene(at);
    constexpr size_t kBytesOfShape = 400;
    const size_t bytes = kBytesOfShape * shapes.size();
    tape_.put_later(poses_, at, bytes,
                    [shapes = std::move(shapes), at] { return scene_update(shapes, at); });
}

// All that is in the world; what has gone is deleted by that.
void Recorder::scene(Time at) {
    std::vector<Shape> shapes;
    objects_.clear();
    for (const sim::ObjectView& object : session_->world().objects()) {
        objects_ += key_of(object) + "\n";
        shapes.push_back(shape_of(object));
    }
    tape_.put(scene_, at, whole_scene(shapes, at));
}

// Faults as they begin and end.
void Recorder::chaos() {
    for (const sim::Happening& one : session_->world().happenings()) {
        const auto* const told = std::get_if<sim::ChaosNote>(&one.what);
        if (told == nullptr) continue;
        tape_.put(
            chaos_, one.at,
            fmt::format(R"({{"t":{},"fault":{},"what":{},"state":"{}"}})", seconds_text(one.at),
                        told->fault + 1, json_quote(told->what), told->begins ? "begins" : "ends"));
    }
}

// ---- checks ----

void Recorder::check(Time at) {
    tape_.put(check_, at, check_text(at));
}

std::string Recorder::check_text(Time at) const {
    std::string text = fmt::format(R"({{"t":{},"plan":"{}")", seconds_text(at), hex(plan_hash_));
    if (session_ != nullptr) text += ",\"nodes\":" + nodes_check();
    if (session_ != nullptr && !of_robot_) text += ",\"bodies\":" + bodies_check();
    return text + "}";
}

std::string Recorder::nodes_check() const {
    std::string nodes;
    for (const session::NodeState& node : session_->nodes()) {
        const std::string name = node.name.empty() ? std::to_string(node.id) : node.name;
        nodes += fmt::format("{}{}:\"{}\"", nodes.empty() ? "" : ",",
                             json_quote(label_of(node.robot, name)),
                             hex(hash_of(session_->world().state_of(node.robot, node.id))));
    }
    return "{" + nodes + "}";
}

std::string Recorder::bodies_check() const {
    std::string bodies;
    const auto add = [&bodies](const std::string& name, const sim::Pose& pose) {
        bodies += fmt::format("{}{}:\"{}\"", bodies.empty() ? "" : ",", json_quote(name),
                              hex(hash_of(bytes_of(pose))));
    };
    const sim::World& world = session_->world();
    for (const sim::RobotView& robot : world.robots()) add(std::string(robot.name), robot.pose);
    for (const sim::ObjectView& object : world.objects()) add(key_of(object), object.pose);
    return "{" + bodies + "}";
}

}  // namespace vagus::record
