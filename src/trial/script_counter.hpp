// Counts which lines of the scripts of a world's nodes are executed, and which way their branches
// go.
//
//     ScriptCounter scripts(session);
//     session.world().watch(&scripts);                // borrowed, until watch(nullptr)
//     …
//     all.add(scripts.coverage());
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "session/sim_session.hpp"
#include "sim/witness.hpp"
#include "trial/coverage.hpp"

namespace vagus::trial {

class ScriptCounter final : public sim::Witness {
public:
    // Borrowed.
    explicit ScriptCounter(const session::SimSession& session) : session_(session) {}

    void executes(const sim::WitnessedNode& node, uint16_t pc) override;
    // Of the programs as they are now.
    Coverage coverage() const;

private:
    struct Node {
        const aesl::Program* program = nullptr;
        std::vector<uint64_t> executed;                        // by address
        std::map<uint16_t, std::array<uint64_t, 2>> branches;  // by address: held, did not
        int branch = -1;  // that was executed last; what follows tells its way
    };
    void begin(Node& node, const aesl::Program* program) const;
    void add(uint16_t id, const Node& node, Coverage& to) const;

    const session::SimSession& session_;
    std::map<uint16_t, Node> nodes_;  // by id
};

}  // namespace vagus::trial
