#include "trial/script_counter.hpp"

#include <algorithm>
#include <iterator>

#include "isa/isa.hpp"

namespace vagus::trial {

namespace {

size_t length_of(uint16_t word) {
    static constexpr size_t kWords[] = {
#define OP(name, opcode, words, popped, pushed) words,
#include "isa/opcodes.def"
#undef OP
    };
    const auto opcode = static_cast<size_t>(isa::opcode_of(word));
    return opcode < std::size(kWords) ? kWords[opcode] : 1;
}

bool is_branch(uint16_t word) {
    return isa::opcode_of(word) == isa::Opcode::Branch;
}

// The words of each instruction of a program, as addresses of their first.
std::vector<uint16_t> instructions_of(const aesl::Program& program) {
    std::vector<uint16_t> addresses;
    const std::vector<uint16_t>& words = program.bytecode;
    if (words.empty()) return addresses;
    for (size_t pc = words[0]; pc < words.size(); pc += length_of(words[pc])) {
        addresses.push_back(static_cast<uint16_t>(pc));
    }
    return addresses;
}

}  // namespace

void ScriptCounter::begin(Node& node, const aesl::Program* program) const {
    node = Node();
    node.program = program;
    node.executed.resize(program->bytecode.size());
    for (const uint16_t pc : instructions_of(*program)) {
        if (is_branch(program->bytecode[pc])) node.branches[pc];
    }
}

void ScriptCounter::executes(const sim::WitnessedNode& its, uint16_t pc) {
    const aesl::Program* const program = session_.program(its.id);
    if (program == nullptr) return;
    Node& node = nodes_[its.id];
    if (node.program != program) begin(node, program);
    if (pc >= node.executed.size()) return;
    if (node.branch >= 0) {
        const auto at = static_cast<uint16_t>(node.branch);
        const bool held = pc == at + length_of(program->bytecode[at]);
        ++node.branches[at][held ? 0 : 1];
        node.branch = -1;
    }
    ++node.executed[pc];
    if (is_branch(program->bytecode[pc])) node.branch = pc;
}

void ScriptCounter::add(uint16_t id, const Node& node, Coverage& to) const {
    const std::vector<uint16_t>& lines = node.program->lines;
    std::map<int, int> branches_before;
    for (const uint16_t pc : instructions_of(*node.program)) {
        if (pc >= lines.size() || lines[pc] == 0) continue;
        const auto place = session_.place_of(id, lines[pc]);
        if (!place) continue;
        ScriptCoverage& script = to.scripts[place->first];
        uint64_t& count = script.lines[place->second];
        count = std::max(count, node.executed[pc]);
        const auto branch = node.branches.find(pc);
        if (branch == node.branches.end()) continue;
        auto& ways = script.branches[{place->second, branches_before[place->second]++}];
        for (size_t i = 0; i < ways.size(); ++i) ways[i] += branch->second[i];
    }
}

Coverage ScriptCounter::coverage() const {
    Coverage all;
    for (const session::NodeState& state : session_.nodes()) {
        const aesl::Program* const program = session_.program(state.id);
        if (program == nullptr) continue;
        const auto counted = nodes_.find(state.id);
        Coverage one;
        if (counted != nodes_.end() && counted->second.program == program) {
            add(state.id, counted->second, one);
        } else {
            Node never;
            begin(never, program);
            add(state.id, never, one);
        }
        all.add(one);
    }
    return all;
}

}  // namespace vagus::trial
