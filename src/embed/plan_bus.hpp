// A bus that others are on, for a plan in real time: a connection, the nodes on it, and the events,
// on a thread of its own while the plan runs.
//
//     auto opened = PlanBus::open({"tcp:127.0.0.1:33333", common, "arm.aesl", tell}, nodes);
//     PlanBus& bus = *opened.value();
//     bus.join(options);
//     run::RealTime run(graph, library, options);
//     bus.start([&run](run::BusEvent event) { run.hear(std::move(event)); });
//     const run::Ended ended = run.run();
//     bus.stop();
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "aesl/target.hpp"
#include "base/result.hpp"
#include "run/options.hpp"
#include "session/bus_names.hpp"
#include "toolbox/bus.hpp"

namespace vagus::embed {

constexpr size_t kUnsentMax = 65'536;  // events that the plan emitted and that wait for the thread

struct PlanBusOptions {
    std::string target;
    aesl::CommonDefinitions common;  // names and numbers of events
    std::string project;             // where they come from, for sentences
    // When the connection is lost or there again: a sentence, on the thread of the bus.
    std::function<void(const std::string&)> tell;
};

class PlanBus {
public:
    // Connects, and waits until the nodes that are there have said who they are; from then on
    // `nodes` tells. The Error says who is not there.
    static Result<std::unique_ptr<PlanBus>> open(PlanBusOptions options, toolbox::BusNodes& nodes);
    ~PlanBus();

    const session::BusNames& names() const;
    // The run emits on this bus. Borrowed for the run.
    void join(run::RunOptions& options);

    // From now on `hear` is called for each event of the bus, on the thread of the bus. A lost
    // connection is tried again, and its nodes are gone meanwhile.
    void start(std::function<void(run::BusEvent)> hear);
    // What was emitted has left when this returns, if somebody takes it.
    void stop();

private:
    class Insides;
    explicit PlanBus(std::unique_ptr<Insides> insides);
    std::unique_ptr<Insides> insides_;
};

}  // namespace vagus::embed
