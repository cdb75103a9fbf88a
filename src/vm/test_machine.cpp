#include "vm/test_machine.hpp"

#include <cstdio>
#include <cstdlib>
#include <utility>

namespace vagus::vm {

namespace {

void append(std::vector<uint8_t>& bytes, uint16_t word) {
    bytes.push_back(static_cast<uint8_t>(word & 0xff));
    bytes.push_back(static_cast<uint8_t>(word >> 8));
}

std::string hex(const std::vector<uint8_t>& bytes) {
    std::string text;
    for (const uint8_t byte : bytes) {
        char two[4];
        std::snprintf(two, sizeof two, "%02x ", byte);
        text += two;
    }
    if (!text.empty()) text.pop_back();
    return text;
}

std::string frame_of(uint16_t type, const std::vector<uint8_t>& payload) {
    std::vector<uint8_t> bytes;
    append(bytes, static_cast<uint16_t>(payload.size()));
    append(bytes, 1);
    append(bytes, type);
    bytes.insert(bytes.end(), payload.begin(), payload.end());
    return hex(bytes);
}

std::vector<uint8_t> bytes_of(std::string_view text) {
    std::vector<uint8_t> bytes;
    for (const char* at = text.data(); at < text.data() + text.size();) {
        char* after = nullptr;
        bytes.push_back(static_cast<uint8_t>(std::strtoul(at, &after, 16)));
        at = after;
        while (*at == ' ') ++at;
    }
    return bytes;
}

constexpr uint16_t kId = 1;

}  // namespace

std::string frame(uint16_t type, const std::vector<uint16_t>& words) {
    std::vector<uint8_t> payload;
    for (const uint16_t word : words) append(payload, word);
    return frame_of(type, payload);
}

std::string state(uint16_t pc, uint16_t flags) {
    return frame(0x900a, {pc, flags});
}

std::string error(uint16_t pc, std::string_view text) {
    std::vector<uint8_t> payload;
    append(payload, pc);
    payload.push_back(static_cast<uint8_t>(text.size()));
    payload.insert(payload.end(), text.begin(), text.end());
    return frame_of(0x9009, payload);
}

const Host TestMachine::kHost = {
    [](Vm& vm, uint16_t type, const uint16_t* words, uint16_t count) {
        std::vector<uint8_t> payload;
        for (uint16_t i = 0; i < count; ++i) append(payload, words[i]);
        of(vm).write_down(type, payload);
    },
    [](Vm& vm, uint16_t start, uint16_t count) {
        std::vector<uint8_t> payload;
        append(payload, start);
        for (uint16_t i = 0; i < count; ++i) {
            append(payload, static_cast<uint16_t>(of(vm).variables.at(start + size_t{i})));
        }
        of(vm).write_down(0x9005, payload);
    },
    [](Vm& vm, const char* text) { of(vm).sent_.push_back(error(vm.pc, text)); },
    [](Vm& vm, uint16_t id) { of(vm).native(vm, id); },
    [](Vm& vm, Notice notice) { of(vm).notices.push_back(notice); },
};

TestMachine::TestMachine(Sizes sizes)
    : bytecode(sizes.bytecode),
      variables(sizes.variables),
      stack(sizes.stack),
      breakpoints(kBreakpointsMax),
      config{kId,
             sizes.bytecode,
             sizes.variables,
             sizes.stack,
             sizes.arguments,
             bytecode.data(),
             variables.data(),
             stack.data(),
             breakpoints.data(),
             &kHost,
             this} {
    init(vm, config);
}

void TestMachine::write_down(uint16_t type, const std::vector<uint8_t>& payload) {
    sent_.push_back(frame_of(type, payload));
}

void TestMachine::receive(std::string_view text) {
    const std::vector<uint8_t> bytes = bytes_of(text);
    std::vector<uint16_t> words;
    for (size_t i = 0; i + 1 < bytes.size(); i += 2) {
        words.push_back(static_cast<uint16_t>(bytes[i] | bytes[i + 1] << 8));
    }
    const std::vector<uint16_t> payload(words.begin() + 3, words.end());
    if (wire::is_user_event(words.at(2))) {
        event(words[2], payload, words[1]);
    } else {
        vm::receive(vm, words[2], payload.data(), static_cast<uint16_t>(payload.size()));
    }
}

void TestMachine::command(wire::MessageType type, const std::vector<uint16_t>& rest) {
    std::vector<uint16_t> words = {kId};
    words.insert(words.end(), rest.begin(), rest.end());
    vm::receive(vm, static_cast<uint16_t>(type), words.data(), static_cast<uint16_t>(words.size()));
}

void TestMachine::event(uint16_t type, const std::vector<uint16_t>& arguments, uint16_t source) {
    receive_event(vm, source, type, arguments.data(), static_cast<uint16_t>(arguments.size()));
}

void TestMachine::load(const std::vector<uint16_t>& code) {
    std::vector<uint16_t> words = {0, 3, 0xffff, 3};
    words.insert(words.end(), code.begin(), code.end());
    command(wire::MessageType::SetBytecode, words);
    command(wire::MessageType::Run);
    sent_.clear();
}

std::vector<std::string> TestMachine::execute(const std::vector<uint16_t>& code) {
    load(code);
    run(1000);
    return sent();
}

std::vector<std::string> TestMachine::sent() {
    return std::exchange(sent_, {});
}

std::vector<int16_t> TestMachine::on_stack() const {
    return {stack.begin(), stack.begin() + vm.depth};
}

}  // namespace vagus::vm
