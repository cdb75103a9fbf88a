#include "debug/lines.hpp"

#include <algorithm>

namespace vagus::debug {
namespace {

// Words of the event table, which has no lines: its first word says so itself (wire spec, 3.3).
size_t table_size(const aesl::Program& program) {
    const size_t told = program.bytecode.empty() ? 0 : program.bytecode[0];
    return std::min(told, std::min(program.bytecode.size(), program.lines.size()));
}

}  // namespace

int line_of(const aesl::Program& program, uint16_t pc) {
    return pc < table_size(program) || pc >= program.lines.size() ? 0 : program.lines[pc];
}

int pc_of(const aesl::Program& program, int line) {
    for (size_t pc = table_size(program); pc < program.lines.size(); pc++) {
        if (line > 0 && program.lines[pc] == line) return static_cast<int>(pc);
    }
    return -1;
}

int next_line_with_code(const aesl::Program& program, int line) {
    int next = 0;
    for (size_t pc = table_size(program); pc < program.lines.size(); pc++) {
        const int here = program.lines[pc];
        if (here > line && (next == 0 || here < next)) next = here;
    }
    return next;
}

int previous_line_with_code(const aesl::Program& program, int line) {
    int previous = 0;
    for (size_t pc = table_size(program); pc < program.lines.size(); pc++) {
        const int here = program.lines[pc];
        if (here < line) previous = std::max(previous, here);
    }
    return previous;
}

bool is_event_start(const aesl::Program& program, uint16_t pc) {
    for (size_t word = 2; word < table_size(program); word += 2) {
        if (program.bytecode[word] == pc) return true;
    }
    return false;
}

}  // namespace vagus::debug
