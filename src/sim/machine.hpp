// One node of a robot in simulated time: its memories, and the rule by which it shares a
// millisecond between frames, local events and its script. Frames that it sends are collected; the
// world carries them away.
//
// A script executes at most kInstructionsPerMillisecond. The newest event kills the one that runs,
// as on the original, but a local event waits until the running handler has ended or has had
// kInstructionsPerMillisecond: so two handlers that are due at one instant both run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "fastvm/bytecode.hpp"
#include "node/frame_maker.hpp"
#include "node/node.hpp"
#include "sim/witness.hpp"
#include "wire/frame.hpp"

namespace vagus::sim {

constexpr uint16_t kInstructionsPerMillisecond = 1000;
constexpr uint16_t kFramesPerMillisecond = 16;  // that a node looks at
constexpr size_t kPendingEventsMax = 32;        // local events of one node, none of them twice
constexpr uint8_t kLocalEventsMax = 64;         // of one node
constexpr size_t kSentKept = 4;  // frames for which there is room at once; a description is more

struct MachineDefinition {
    const node::Description* description = nullptr;  // must outlive the machine
    uint16_t id = 0;
    uint16_t bytecode_size = 0;  // words, all three
    uint16_t stack_size = 0;
    uint16_t variables_size = 0;
    uint16_t arguments_size = 32;
    void* robot = nullptr;  // for natives, see Machine::robot_of()
    // Called with `robot` at once when Stop, Reset, new bytecode or a fault has ended what the
    // program did.
    void (*broken_off)(void* robot) = nullptr;
};

// Not copied nor moved: the node inside knows where its memories are.
class Machine {
public:
    explicit Machine(const MachineDefinition& definition);
    Machine(const Machine&) = delete;
    Machine& operator=(const Machine&) = delete;

    // As switched on: no program, all variables 0, nothing waiting.
    void restart();
    // Off and on again: the program was saved and begins with its init event, the variables are
    // `variables`, as many as there are.
    void switch_on_again(const std::vector<int16_t>& variables);

    // From now on math.rand gives what follows from that number, until the next restart(): a node
    // that is switched on begins at 0, as the real one does.
    void reseed(uint16_t seed) { node_.random_state = seed; }

    // A new millisecond: the script may go on.
    void begin_millisecond() {
        budget_ = kInstructionsPerMillisecond;
        frames_left_ = kFramesPerMillisecond;
    }
    // It would look at another frame in this millisecond.
    bool wants_frame() const { return frames_left_ > 0 && budget_ > 0; }
    // Obeys the frame; a user event runs at once. `number` is that of the frame, where frames are
    // numbered.
    void receive(const wire::Frame& frame, uint32_t number = 0);
    // The local event has happened: it runs in this run() or a later one. Below kLocalEventsMax.
    void raise(uint8_t event);
    // The same of one that has no handler, some time ago while nothing ran.
    void pass_unheard(uint8_t event);
    void run();
    // The program has a handler for it.
    bool hears(uint8_t event);
    // The next run() has something to do without any new event.
    bool is_busy() const {
        return !pending_.empty() || (vm::is_active(node_.vm) && !vm::is_paused_in_event(node_.vm));
    }
    // Its program runs, or waits for its next event: nothing has stopped or paused it.
    bool runs() const { return (node_.vm.flags & wire::kFlagStep) == 0; }
    // The only host of a port has left: it takes its breakpoints along (section 1.4).
    void host_left();

    uint16_t id() const { return config_.id; }
    const char* name() const { return definition_.description->name; }
    const node::Description& description() const { return *definition_.description; }
    int16_t& variable(uint16_t address) { return variables_[address]; }
    int16_t variable(uint16_t address) const { return variables_[address]; }
    const std::vector<int16_t>& variables() const { return variables_; }
    // Frames sent since they were last forgotten, by the code that carries them on.
    const std::vector<wire::Frame>& sent() const { return sent_; }
    // Of each of them, the number of the frame that it followed from; 0: none.
    const std::vector<uint32_t>& origins() const { return origins_; }
    void forget_sent();
    // Borrowed; nullptr: nobody any more.
    void watch(Witness* witness, WitnessedNode as) {
        witness_ = witness;
        witnessed_ = as;
    }
    const vm::Vm& vm() const { return node_.vm; }
    // How many instructions the handler that runs has executed; 0: it waits for its next event.
    uint64_t instructions_of_handler() const { return vm::is_active(node_.vm) ? executed_ : 0; }
    // Registers, stack, variables and what waits, as bytes: equal states give equal bytes.
    std::string state() const;

    // For natives: what is `robot` in the definition of the machine that the node belongs
    // to.
    static void* robot_of(const node::Node& node) {
        return static_cast<const Machine*>(node.owner)->definition_.robot;
    }

private:
    static Machine& of(node::Node& node) { return *static_cast<Machine*>(node.owner); }
    static void notify(node::Node& node, vm::Notice notice);
    void send(const wire::Frame& frame);
    void break_off() const;
    bool start_pending();
    uint16_t run_watched();
    void tell_writes(uint16_t pc, const std::vector<int16_t>& before);
    static const node::Board kBoard;

    MachineDefinition definition_;
    fastvm::Bytecode bytecode_;
    std::vector<int16_t> stack_;
    std::vector<int16_t> variables_;
    std::vector<uint16_t> breakpoints_;
    vm::Config config_;
    node::Node node_;
    node::FrameMaker maker_;
    uint64_t heard_ = 0;            // a bit for each local event that has a handler
    bool heard_is_old_ = true;      // the program may have changed since
    std::vector<uint8_t> pending_;  // local events, oldest first
    std::vector<wire::Frame> sent_;
    std::vector<uint32_t> origins_;  // of sent_
    uint32_t cause_ = 0;             // the frame that what happens now follows from
    Witness* witness_ = nullptr;
    WitnessedNode witnessed_;
    uint16_t budget_ = 0;
    uint16_t frames_left_ = 0;
    uint32_t used_ = 0;      // instructions of the handler that runs
    uint64_t executed_ = 0;  // the same, also of what runs after a reset
};

}  // namespace vagus::sim
