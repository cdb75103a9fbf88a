// A machine for tests, on a bus that writes down what it is sent. Frames are written as in the
// dumps of docs/spec/aseba-wire-and-vm.md, section 2.10: length, source, type, payload, all in
// hexadecimal.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vm/vm.hpp"

namespace vagus::vm {

struct Sizes {
    uint16_t bytecode = 300;
    uint16_t variables = 600;
    uint16_t stack = 32;
    uint16_t arguments = 32;
};

class TestMachine {
public:
    explicit TestMachine(Sizes sizes = {});
    TestMachine(const TestMachine&) = delete;
    TestMachine& operator=(const TestMachine&) = delete;

    // A frame from the bus: a command or a user event.
    void receive(std::string_view frame);
    void command(wire::MessageType type, const std::vector<uint16_t>& words_after_destination = {});
    void event(uint16_t type, const std::vector<uint16_t>& arguments = {}, uint16_t source = 0);

    // Uploads `code` behind an event vector whose only entry is the init event, at address 3,
    // forgets what that sent, and leaves the machine in running mode.
    void load(const std::vector<uint16_t>& code);
    // The same, then runs it; gives what was sent.
    std::vector<std::string> execute(const std::vector<uint16_t>& code);

    // One loop for each program of tests: vm::run() in test_machine_run.cpp of this folder, and
    // fastvm::run() in that of fastvm, where the tests of this folder are run again.
    uint16_t run(uint16_t limit);

    // What was sent since the last call.
    std::vector<std::string> sent();

    // What is on the stack, bottom first.
    std::vector<int16_t> on_stack() const;

    std::vector<uint16_t> bytecode;
    std::vector<int16_t> variables;
    std::vector<int16_t> stack;
    std::vector<uint16_t> breakpoints;
    std::vector<Notice> notices;
    std::function<void(Vm& vm, uint16_t id)> native;  // what Native does
    Config config;
    Vm vm;

private:
    static TestMachine& of(Vm& vm) { return *static_cast<TestMachine*>(vm.config->owner); }
    void write_down(uint16_t type, const std::vector<uint8_t>& payload);
    static const Host kHost;

    std::vector<std::string> sent_;
};

// A frame of node 1 as text.
std::string frame(uint16_t type, const std::vector<uint16_t>& words);
std::string state(uint16_t pc, uint16_t flags);
// NodeSpecificError.
std::string error(uint16_t pc, std::string_view text);

}  // namespace vagus::vm
