// What a program is compiled for: the node it runs on, and the names that all nodes of a network
// share (docs/spec/aesl-language.md, section 3.1). A Target comes from a node file, from a live
// node's description, or from a simulated robot.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vagus::aesl {

struct NamedVariable {
    std::string name;
    uint16_t size = 1;  // words
    friend bool operator==(const NamedVariable&, const NamedVariable&) = default;
};

struct LocalEvent {
    std::string name;
    std::string doc;
    friend bool operator==(const LocalEvent&, const LocalEvent&) = default;
};

struct NativeParameter {
    std::string name;
    int16_t size = 1;  // > 0 words; < 0 number of a template; 0 any size
    friend bool operator==(const NativeParameter&, const NativeParameter&) = default;
};

struct NativeFunction {
    std::string name;
    std::string doc;
    std::vector<NativeParameter> parameters;
    friend bool operator==(const NativeFunction&, const NativeFunction&) = default;
};

// One node. Variables lie from address 0 in this order; the k-th local event has id 0xfffe - k; the
// k-th native id k.
struct Target {
    std::string name;
    uint16_t protocol_version = 5;
    uint16_t bytecode_size = 0;   // words
    uint16_t variables_size = 0;  // words
    uint16_t stack_size = 0;      // words
    std::vector<NamedVariable> variables;
    std::vector<LocalEvent> local_events;
    std::vector<NativeFunction> natives;
    friend bool operator==(const Target&, const Target&) = default;
};

struct GlobalEvent {
    std::string name;
    std::optional<uint16_t> size;  // argument words; absent in files of 2007 (section 6, rule 5)
    friend bool operator==(const GlobalEvent&, const GlobalEvent&) = default;
};

struct Constant {
    std::string name;
    int32_t value = 0;  // may lie outside 16 bits; then its use is an error
    friend bool operator==(const Constant&, const Constant&) = default;
};

// The names that all nodes of a network share. The position of an event in the list is its number
// on the bus.
struct CommonDefinitions {
    std::vector<GlobalEvent> events;
    std::vector<Constant> constants;
    friend bool operator==(const CommonDefinitions&, const CommonDefinitions&) = default;
};

}  // namespace vagus::aesl
