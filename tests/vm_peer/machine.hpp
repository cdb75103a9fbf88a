// What both machines have in common, and what can be seen of them from outside.
#pragma once

#include <cstdint>
#include <ostream>
#include <vector>

namespace vagus::vm_peer {

struct Geometry {
    static constexpr uint16_t kId = 1;
    static constexpr uint16_t kBytecode = 96;
    static constexpr uint16_t kVariables = 48;
    static constexpr uint16_t kStack = 6;
    static constexpr uint16_t kArguments = 8;
};

// The natives that both sides have: 0 math.copy, 1 math.div. All others fail with this text.
inline constexpr uint16_t kNativeCopy = 0;
inline constexpr uint16_t kNativeDivide = 1;
inline constexpr const char* kNoSuchNative = "no such native";

// Everything that can be seen of a machine.
struct State {
    uint16_t pc = 0, flags = 0;
    std::vector<int16_t> stack;  // bottom first
    std::vector<int16_t> variables;
    std::vector<uint16_t> bytecode;
    std::vector<uint16_t> breakpoints;  // sorted

    bool operator==(const State&) const = default;
};

// A message as it went to the bus: its type and its payload.
struct Sent {
    uint16_t type = 0;
    std::vector<uint8_t> payload;

    bool operator==(const Sent&) const = default;
};

inline void append_word(std::vector<uint8_t>& bytes, uint16_t word) {
    bytes.push_back(static_cast<uint8_t>(word & 0xff));
    bytes.push_back(static_cast<uint8_t>(word >> 8));
}

inline std::ostream& operator<<(std::ostream& out, const Sent& sent) {
    out << std::hex << sent.type << ':';
    for (const uint8_t byte : sent.payload) out << ' ' << unsigned{byte};
    return out << std::dec;
}

}  // namespace vagus::vm_peer
