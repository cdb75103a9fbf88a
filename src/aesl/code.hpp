// Bytecode of one section before it has an address: what emit makes and link puts together.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace vagus::aesl {

// A SubCall whose address is still missing.
struct CodeCall {
    uint32_t word = 0;  // in CodeSection::words
    int32_t sub = 0;    // index into Tree::subs
    int32_t line = 0;
};

struct CodeSection {
    std::vector<uint16_t> words;
    std::vector<uint16_t> lines;  // one a word
    std::vector<CodeCall> calls;
    int32_t depth =
        0;  // stack words that expressions and native calls need; calls of subs come on top
    int32_t deepest_line = 0;  // where
};

// All sections of a tree, in its order; those that are ignored are empty.
struct Code {
    std::vector<CodeSection> sections;
    bool is_cut = false;      // emission stopped at kExpandedMax
    int32_t temporaries = 0;  // the most words that one statement needs for intermediate values
};

}  // namespace vagus::aesl
