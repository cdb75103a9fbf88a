#include "fastvm/bytecode.hpp"

#include <algorithm>
#include <cassert>

#include "fastvm/decode.hpp"

namespace vagus::fastvm {

Bytecode::Bytecode(uint16_t size) : words_(size) {}

void Bytecode::load(std::span<const uint16_t> program) {
    assert(program.size() <= words_.size());
    const auto end = std::ranges::copy(program, words_.begin()).out;
    std::fill(end, words_.end(), uint16_t{0});
    cells_.clear();
}

void Bytecode::notice(vm::Notice notice) {
    if (notice == vm::Notice::Reset) cells_.clear();
}

const Cells& Bytecode::cells_for(uint16_t variables_size, std::span<const uint16_t> breakpoints) {
    if (!cells_.empty() && std::ranges::equal(breakpoints, breakpoints_)) return cells_;
    breakpoints_.assign(breakpoints.begin(), breakpoints.end());
    cells_ = decode(words_, variables_size, breakpoints_);
    return cells_;
}

}  // namespace vagus::fastvm
