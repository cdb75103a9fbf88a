// What the code of a node needs of the list of its variables (a .def): where each lies, and what a
// host is told. Included where they are declared, once for each list:
//
//     #define VAGUS_VARIABLES "sim/carbot/bumper_variables.def"
//     #include "sim/node_variables.inl"
//     static_assert(sizeof(Layout) == 48 * kWord, "docs/carbot.md: 48 words are described");
//     machine.variable(ADDRESS(touch_count)) = 3;

// Addresses are offsets in here; the memory itself is that of the machine.
struct Layout {
#define VARIABLE(field, name, words) int16_t field[words];
#include VAGUS_VARIABLES
#undef VARIABLE
};

constexpr size_t kWord = sizeof(int16_t);

constexpr node::Variable kVariables[] = {
#define VARIABLE(field, name, words) {words, name},
#include VAGUS_VARIABLES
#undef VARIABLE
};

#define ADDRESS(field) static_cast<uint16_t>(offsetof(Layout, field) / kWord)
#undef VAGUS_VARIABLES
