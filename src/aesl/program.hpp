// What the compiler makes of a script: bytecode, and where each name and line went.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vagus::aesl {

struct VariablePlace {
    std::string name;
    uint16_t address = 0;
    uint16_t size = 1;
};

struct SubroutinePlace {
    std::string name;
    uint16_t address = 0;
    int line = 0;
};

struct Used {
    uint16_t bytecode = 0;   // words
    uint16_t variables = 0;  // words: node's, user's and the most temporaries needed at once
    uint16_t stack = 0;      // words, the deepest
};

struct Program {
    std::vector<uint16_t> bytecode;
    std::vector<uint16_t> lines;           // one a word, from 1; 0 for the event table
    std::vector<VariablePlace> variables;  // the node's, then the user's, in order of address
    std::vector<SubroutinePlace> subroutines;
    Used used;
};

}  // namespace vagus::aesl
