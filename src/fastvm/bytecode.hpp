// The bytecode memory of one machine on a host, and what run() has made of it: its program decoded.
// Both lie in one object so that the decoded program cannot go stale unnoticed: words are written
// by this class, or by the machine, which says so by Notice::Reset.
//
//     Bytecode bytecode(1500);
//     vm::Config config = …;
//     config.bytecode = bytecode.memory();
//
//     bytecode.notice(notice);              // in notify() of the vm::Host
//     vm::receive(vm, type, words, count);  // SetBytecode among others
//     run(vm, bytecode, 1000);              // run.hpp; decodes again if there is something new
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "fastvm/cell.hpp"

namespace vagus::fastvm {

// Not copied: the machine knows where the words are.
class Bytecode {
public:
    // All words are 0.
    explicit Bytecode(uint16_t size);
    Bytecode(const Bytecode&) = delete;
    Bytecode& operator=(const Bytecode&) = delete;

    // For the Config of the machine, and nobody else.
    uint16_t* memory() { return words_.data(); }
    uint16_t size() const { return static_cast<uint16_t>(words_.size()); }
    std::span<const uint16_t> words() const { return words_; }

    // Puts `program` at the beginning; all words behind it become 0. It must not be longer than
    // size().
    void load(std::span<const uint16_t> program);
    // To be called with every notice of the machine.
    void notice(vm::Notice notice);

    // For run(). The cells stay until the next notice or load, or other breakpoints.
    const Cells& cells(uint16_t variables_size, std::span<const uint16_t> breakpoints) {
        const bool without = breakpoints.empty() && breakpoints_.empty();
        if (without && !cells_.empty()) return cells_;
        return cells_for(variables_size, breakpoints);
    }
    // Bytes beside the words themselves.
    size_t decoded_bytes() const { return cells_.capacity() * sizeof(Cell); }

private:
    const Cells& cells_for(uint16_t variables_size, std::span<const uint16_t> breakpoints);

    std::vector<uint16_t> words_;
    Cells cells_;                        // empty: to be made
    std::vector<uint16_t> breakpoints_;  // for which they were made
};

}  // namespace vagus::fastvm
