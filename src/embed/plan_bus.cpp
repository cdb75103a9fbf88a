#include "embed/plan_bus.hpp"

#include <algorithm>
#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "debug/roll_call.hpp"
#include "hub/hub.hpp"
#include "net/end_signal.hpp"
#include "net/links.hpp"
#include "session/brake.hpp"
#include "session/bus_ears.hpp"
#include "session/rival_plans.hpp"
#include "session/stopped_by_others.hpp"

namespace vagus::embed {

namespace {

using namespace std::chrono_literals;

constexpr Duration kRunsWithin = 3s;      // for nodes that were stopped to run again
constexpr Duration kSettles = 300ms;      // then they may say that earlier work of theirs was ended
constexpr Duration kFarewellWithin = 2s;  // for what was emitted to leave
constexpr Duration kClosedWithin = 200ms;  // for the peer to close behind it
// An actor that works there says it first, after kStoppedMax, and names its work.
constexpr Duration kStoppedByOthersMax = toolbox::kStoppedMax + 500ms;

using How = session::Stopping::How;

using State = session::StopNode::State;

bool is_moving(const std::vector<session::StopNode>& nodes) {
    return std::any_of(nodes.begin(), nodes.end(),
                       [](const auto& node) { return node.state == State::Moving; });
}

bool is_at_rest(const std::vector<session::StopNode>& nodes) {
    return std::all_of(nodes.begin(), nodes.end(),
                       [](const auto& node) { return node.state == State::Stopped; });
}

}  // namespace

class PlanBus::Insides {
public:
    Insides(PlanBusOptions its_options, toolbox::BusNodes& nodes)
        : names(its_options.common, its_options.project),
          options(std::move(its_options)),
          ears(nodes),
          rivals(options.starts, SplitMix64(options.seed)),
          own(hub.add({.name = "plan"}).value()) {
        network.set_common(options.common);
    }

    // Wakes whoever waits here: an end was asked for.
    void wake() { net.wake(); }
    Status connect();
    void discover();
    void emit(const run::BusEvent& event);
    void work(run::RealTime& run);
    Status check_single() const;
    Status begin_at_rest();
    void stop_robot();
    std::vector<session::StopNode> leave(How how);
    void abandon();
    uint16_t first_token() { return rivals.random_token(); }
    void end_when_stopped() { ends_when_stopped = true; }
    void brake_as_a_whole() { brakes = true; }
    void hold_nodes(std::set<debug::NodeId> nodes);
    void set_tap(BusTap* follows);
    BusTap* follower() const { return tap; }

    session::BusNames names;
    std::thread thread;

private:
    std::vector<run::BusEvent> turn(Time deadline);
    void hear(uint32_t frame, std::vector<run::BusEvent>& heard);
    void tell_sent(const wire::Frame& frame);
    void look_for_held(run::RealTime& run);
    void look_for_stopped(run::RealTime& run);
    void look_for_missing(const debug::Event& event);
    void hold_what_brakes(run::RealTime& run);
    bool is_known_at_rest(const std::vector<session::StopNode>& read) const;
    void look_for_rivals(const debug::Event& event);
    void note(const std::vector<net::Event>& happened);
    void take_unsent();
    bool may_send(const run::BusEvent& event) const;
    bool is_worked_on(debug::NodeId id) const;
    void begin_to_stop(How how);
    std::vector<session::StopNode> await_rest();
    void run_what_is_stopped();
    void farewell();

    PlanBusOptions options;
    session::BusEars ears;
    session::RivalPlans rivals;
    session::StoppedByOthers stopped_by_others{kStoppedByOthersMax};
    bool ends_when_stopped = false;
    session::Brake brake;
    bool brakes = false;                  // nobody else does it
    bool is_working = false;              // a run is under way
    std::set<debug::NodeId> held_braked;  // the plan waits for them
    bool has_let_run = false;             // scripts, for a plan that has not begun
    std::optional<uint16_t> moved_to;     // our tokens are to count from here on
    BusTap* tap = nullptr;
    std::deque<run::BusEvent> emitted;  // with a tap: by the plan, whose frames are not sent yet
    debug::Network network;
    hub::Hub hub;
    net::Links net;  // after the hub: it goes first
    hub::LinkId own;
    hub::LinkId peer;
    bool connected = false;
    std::string lost;                          // why
    std::optional<debug::RollCall> roll_call;  // while it is open
    session::Stopping stopping;
    bool is_stopping = false;              // stopping has begun
    std::vector<session::StopNode> left;   // how it was when the thread ended
    std::atomic<bool> stop_asked = false;  // … or is to
    std::atomic<bool> leaving = false;
    How leaving_how = How::Rest;  // before `leaving`
    std::mutex mutex;             // guards what follows
    std::vector<run::BusEvent> unsent;
    std::optional<std::set<debug::NodeId>> held;  // news
};

Status PlanBus::Insides::connect() {
    const net::Target target = TRY(net::parse_target(options.target));
    (void)TRY(net.connect(hub, target, {.retry = net::Retry::Forever}));
    while (!connected && lost.empty() && !net::end_asked()) note(net.poll(Time::max()));
    if (connected) return Status::done();
    if (!lost.empty()) return Error{Code::Unavailable, lost};
    return Error{Code::Unavailable, net::end_asked_by() + " came before " + options.target +
                                        " was there; the plan was not begun"};
}

void PlanBus::Insides::discover() {
    roll_call.emplace(network, net.now(), debug::RollCallOptions());
    while (connected && !net::end_asked() && !roll_call->over(network, net.now())) {
        (void)turn(roll_call->next());
    }
    roll_call.reset();
}

std::vector<run::BusEvent> PlanBus::Insides::turn(Time deadline) {
    take_unsent();
    network.tick(net.now());
    if (is_stopping) {
        stopping.tick(net.now());
        deadline = std::min(deadline, stopping.next_tick());
    }
    for (const wire::Frame& frame : network.take_frames()) {
        if (tap) tell_sent(frame);
        hub.receive(own, frame);
    }
    note(net.poll(std::min(deadline, network.next_tick())));
    std::vector<run::BusEvent> heard;
    hear(0, heard);
    wire::Frame frame;
    while (hub.take(own, frame)) {
        const uint32_t number = tap ? tap->frame(frame, nullptr) : 0;
        network.receive(net.now(), frame);
        hear(number, heard);
    }
    return heard;
}

// What the network has to tell, of that frame.
void PlanBus::Insides::hear(uint32_t frame, std::vector<run::BusEvent>& heard) {
    for (debug::Event& event : network.take_events()) {
        event.frame = frame;
        if (roll_call) roll_call->hear(event);
        look_for_rivals(event);
        if (is_stopping) stopping.hear(event);
        stopped_by_others.hear(event);
        look_for_missing(event);
        if (tap && std::holds_alternative<debug::NodeDescribed>(event.what)) {
            tap->described(*network.node(event.node));
        }
        if (tap) tap->happened(event);
        if (auto one = ears.hear(event)) heard.push_back(std::move(*one));
    }
}

void PlanBus::Insides::tell_sent(const wire::Frame& frame) {
    const bool of_plan = wire::is_user_event(frame.type) && !emitted.empty();
    (void)tap->frame(frame, of_plan ? &emitted.front() : nullptr);
    if (of_plan) emitted.pop_front();
}

void PlanBus::Insides::set_tap(BusTap* follows) {
    tap = follows;
    emitted.clear();
    if (!tap) return;
    tap->begin(options.common, [this] { return net.now(); });
    for (const debug::NodeId id : network.nodes()) {
        if (network.node(id)->described) tap->described(*network.node(id));
    }
}

// Another host starts work on the nodes of this plan.
void PlanBus::Insides::look_for_rivals(const debug::Event& event) {
    const auto* sent = std::get_if<debug::UserEvent>(&event.what);
    if (!sent || event.node != wire::kHostId) return;
    const auto rival = rivals.hear({sent->name, sent->arguments});
    if (!rival) return;
    if (rival->move_to) moved_to = rival->move_to;
    if (!rival->is_news) return;
    options.tell("another plan or host on " + options.target +
                 " commands the same nodes as this plan: it sent \"" + sent->name +
                 "\"; a node does one thing at a time, so end one of the two");
}

// A plan is for one robot.
Status PlanBus::Insides::check_single() const {
    for (const toolbox::NodeNames& need : options.needs) {
        for (const std::string& name : need) {
            std::vector<std::string> ids;
            for (const debug::NodeId id : network.nodes()) {
                const debug::NodeView& node = *network.node(id);
                if (node.connected && node.described && node.name == name) {
                    ids.push_back(std::to_string(id));
                }
            }
            if (ids.size() > 1) {
                return Error{Code::Refused, "the plan needs one node \"" + name + "\", but on " +
                                                options.target + " there are " +
                                                std::to_string(ids.size()) + ", with the ids " +
                                                list_of({ids.begin(), ids.end()}) +
                                                "; a plan is for one robot, and a robot has a bus "
                                                "of its own: connect to that of the robot"};
            }
            if (!ids.empty()) break;  // the first that is there does the work
        }
    }
    return Status::done();
}

void PlanBus::Insides::note(const std::vector<net::Event>& happened) {
    for (const net::Event& event : happened) {
        if (event.kind == net::EventKind::Opened) {
            peer = event.link;
            if (!lost.empty()) options.tell(event.what + " is connected again");
            connected = true;
        } else if (event.kind == net::EventKind::Closed || event.kind == net::EventKind::Failed) {
            if (connected && !leaving) options.tell(event.what);
            connected = false;
            lost = event.what;
        }
    }
}

// From the deciding thread of the run.
void PlanBus::Insides::emit(const run::BusEvent& event) {
    {
        const std::lock_guard lock(mutex);
        if (unsent.size() >= kUnsentMax) return;
        unsent.push_back(event);
    }
    net.wake();
}

void PlanBus::Insides::take_unsent() {
    std::vector<run::BusEvent> events;
    {
        const std::lock_guard lock(mutex);
        events.swap(unsent);
    }
    // Refused is only what a supervisor emits as it stops: may_emit() was not asked.
    for (const auto& event : events) {
        if (!may_send(event)) continue;
        rivals.said(event);
        if (network.emit(event.name, event.arguments).ok() && tap) emitted.push_back(event);
    }
}

// A robot that is being stopped is not told to move again by what the plan says as it ends.
bool PlanBus::Insides::may_send(const run::BusEvent& event) const {
    return !stop_asked || options.stops.contains(event.name);
}

void PlanBus::Insides::work(run::RealTime& run) {
    brake.begin(network);
    is_working = true;
    while (!leaving) {
        if (stop_asked && !is_stopping) begin_to_stop(How::Stop);
        const Time due = stop_asked ? Time::max() : stopped_by_others.next();
        for (run::BusEvent& event : turn(due)) run.hear(std::move(event));
        look_for_held(run);
        hold_what_brakes(run);
        look_for_stopped(run);
        if (const auto token = std::exchange(moved_to, std::nullopt)) {
            if (tap) tap->tokens(*token);
            run.move_tokens(*token);
        }
    }
    is_working = false;
    has_let_run = false;
    const bool stop = stop_asked;
    if (!is_stopping) begin_to_stop(stop ? How::Stop : leaving_how);
    left = await_rest();
    farewell();
}

void PlanBus::Insides::hold_nodes(std::set<debug::NodeId> nodes) {
    {
        const std::lock_guard lock(mutex);
        held = std::move(nodes);
    }
    net.wake();
}

void PlanBus::Insides::look_for_held(run::RealTime& run) {
    std::optional<std::set<debug::NodeId>> nodes;
    {
        const std::lock_guard lock(mutex);
        nodes = std::exchange(held, std::nullopt);
    }
    if (!nodes) return;
    stopped_by_others.hold(*nodes, net.now());
    for (run::BusEvent& event : ears.hold(std::move(*nodes))) run.hear(std::move(event));
}

// A plan must not wait for ever for a node that another host has stopped.
void PlanBus::Insides::look_for_stopped(run::RealTime& run) {
    for (const debug::NodeId id : stopped_by_others.take_due(net.now())) {
        const bool ends = ends_when_stopped && !stop_asked && is_worked_on(id);
        if (!ends) continue;
        const std::string why = toolbox::was_stopped(network.node(id)->name);
        if (tap) tap->fails(why);
        run.fail(why);
    }
}

// While a node is missing, a reflex is: the others that move wait for it.
void PlanBus::Insides::look_for_missing(const debug::Event& event) {
    if (!brakes || !is_working || stop_asked || is_stopping) return;
    const auto orders = brake.hear(network, options.safe_stop, event);
    std::vector<std::string> paused;
    for (const debug::NodeId id : orders.pause) {
        (void)network.pause_now(id);
        paused.push_back(session::name_with_id(network, id));
    }
    for (const debug::NodeId id : orders.make_safe) {
        session::make_safe(network, options.safe_stop, id);
    }
    for (const debug::NodeId id : orders.run) (void)network.run(id).ok();
    if (paused.empty()) return;
    const std::string cause = session::name_with_id(network, *orders.cause);
    options.tell(cause + " does not run: what moves is paused until it does: " +
                 list_of({paused.begin(), paused.end()}));
}

// At a breakpoint somebody looks for a mistake, which may take long.
void PlanBus::Insides::hold_what_brakes(run::RealTime& run) {
    if (!brakes) return;
    auto held_now = brake.at_breakpoint() ? brake.braked() : std::set<debug::NodeId>();
    if (held_now == held_braked) return;
    held_braked = held_now;
    stopped_by_others.hold(held_now, net.now());
    for (run::BusEvent& event : ears.hold(std::move(held_now))) run.hear(std::move(event));
}

// ---- coming to rest ----

bool PlanBus::Insides::is_worked_on(debug::NodeId id) const {
    if (options.works_anywhere || options.needs.empty()) return true;
    const std::string& name = network.node(id)->name;
    return std::any_of(options.needs.begin(), options.needs.end(), [&name](const auto& need) {
        return std::find(need.begin(), need.end(), name) != need.end();
    });
}

void PlanBus::Insides::begin_to_stop(How how) {
    is_stopping = true;
    if (how == How::Stop) return stopping.begin(network, options.safe_stop, how, net.now());
    std::vector<debug::NodeId> nodes;
    for (const debug::NodeId id : network.nodes()) {
        const bool named = options.safe_stop.contains(network.node(id)->name);
        if (named && network.node(id)->connected && is_worked_on(id)) nodes.push_back(id);
    }
    const session::Stopping::Manner manner{.how = how};
    stopping.begin(network, options.safe_stop, manner, net.now(), nodes);
}

std::vector<session::StopNode> PlanBus::Insides::await_rest() {
    const Time latest = net.now() + kRestWithin;
    while (connected && !stopping.settled() && net.now() < latest) (void)turn(latest);
    is_stopping = false;
    return stopping.report();
}

Status PlanBus::Insides::begin_at_rest() {
    begin_to_stop(How::Look);
    const auto before = await_rest();
    if (net::end_asked()) return Status::done();
    if (!is_known_at_rest(before)) {
        begin_to_stop(How::Stop);
        const auto nodes = await_rest();
        const std::string found = session::describe(nodes);
        if (is_moving(nodes)) {
            return Error{Code::Refused, "the robot on " + options.target +
                                            " moves, and does not come to rest when it is "
                                            "stopped (" +
                                            found +
                                            "); find out what drives it, and end that first"};
        }
        const char* const why = is_moving(before) ? " was moving" : " did not say how it is";
        options.tell("the robot on " + options.target + why +
                     ": it was stopped before the plan begins; " + found);
    }
    run_what_is_stopped();
    return Status::done();
}

// A node of which nothing can be read may do what it likes while its program runs.
bool PlanBus::Insides::is_known_at_rest(const std::vector<session::StopNode>& read) const {
    const auto ids = network.nodes();
    return is_at_rest(read) && std::none_of(ids.begin(), ids.end(), [this](debug::NodeId id) {
               return session::may_move_unread(*network.node(id), options.safe_stop);
           });
}

// Scripts keep their variables. Without them the plan would wait for nodes that hear nothing, or
// drive without a reflex. One that was stopped is paused as soon as an event waits for it: that is
// what somebody said before this plan, and another Stop drops it.
void PlanBus::Insides::run_what_is_stopped() {
    const auto stopped = [this](debug::NodeId id) {
        const debug::NodeView* node = network.node(id);
        return node && node->connected &&
               (node->state == debug::ProgramState::Stopped ||
                node->state == debug::ProgramState::Paused);
    };
    std::vector<debug::NodeId> asked;
    if (net::end_asked()) return;
    for (const debug::NodeId id : network.nodes()) {
        if (!stopped(id)) continue;
        has_let_run = true;
        if (network.node(id)->state == debug::ProgramState::Paused) (void)network.stop_now(id);
        if (network.run(id).ok()) asked.push_back(id);
    }
    const auto goes_on = [this] { return connected && !net::end_asked(); };
    const Time latest = net.now() + kRunsWithin;
    while (goes_on() && std::any_of(asked.begin(), asked.end(), stopped) && net.now() < latest) {
        (void)turn(latest);
    }
    const Time settled = net.now() + kSettles;
    while (!asked.empty() && goes_on() && net.now() < settled) (void)turn(settled);
}

void PlanBus::Insides::stop_robot() {
    stop_asked = true;
    net.wake();
}

std::vector<session::StopNode> PlanBus::Insides::leave(How how) {
    if (!thread.joinable()) return {};
    leaving_how = how;
    leaving = true;
    net.wake();
    thread.join();
    stop_asked = false;
    leaving = false;
    return left;
}

// Scripts were let run for a plan that never began: they may drive.
void PlanBus::Insides::abandon() {
    if (!std::exchange(has_let_run, false) || !connected) return;
    begin_to_stop(How::Stop);
    const auto nodes = await_rest();
    options.tell("the plan was not begun; the robot was stopped; " + session::describe(nodes));
    farewell();
}

// Without it, what the peer sends meanwhile could make its system throw away our last frames.
void PlanBus::Insides::farewell() {
    const Time end = net.now() + kFarewellWithin;
    do {
        (void)turn(net.now());
    } while (net.has_unwritten() && connected && net.now() < end);
    if (!connected || !net.end_writing(hub, peer)) return;
    const Time closed_by = net.now() + kClosedWithin;
    while (connected && net.now() < closed_by) note(net.poll(closed_by));
}

// ---- the public side ----

PlanBus::PlanBus(std::unique_ptr<Insides> insides) : insides_(std::move(insides)) {}

PlanBus::~PlanBus() {
    (void)leave(How::Stop);
    insides_->abandon();
}

Result<std::unique_ptr<PlanBus>> PlanBus::open(PlanBusOptions options, toolbox::BusNodes& nodes) {
    auto insides = std::make_unique<Insides>(std::move(options), nodes);
    // Before scripts run: a request to end must not come too early.
    const net::EndWatcher end_watcher([&insides = *insides] { insides.wake(); });
    TRY(insides->connect());
    insides->discover();
    TRY(insides->check_single());
    TRY(insides->begin_at_rest());
    // make_unique cannot reach the constructor.
    return std::unique_ptr<PlanBus>(new PlanBus(std::move(insides)));
}

void PlanBus::join(run::RunOptions& options) {
    Insides& insides = *insides_;
    options.first_token = insides.first_token();
    options.may_emit = [&insides](const run::BusEvent& event) {
        return insides.names.may_emit(event);
    };
    options.on_emit = [&insides](const run::BusEvent& event) { insides.emit(event); };
    BusTap* const tap = insides.follower();
    options.on_hear = {};
    if (!tap) return;
    tap->tokens(options.first_token);
    options.on_hear = [tap](const run::BusEvent& event, Time at) { tap->hears(event, at); };
}

void PlanBus::tap(BusTap* tap) {
    insides_->set_tap(tap);
}

void PlanBus::end_when_stopped() {
    insides_->end_when_stopped();
}

void PlanBus::brake_as_a_whole() {
    insides_->brake_as_a_whole();
}

void PlanBus::hold_nodes(std::set<debug::NodeId> nodes) {
    insides_->hold_nodes(std::move(nodes));
}

void PlanBus::start(run::RealTime& run) {
    insides_->thread = std::thread([&insides = *insides_, &run] { insides.work(run); });
}

void PlanBus::stop_robot() {
    insides_->stop_robot();
}

std::vector<session::StopNode> PlanBus::leave(How how) {
    return insides_->leave(how);
}

}  // namespace vagus::embed
