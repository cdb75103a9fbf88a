#include "run/code_source.hpp"

#include "run/options.hpp"

namespace vagus::run {

std::unique_ptr<Actor> make_actor(const RunOptions& options, const CodeLibrary& library,
                                  const plan::GraphActor& of, const CodePlace& place) {
    CodeSource* const source = options.code_source;
    auto code = source ? source->make_actor(of, place.path, place.now) : nullptr;
    return code ? std::move(code) : library.make_actor(*of.of);
}

std::unique_ptr<Supervisor> make_supervisor(const RunOptions& options, const CodeLibrary& library,
                                            const plan::GraphSupervisor& of,
                                            const CodePlace& place) {
    CodeSource* const source = options.code_source;
    auto code = source ? source->make_supervisor(of, place.path, place.now) : nullptr;
    return code ? std::move(code) : library.make_supervisor(*of.of);
}

plan::Graph with_checks_in_time(plan::Graph graph,
                                const std::function<bool(const plan::GraphSupervisor&)>& which) {
    const auto check = [&which](std::vector<plan::GraphSupervisor>& supervisors) {
        for (plan::GraphSupervisor& one : supervisors) {
            if (one.period_us == 0 && which(one)) one.period_us = plan::kPeriodDefaultMs * 1000;
        }
    };
    for (plan::GraphPlan& plan : graph.plans) {
        check(plan.globals);
        for (plan::GraphActor& actor : plan.actors) check(actor.supervisors);
    }
    return graph;
}

}  // namespace vagus::run
