#include "serve/field/stop_only.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "debug/network.hpp"
#include "net/links.hpp"
#include "serve/field/versions.hpp"
#include "serve/target/bus_carrier.hpp"
#include "serve/target/stopping.hpp"
#include "serve/workbench/opened.hpp"
#include "session/stop_node_name.hpp"

namespace vagus::serve {

namespace {

// The nodes of one target, for as long as it takes to stop them.
class Bus {
public:
    Bus(net::Links& net, BusCarrier& carrier) : net_(net), carrier_(carrier) {}

    // True as soon as it is so, false when the time is over.
    template <typename IsSo>
    bool wait(Duration at_most, IsSo is_so) {
        const Time until = net_.now() + at_most;
        while (!is_so()) {
            if (net_.now() >= until) return false;
            turn(until);
        }
        return true;
    }
    bool connected() const { return carrier_.connection() == Connection::Connected; }
    bool all_described() const {
        const auto nodes = nodes_.nodes();
        return !nodes.empty() && std::all_of(nodes.begin(), nodes.end(), [this](debug::NodeId id) {
            return nodes_.node(id)->described;
        });
    }
    void list() { nodes_.list_nodes(); }
    StopReport stop(const session::SafeStop& safe) {
        std::optional<StopReport> report;
        stopping_.begin(nodes_, safe, {}, connected(), net_.now(),
                        [&report](const StopReport& told) { report = told; });
        (void)wait(2 * kStopWithin, [&report] { return report.has_value(); });
        return report.value_or(stopping_.report());
    }

private:
    void turn(Time until) {
        const Time now = net_.now();
        for (const Carried& carried : carrier_.take()) nodes_.receive(now, carried.frame);
        nodes_.tick(now);
        for (const debug::Event& event : nodes_.take_events()) (void)stopping_.hear(event);
        stopping_.tick(now);
        for (const wire::Frame& frame : nodes_.take_frames()) carrier_.send(frame);
        const Time next = std::min({until, nodes_.next_tick(), stopping_.next_tick()});
        for (const net::Event& event : net_.poll(next)) carrier_.hear(event);
    }

    net::Links& net_;
    BusCarrier& carrier_;
    debug::Network nodes_;
    Stopping stopping_;
};

Status judge(const StopReport& report, const std::string& target) {
    std::string missing;
    for (const StopNode& node : report.nodes) {
        if (node.state == StopNode::State::Stopped) continue;
        missing += fmt::format("{}{}: {}", missing.empty() ? "" : ", ",
                               session::number_and_name(node), word_of(node.state));
    }
    if (missing.empty()) return Status::done();
    return Error{Code::Unavailable, target + ": not stopped: " + missing};
}

}  // namespace

Status stop_only(const ServiceOptions& options, const ServiceTalk& talk) {
    Versions versions(std::filesystem::absolute(options.project));
    const auto opened = open_path(versions.folder(versions.current()).string());
    const OpenedProject project = opened.ok() ? opened.value() : OpenedProject{};
    const std::string target = options.target.empty() ? project.target : options.target;
    if (target.empty() || target == "sim") return Status::done();
    std::vector<std::string> toolboxes;
    for (const std::string& one : project.toolboxes) toolboxes.push_back(project.real(one));
    const auto safe = session::safe_stop_of(toolboxes, project.safe_stop);
    net::Links net;
    const auto carrier = TRY(BusCarrier::connect(net, target));
    Bus bus(net, *carrier);
    if (!bus.wait(kReachWithin, [&bus] { return bus.connected(); })) {
        return Error{Code::Unavailable, target + ": not reached: " + carrier->why()};
    }
    bus.list();
    // Those that do not say what they are in time are stopped all the same.
    (void)bus.wait(kNodesWithin, [&bus] { return bus.all_described(); });
    TRY(judge(bus.stop(safe.ok() ? safe.value() : session::shipped_safe_stop()), target));
    talk.log("note", target + ": stopped");
    return Status::done();
}

}  // namespace vagus::serve
