#include "aesl/code_writer.hpp"

#include <array>

#include "aesl/limits.hpp"

namespace vagus::aesl {
namespace {

using isa::Opcode;

constexpr int32_t kSmallMax =
    2047;  // -2048 would fit too; the reference does not use it (section 4.3)
constexpr int64_t kJumpMax = 2047;
constexpr int64_t kJumpMin = -2048;
constexpr uint32_t kLongJumpWords = 4;

// A jump beyond the reach of JUMP: a branch on a condition that never holds. `distance` counts from
// its first word.
//     SMALL_IMMEDIATE 0    SMALL_IMMEDIATE 1    BRANCH ==, else …
std::array<uint16_t, kLongJumpWords> long_jump_words(int64_t distance) {
    const auto equal = static_cast<uint16_t>(isa::BinaryOperator::Equal);
    return {isa::instruction(Opcode::SmallImm, 0), isa::instruction(Opcode::SmallImm, 1),
            isa::instruction(Opcode::Branch, equal), static_cast<uint16_t>(distance - 2)};
}

}  // namespace

void CodeWriter::word(uint16_t value, int32_t line) {
    code_.words.push_back(value);
    code_.lines.push_back(static_cast<uint16_t>(line));
}

void CodeWriter::instruction(Opcode opcode, int32_t argument, int32_t line) {
    word(isa::instruction(opcode, static_cast<uint16_t>(argument)), line);
}

void CodeWriter::touch(int32_t depth, int32_t line) {
    if (depth <= code_.depth) return;
    code_.depth = depth;
    code_.deepest_line = line;
}

void CodeWriter::immediate(int32_t value, int32_t line, int base) {
    touch(base + 1, line);
    if (value >= -kSmallMax && value <= kSmallMax) {
        instruction(Opcode::SmallImm, value, line);
        return;
    }
    instruction(Opcode::LargeImm, 0, line);
    word(static_cast<uint16_t>(value), line);
}

void CodeWriter::expression(const Folder& folder, ScalarId id, int base) {
    const Scalar& scalar = folder[id];
    switch (scalar.kind) {
        case ScalarKind::Number:
            immediate(scalar.value, scalar.line, base);
            break;
        case ScalarKind::Load:
            touch(base + 1, scalar.line);
            instruction(Opcode::Load, scalar.value, scalar.line);
            break;
        case ScalarKind::LoadIndirect:
            expression(folder, scalar.left, base);
            instruction(Opcode::LoadInd, scalar.value, scalar.line);
            word(static_cast<uint16_t>(scalar.right), scalar.line);
            break;
        case ScalarKind::Unary:
            expression(folder, scalar.left, base);
            instruction(Opcode::Unary, scalar.op, scalar.line);
            break;
        case ScalarKind::Binary:
            expression(folder, scalar.left, base);
            expression(folder, scalar.right, base + 1);
            instruction(Opcode::Binary, scalar.op, scalar.line);
            break;
        case ScalarKind::Unknown:
            break;  // the program has a mistake and its code is dropped
    }
}

void CodeWriter::call(int32_t sub, int32_t line) {
    code_.calls.push_back({here(), sub, line});
    instruction(Opcode::SubCall, 0, line);
}

uint32_t CodeWriter::branch(uint8_t op, uint16_t flags, int32_t line) {
    const uint32_t at = here();
    instruction(Opcode::Branch, op | flags, line);
    word(0, line);
    return at;
}

void CodeWriter::patch_branch(uint32_t branch, uint32_t target) {
    const uint32_t distance = target - branch;
    if (distance > longest_branch_) {
        longest_branch_ = distance;
        longest_branch_line_ = code_.lines[branch];
    }
    code_.words[branch + 1] = static_cast<uint16_t>(distance);
}

uint32_t CodeWriter::jump_placeholder(int32_t line) {
    const uint32_t at = here();
    instruction(Opcode::Jump, 0, line);
    return at;
}

uint32_t CodeWriter::patch_jump(uint32_t jump, uint32_t target) {
    const int64_t distance = int64_t{target} - jump;
    // Beyond the largest program nothing matters any more: it is rewound, or refused.
    if (distance <= kJumpMax || here() > kProgramWordsMax) {
        code_.words[jump] = isa::instruction(Opcode::Jump, static_cast<uint16_t>(distance));
        return 0;
    }
    constexpr uint32_t kMore = kLongJumpWords - 1;
    const auto words = long_jump_words(distance + kMore);
    const auto at = static_cast<std::ptrdiff_t>(jump);
    code_.words[jump] = words[0];
    code_.words.insert(code_.words.begin() + at + 1, words.begin() + 1, words.end());
    code_.lines.insert(code_.lines.begin() + at + 1, kMore, code_.lines[jump]);
    for (size_t i = code_.calls.size(); i-- > 0 && code_.calls[i].word > jump;) {
        code_.calls[i].word += kMore;
    }
    touch(2, code_.lines[jump]);
    return kMore;
}

void CodeWriter::jump_back(uint32_t target, int32_t line) {
    const int64_t distance = int64_t{target} - here();
    if (distance >= kJumpMin) {
        instruction(Opcode::Jump, static_cast<int32_t>(distance), line);
        return;
    }
    if (-distance > longest_branch_) {
        longest_branch_ = static_cast<uint32_t>(-distance);
        longest_branch_line_ = line;
    }
    for (const uint16_t value : long_jump_words(distance)) word(value, line);
    touch(2, line);
}

CodeWriter::Checkpoint CodeWriter::checkpoint() const {
    return {here(), code_.calls.size(), code_.depth, code_.deepest_line};
}

void CodeWriter::rewind(const Checkpoint& to) {
    code_.words.resize(to.words);
    code_.lines.resize(to.words);
    code_.calls.resize(to.calls);
    code_.depth = to.depth;
    code_.deepest_line = to.deepest_line;
}

}  // namespace vagus::aesl
