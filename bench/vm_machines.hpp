// The three loops that bench_vm compares, behind one set of verbs: fastvm::run(), vm::run(), and
// the peer's. Each machine is that of a Thymio, with the 30 standard natives; the robot's own take
// their arguments and do nothing. What is emitted is counted.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace vagus::bench {

struct MachineProgram {
    std::vector<uint16_t> bytecode;
    std::vector<uint16_t> parameter_counts;  // of each native
    uint16_t bytecode_size = 0;              // words of the node, these three
    uint16_t variables_size = 0;
    uint16_t stack_size = 0;
};

constexpr uint16_t kInstructionsAtOnce = 1000;  // as nodes do (docs/spec, 3.6)

class BenchMachine {
public:
    virtual ~BenchMachine() = default;
    // Runs the handler to its end.
    virtual void event(uint16_t event) = 0;
    virtual std::span<int16_t> variables() = 0;
    virtual uint64_t sent() const = 0;
    // Executed so far; 0 where they are not counted.
    virtual uint64_t instructions() const = 0;
};

std::unique_ptr<BenchMachine> make_fast(const MachineProgram& program);
std::unique_ptr<BenchMachine> make_small(const MachineProgram& program);
// Of these one at a time: its surroundings are functions with fixed names.
std::unique_ptr<BenchMachine> make_peer(const MachineProgram& program);

}  // namespace vagus::bench
