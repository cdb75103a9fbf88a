#include "sim/machine.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "fastvm/run.hpp"
#include "isa/isa.hpp"
#include "wire/bytes.hpp"
#include "wire/reports.hpp"

namespace vagus::sim {

namespace {

bool is_fault(const wire::Frame& frame) {
    wire::Fault fault;
    return wire::read_fault(frame, fault) && fault.kind != wire::FaultKind::Killed;
}

bool is_stop_for(uint16_t node, const wire::Frame& frame) {
    if (frame.type != static_cast<uint16_t>(wire::MessageType::Stop)) return false;
    return wire::Reader(frame.payload, frame.size).u16() == node;
}

}  // namespace

const node::Board Machine::kBoard = {
    [](node::Node& node, uint16_t type) { of(node).maker_.begin(node, type); },
    [](node::Node& node, uint8_t byte) { of(node).maker_.put(byte); },
    [](node::Node& node) { of(node).send(of(node).maker_.frame()); }, notify,
    wire::kVariablesReplyWordsMax};

Machine::Machine(const MachineDefinition& definition)
    : definition_(definition),
      bytecode_(definition.bytecode_size),
      stack_(definition.stack_size),
      variables_(definition.variables_size),
      breakpoints_(vm::kBreakpointsMax),
      config_{definition.id,
              definition.bytecode_size,
              definition.variables_size,
              definition.stack_size,
              definition.arguments_size,
              bytecode_.memory(),
              variables_.data(),
              stack_.data(),
              breakpoints_.data(),
              &node::kMachineHost,
              &node_} {
    restart();
}

void Machine::restart() {
    bytecode_.load({});
    node::init(node_, config_, *definition_.description, kBoard, this);
    pending_.clear();
    sent_.clear();
    origins_.clear();
    cause_ = 0;
    used_ = 0;
    executed_ = 0;
    heard_is_old_ = true;
}

void Machine::switch_on_again(const std::vector<int16_t>& variables) {
    const std::vector<uint16_t> program(bytecode_.words().begin(), bytecode_.words().end());
    Witness* const witness = std::exchange(witness_, nullptr);
    restart();
    bytecode_.load(program);
    variables_ = variables;
    // As a host would let it begin, which hears nothing of it.
    for (const wire::MessageType message : {wire::MessageType::Reset, wire::MessageType::Run}) {
        vm::receive(node_.vm, static_cast<uint16_t>(message), &node_.vm.id, 1);
    }
    forget_sent();
    watch(witness, witnessed_);
    if (witness_ == nullptr || !vm::is_active(node_.vm)) return;
    witness_->began_by_frame(witnessed_, node_.vm.pc, 0);
}

void Machine::notify(node::Node& node, vm::Notice notice) {
    of(node).bytecode_.notice(notice);
    if (notice != vm::Notice::Reset) return;
    of(node).executed_ = 0;
    of(node).break_off();
}

// A script that was stopped by what it did says so itself, also while it is stepped.
void Machine::send(const wire::Frame& frame) {
    if (is_fault(frame)) break_off();
    sent_.push_back(frame);
    origins_.push_back(cause_);
    if (witness_ != nullptr) witness_->sends(witnessed_, node_.vm.pc);
}

// Many nodes describe themselves once, and each in a hundred frames: that room is given back.
void Machine::forget_sent() {
    sent_.clear();
    origins_.clear();
    if (sent_.capacity() > kSentKept) {
        sent_.shrink_to_fit();
        origins_.shrink_to_fit();
    }
}

void Machine::break_off() const {
    if (definition_.broken_off != nullptr) definition_.broken_off(definition_.robot);
}

void Machine::receive(const wire::Frame& frame, uint32_t number) {
    --frames_left_;
    const uint32_t before = std::exchange(cause_, number);
    node::receive(node_, frame);
    if (is_stop_for(node_.vm.id, frame)) break_off();
    if (!wire::is_user_event(frame.type)) {
        heard_is_old_ = true;  // it may have been part of a program
        cause_ = before;
        return;
    }
    if (witness_ != nullptr && vm::is_active(node_.vm)) {
        witness_->began_by_frame(witnessed_, node_.vm.pc, number);
    }
    used_ = 0;
    if (vm::event_address(node_.vm, frame.type) != 0) executed_ = 0;
    run();
}

bool Machine::hears(uint8_t event) {
    if (heard_is_old_) {
        heard_ = 0;
        for (uint8_t i = 0; i < kLocalEventsMax; ++i) {
            const auto number = static_cast<uint16_t>(isa::kLocalEventFirst - i);
            if (vm::event_address(node_.vm, number) != 0) heard_ |= uint64_t{1} << i;
        }
        heard_is_old_ = false;
    }
    return (heard_ >> event & 1) != 0;
}

// No handler starts, but the node says that the latest event is its own.
void Machine::pass_unheard(uint8_t event) {
    node::local_event(node_, event);
}

void Machine::raise(uint8_t event) {
    if (std::find(pending_.begin(), pending_.end(), event) == pending_.end() &&
        pending_.size() < kPendingEventsMax)
        pending_.push_back(event);
}

// Starts the oldest local event if it may start now.
bool Machine::start_pending() {
    if (pending_.empty() || budget_ == 0) return false;
    if (vm::is_active(node_.vm) && used_ < kInstructionsPerMillisecond) return false;
    const uint8_t event = pending_.front();
    pending_.erase(pending_.begin());
    cause_ = 0;
    node::local_event(node_, event);
    if (witness_ != nullptr && vm::is_active(node_.vm)) {
        witness_->began_by_itself(witnessed_, node_.vm.pc, event);
    }
    used_ = 0;
    if (hears(event)) executed_ = 0;
    return true;
}

void Machine::host_left() {
    node::host_left(node_);
}

void Machine::run() {
    while (!vm::is_paused_in_event(node_.vm)) {
        if (start_pending()) continue;
        if (!vm::is_active(node_.vm) || budget_ == 0) return;
        uint32_t limit = budget_;
        if (!pending_.empty()) limit = std::min(limit, kInstructionsPerMillisecond - used_);
        const uint16_t done = witness_ != nullptr
                                  ? run_watched()
                                  : fastvm::run(node_.vm, bytecode_, static_cast<uint16_t>(limit));
        budget_ = static_cast<uint16_t>(budget_ - done);
        used_ += done;
        executed_ += done;
        if (done == 0) return;
    }
    pending_.clear();  // paused inside an event: others are dropped (docs/spec, 3.6)
}

std::string Machine::state() const {
    const std::array<uint16_t, 3> registers = {node_.vm.flags, node_.vm.pc, node_.vm.depth};
    const size_t words = registers.size() + node_.vm.depth + variables_.size();
    // As large as it will be: recordings ask for it each second, of every node.
    std::string bytes(2 * words + pending_.size(), '\0');
    auto next = bytes.begin();
    const auto add = [&next](uint16_t word) {
        *next++ = static_cast<char>(word & 0xff);
        *next++ = static_cast<char>(word >> 8);
    };
    for (const uint16_t word : registers) add(word);
    for (uint16_t i = 0; i < node_.vm.depth; ++i) add(static_cast<uint16_t>(stack_[i]));
    for (const int16_t word : variables_) add(static_cast<uint16_t>(word));
    std::copy(pending_.begin(), pending_.end(), next);
    return bytes;
}

// One instruction: what it writes is seen by comparing.
uint16_t Machine::run_watched() {
    const uint16_t pc = node_.vm.pc;
    witness_->executes(witnessed_, pc);
    const uint16_t word = bytecode_.memory()[pc];
    const isa::Opcode opcode = isa::opcode_of(word);
    if (opcode != isa::Opcode::Store && opcode != isa::Opcode::StoreInd &&
        opcode != isa::Opcode::Native) {
        return fastvm::run(node_.vm, bytecode_, 1);
    }
    const std::vector<int16_t> before = variables_;
    if (opcode == isa::Opcode::Native) witness_->called(witnessed_, pc, isa::argument_of(word));
    const uint16_t done = fastvm::run(node_.vm, bytecode_, 1);
    if (opcode == isa::Opcode::Store) {
        // Written also where the value is the same again.
        const uint16_t address = isa::argument_of(word);
        if (address < variables_.size()) {
            witness_->wrote(witnessed_, pc, address, variables_[address]);
        }
        return done;
    }
    tell_writes(pc, before);
    return done;
}

void Machine::tell_writes(uint16_t pc, const std::vector<int16_t>& before) {
    for (size_t i = 0; i < variables_.size(); ++i) {
        if (variables_[i] == before[i]) continue;
        witness_->wrote(witnessed_, pc, static_cast<uint16_t>(i), variables_[i]);
    }
}

}  // namespace vagus::sim
