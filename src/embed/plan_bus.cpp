#include "embed/plan_bus.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "debug/network.hpp"
#include "hub/hub.hpp"
#include "net/network.hpp"
#include "session/bus_ears.hpp"
#include "session/rival_plans.hpp"

namespace vagus::embed {

namespace {

using namespace std::chrono_literals;

constexpr Duration kQuiet = 300ms;         // after the last answer: all have answered
constexpr Duration kNodesWithin = 3s;      // for nodes to describe themselves
constexpr Duration kTurn = 20ms;           // while some are still to describe themselves
constexpr Duration kFarewellWithin = 2s;   // for what was emitted to leave
constexpr Duration kClosedWithin = 200ms;  // for the peer to close behind it

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

    Status connect();
    void discover();
    void emit(const run::BusEvent& event);
    void work(run::RealTime& run);
    Status check_single() const;
    uint16_t first_token() { return rivals.random_token(); }
    void wake() { net.wake(); }

    session::BusNames names;
    std::atomic<bool> stopping = false;
    std::thread thread;

private:
    std::vector<run::BusEvent> turn(Time deadline);
    void look_for_rivals(const debug::Event& event);
    void note(const std::vector<net::Event>& happened);
    void take_unsent();
    void farewell();

    PlanBusOptions options;
    session::BusEars ears;
    session::RivalPlans rivals;
    std::optional<uint16_t> moved_to;  // our tokens are to count from here on
    debug::Network network;
    hub::Hub hub;
    net::Network net;  // after the hub: it goes first
    hub::LinkId own;
    hub::LinkId peer;
    bool connected = false;
    std::string lost;  // why
    Time last_answer{};
    std::mutex mutex;  // guards what follows
    std::vector<run::BusEvent> unsent;
};

Status PlanBus::Insides::connect() {
    const net::Target target = TRY(net::parse_target(options.target));
    (void)TRY(net.connect(hub, target, {.retry = net::Retry::Forever}));
    while (!connected && lost.empty()) note(net.poll(Time::max()));
    if (!connected) return Error{Code::Unavailable, lost};
    return Status::done();
}

// Until nobody has answered for a while and all are described.
void PlanBus::Insides::discover() {
    last_answer = net.now();
    const Time latest = net.now() + kNodesWithin;
    const auto described = [this] {
        const auto nodes = network.nodes();
        return std::all_of(nodes.begin(), nodes.end(), [this](debug::NodeId id) {
            return !network.node(id)->connected || network.node(id)->described;
        });
    };
    while (connected && net.now() < latest) {
        if (net.now() >= last_answer + kQuiet && described()) return;
        (void)turn(std::min(latest, std::max(last_answer + kQuiet, net.now() + kTurn)));
    }
}

std::vector<run::BusEvent> PlanBus::Insides::turn(Time deadline) {
    take_unsent();
    network.tick(net.now());
    for (const wire::Frame& frame : network.take_frames()) hub.receive(own, frame);
    note(net.poll(std::min(deadline, network.next_tick())));
    wire::Frame frame;
    while (hub.take(own, frame)) network.receive(net.now(), frame);
    std::vector<run::BusEvent> heard;
    for (const debug::Event& event : network.take_events()) {
        if (!std::holds_alternative<debug::UserEvent>(event.what)) last_answer = net.now();
        look_for_rivals(event);
        if (auto one = ears.hear(event)) heard.push_back(std::move(*one));
    }
    return heard;
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
            if (connected && !stopping) options.tell(event.what);
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
        rivals.said(event);
        (void)network.emit(event.name, event.arguments).ok();
    }
}

void PlanBus::Insides::work(run::RealTime& run) {
    while (!stopping) {
        for (run::BusEvent& event : turn(Time::max())) run.hear(std::move(event));
        if (const auto token = std::exchange(moved_to, std::nullopt)) run.move_tokens(*token);
    }
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
    stop();
}

Result<std::unique_ptr<PlanBus>> PlanBus::open(PlanBusOptions options, toolbox::BusNodes& nodes) {
    auto insides = std::make_unique<Insides>(std::move(options), nodes);
    TRY(insides->connect());
    insides->discover();
    TRY(insides->check_single());
    // make_unique cannot reach the constructor.
    return std::unique_ptr<PlanBus>(new PlanBus(std::move(insides)));
}

const session::BusNames& PlanBus::names() const {
    return insides_->names;
}

void PlanBus::join(run::RunOptions& options) {
    Insides& insides = *insides_;
    options.first_token = insides.first_token();
    options.may_emit = [&insides](const run::BusEvent& event) {
        return insides.names.may_emit(event);
    };
    options.on_emit = [&insides](const run::BusEvent& event) { insides.emit(event); };
}

void PlanBus::start(run::RealTime& run) {
    insides_->stopping = false;
    insides_->thread = std::thread([&insides = *insides_, &run] { insides.work(run); });
}

void PlanBus::stop() {
    if (!insides_->thread.joinable()) return;
    insides_->stopping = true;
    insides_->wake();
    insides_->thread.join();
}

}  // namespace vagus::embed
