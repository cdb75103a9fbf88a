#include "sim/host_chaos.hpp"

namespace vagus::sim {

HostChaos::HostChaos(const std::vector<ChaosFault>& faults, std::string_view name, uint64_t seed)
    : faults_(of(faults, name)), seed_(seed), first_seed_(seed), clock_(faults_) {}

std::vector<ChaosFault> HostChaos::of(const std::vector<ChaosFault>& faults,
                                      std::string_view name) {
    std::vector<ChaosFault> its;
    for (const ChaosFault& fault : faults) {
        const std::string_view where = fault.where.empty() ? kMainComputer : fault.where;
        if (where == name) its.push_back(fault);
    }
    return its;
}

void HostChaos::reseed(uint64_t seed) {
    if (seed == seed_) return;
    seed_ = seed;
    to_bus_.reseed(seed, 1);
    from_bus_.reseed(seed, 2);
}

void HostChaos::advance(Time now) {
    while (const auto edge = clock_.next(now)) {
        if (edge->begins) {
            to_bus_.begin(*edge->fault, chaos_seed(*edge->fault, seed_, 1));
            from_bus_.begin(*edge->fault, chaos_seed(*edge->fault, seed_, 2));
        } else {
            to_bus_.end(*edge->fault);
            from_bus_.end(*edge->fault);
        }
    }
}

void HostChaos::restart() {
    seed_ = first_seed_;
    clock_.restart();
    to_bus_.reset();
    from_bus_.reset();
}

}  // namespace vagus::sim
