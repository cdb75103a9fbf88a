#include "debug/program_mark.hpp"

#include "wire/checksum.hpp"

namespace vagus::debug {

uint32_t mark_of(std::span<const uint16_t> bytecode) {
    if (bytecode.empty()) return wire::kNoProgram;
    uint32_t checksum = wire::kChecksumBegin;
    for (const uint16_t word : bytecode) checksum = wire::add_to_checksum(checksum, word);
    return wire::program_mark(bytecode.front(), checksum);
}

std::optional<uint16_t> mark_address(const aesl::Target& target) {
    if (target.variables.empty()) return std::nullopt;
    const aesl::NamedVariable& last = target.variables.back();
    if (last.name != "_program" || last.size != 2) return std::nullopt;
    uint32_t address = 0;
    for (const aesl::NamedVariable& variable : target.variables) address += variable.size;
    return static_cast<uint16_t>(address - last.size);
}

}  // namespace vagus::debug
