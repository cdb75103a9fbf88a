// Every bound of the compiler, in one place. A text beyond one of them is an error with a sentence,
// never a crash.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vagus::aesl {

constexpr size_t kSourceBytesMax = 1u << 20;  // bytes of one program's text
constexpr int kSourceLinesMax = 65535;        // lines are 16-bit numbers in Program::lines
constexpr int kNestingMax = 400;              // parentheses, brackets and blocks inside each other
constexpr int kTreeDepthMax = 2000;           // operators above each other, as in a + b + c + …
constexpr size_t kErrorsMax = 100;            // reported in one run
constexpr size_t kWarningsMax = 100;          // reported in one run
constexpr size_t kExpandedMax = 1u << 22;  // scalar operations that all vector operations unroll to
constexpr int kWordsMax = 1 << 20;         // where sizes of expressions stop counting

constexpr int32_t kInt16Max = 32767;     // of a variable; the lowest is -32768
constexpr int kAddressableWords = 4096;  // an instruction has 12 bits for an address (section 3.10)
constexpr int kEventArgumentsMax = 258;  // words; a limit of the protocol (section 3.10)
constexpr int kProgramWordsMax = 65535;  // addresses in the event table are 16-bit
constexpr int kGuessDistanceMax = 2;     // for suggestions (section 3.3)

}  // namespace vagus::aesl
