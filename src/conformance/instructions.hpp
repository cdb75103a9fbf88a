// Small programs, written instruction by instruction as they are in the specification (sections
// 3.3 and 3.4), so that what a check sends does not come from a compiler.
//
//     const auto sum = Instructions().push(2).push(3).binary(BinaryOperator::Add).store(at).stop();
//     const Words program = program_of(sum);
//
// Addresses of code count from the first word of the program: its only handler begins at
// kInitStart.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "isa/isa.hpp"

namespace vagus::conformance {

using Words = std::vector<uint16_t>;
using Values = std::vector<int16_t>;

constexpr uint16_t kStopped = 2;    // flags after every fault
constexpr uint16_t kInitStart = 3;  // behind a vector of one handler

class Instructions {
public:
    Instructions& push(int value) { return words({0x2000, static_cast<uint16_t>(value)}); }
    Instructions& small(int value) { return one(isa::Opcode::SmallImm, value); }
    Instructions& load(int address) { return one(isa::Opcode::Load, address); }
    Instructions& store(int address) { return one(isa::Opcode::Store, address); }
    Instructions& load_indirect(int address, int size) {
        return one(isa::Opcode::LoadInd, address).word(size);
    }
    Instructions& store_indirect(int address, int size) {
        return one(isa::Opcode::StoreInd, address).word(size);
    }
    Instructions& unary(isa::UnaryOperator which) {
        return one(isa::Opcode::Unary, static_cast<int>(which));
    }
    Instructions& binary(isa::BinaryOperator which) {
        return one(isa::Opcode::Binary, static_cast<int>(which));
    }
    Instructions& jump(int distance) { return one(isa::Opcode::Jump, distance); }
    // Goes on if the two words on the stack compare so, else jumps so far.
    Instructions& branch(isa::BinaryOperator which, int distance) {
        return one(isa::Opcode::Branch, static_cast<int>(which)).word(distance);
    }
    Instructions& when(isa::BinaryOperator which, int distance) {
        return one(isa::Opcode::Branch, isa::kBranchIsWhen | static_cast<int>(which))
            .word(distance);
    }
    Instructions& emit(int event, int address, int length) {
        return one(isa::Opcode::Emit, event).word(address).word(length);
    }
    Instructions& native(int id) { return one(isa::Opcode::Native, id); }
    Instructions& call(int address) { return one(isa::Opcode::SubCall, address); }
    Instructions& back() { return one(isa::Opcode::SubRet, 0); }
    Instructions& stop() { return one(isa::Opcode::Stop, 0); }
    Instructions& word(int value) { return words({static_cast<uint16_t>(value)}); }
    Instructions& words(const Words& more) {
        words_.insert(words_.end(), more.begin(), more.end());
        return *this;
    }

    const Words& all() const { return words_; }
    uint16_t size() const { return static_cast<uint16_t>(words_.size()); }

private:
    Instructions& one(isa::Opcode opcode, int argument) {
        return word(isa::instruction(opcode, static_cast<uint16_t>(argument)));
    }
    Words words_;
};

struct Handler {
    uint16_t event = 0;
    Words code;
};

// The event vector and the handlers behind it, in their order.
inline Words program_of(const std::vector<Handler>& handlers) {
    const size_t vector_size = 2 * handlers.size() + 1;
    Words program{static_cast<uint16_t>(vector_size)};
    size_t start = vector_size;
    for (const Handler& handler : handlers) {
        program.push_back(handler.event);
        program.push_back(static_cast<uint16_t>(start));
        start += handler.code.size();
    }
    for (const Handler& handler : handlers)
        program.insert(program.end(), handler.code.begin(), handler.code.end());
    return program;
}

inline Words program_of(const Instructions& init) {
    return program_of({{isa::kInitEvent, init.all()}});
}

// Adds one to the word there, and stops.
inline Instructions adding_one(uint16_t at) {
    return Instructions().load(at).push(1).binary(isa::BinaryOperator::Add).store(at).stop();
}

// The words of all of them, one behind the other.
inline Values flat(const std::vector<Values>& arguments) {
    Values all;
    for (const Values& argument : arguments)
        all.insert(all.end(), argument.begin(), argument.end());
    return all;
}

}  // namespace vagus::conformance
