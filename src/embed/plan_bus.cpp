#include "embed/plan_bus.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

#include "debug/network.hpp"
#include "hub/hub.hpp"
#include "net/network.hpp"
#include "session/bus_ears.hpp"

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
          own(hub.add({.name = "plan"}).value()) {
        network.set_common(options.common);
    }

    Status connect();
    void discover();
    void emit(const run::BusEvent& event);
    void work(const std::function<void(run::BusEvent)>& hear);
    void wake() { net.wake(); }

    session::BusNames names;
    std::atomic<bool> stopping = false;
    std::thread thread;

private:
    std::vector<run::BusEvent> turn(Time deadline);
    void note(const std::vector<net::Event>& happened);
    void take_unsent();
    void farewell();

    PlanBusOptions options;
    session::BusEars ears;
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
        if (auto one = ears.hear(event)) heard.push_back(std::move(*one));
    }
    return heard;
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
    for (const auto& event : events) (void)network.emit(event.name, event.arguments).ok();
}

void PlanBus::Insides::work(const std::function<void(run::BusEvent)>& hear) {
    while (!stopping) {
        for (run::BusEvent& event : turn(Time::max())) hear(std::move(event));
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
    // make_unique cannot reach the constructor.
    return std::unique_ptr<PlanBus>(new PlanBus(std::move(insides)));
}

const session::BusNames& PlanBus::names() const {
    return insides_->names;
}

void PlanBus::join(run::RunOptions& options) {
    Insides& insides = *insides_;
    options.may_emit = [&insides](const run::BusEvent& event) {
        return insides.names.may_emit(event);
    };
    options.on_emit = [&insides](const run::BusEvent& event) { insides.emit(event); };
}

void PlanBus::start(std::function<void(run::BusEvent)> hear) {
    insides_->stopping = false;
    insides_->thread =
        std::thread([&insides = *insides_, hear = std::move(hear)] { insides.work(hear); });
}

void PlanBus::stop() {
    if (!insides_->thread.joinable()) return;
    insides_->stopping = true;
    insides_->wake();
    insides_->thread.join();
}

}  // namespace vagus::embed
