// Writes instructions into one section and keeps count of the stack. The shapes of branches and
// jumps, with what to do when they are too far for their instruction, are here; what they mean is
// in emit.cpp.
#pragma once

#include "aesl/code.hpp"
#include "aesl/fold.hpp"
#include "isa/isa.hpp"

namespace vagus::aesl {

class CodeWriter {
public:
    explicit CodeWriter(CodeSection& code) : code_(code) {}

    uint32_t here() const { return static_cast<uint32_t>(code_.words.size()); }
    int32_t last_line() const { return code_.lines.empty() ? 0 : code_.lines.back(); }

    void word(uint16_t value, int32_t line);
    void instruction(isa::Opcode opcode, int32_t argument, int32_t line);

    // Pushes a number: the low 16 bits of it. `base` words are on the stack before, here and below.
    void immediate(int32_t value, int32_t line, int base);
    // Pushes the value of an expression.
    void expression(const Folder& folder, ScalarId id, int base);
    void call(int32_t sub, int32_t line);

    // Pops two words and continues behind itself if the comparison holds, else at the place that
    // patch_branch() names. Gives the place of the branch.
    uint32_t branch(uint8_t op, uint16_t flags, int32_t line);
    void patch_branch(uint32_t branch, uint32_t target);

    // A word to be filled by patch_jump() with a jump to a later place. Where the jump takes more
    // than one word, what follows it moves; gives by how much.
    uint32_t jump_placeholder(int32_t line);
    uint32_t patch_jump(uint32_t jump, uint32_t target);
    void jump_back(uint32_t target, int32_t line);

    // Undo: forgets everything written since the mark.
    struct Checkpoint {
        uint32_t words;
        size_t calls;
        int32_t depth;
        int32_t deepest_line;
    };
    Checkpoint checkpoint() const;
    void rewind(const Checkpoint& to);

    // The longest distance that a branch was asked for; above kBranchDistanceMax the code is
    // useless.
    uint32_t longest_branch() const { return longest_branch_; }
    int32_t longest_branch_line() const { return longest_branch_line_; }

private:
    void touch(int32_t depth, int32_t line);

    CodeSection& code_;
    uint32_t longest_branch_ = 0;
    int32_t longest_branch_line_ = 0;
};

constexpr uint32_t kBranchDistanceMax = 32767;

}  // namespace vagus::aesl
