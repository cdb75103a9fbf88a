// Expressions made up from a seed: see generate.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/rng.hpp"

namespace vagus::aesl {

// A name that programs may read; a scalar has size 1.
struct GeneratedVariable {
    std::string name;
    int size = 1;
    bool is_writable = true;  // else only loops and deques write it
};

// Draws from the seed in words that read like the grammar.
class Dice {
public:
    explicit Dice(uint64_t seed) : random_(seed) {}

    int below(int bound) { return static_cast<int>(random_.below(static_cast<uint64_t>(bound))); }
    int from_to(int low, int high) { return low + below(high - low + 1); }
    bool chance(int percent) { return below(100) < percent; }
    template <typename List>
    const auto& pick(const List& list) {
        return list[random_.below(std::size(list))];
    }

private:
    SplitMix64 random_;
};

class ExpressionGenerator {
public:
    // All are borrowed and may grow between the calls.
    ExpressionGenerator(Dice& dice, const std::vector<GeneratedVariable>& variables,
                        const std::vector<std::string>& constants)
        : dice_(dice), variables_(variables), constants_(constants) {}

    // An integer expression of `size` words, operators at most `depth` above each other.
    std::string integer(int size, int depth);
    // A boolean expression.
    std::string condition(int depth);
    // The right side of / or %: rarely 0, and never the literal -1: the reference crashes when it
    // folds -2^31 / -1 (section 3.6, rule 1).
    std::string divisor(int size);
    // A variable, slice or element of `size` words that may be written; empty if there is none.
    std::string target(int size);
    // A variable, slice or element of `size` words; empty if there is none.
    std::string reference(int size);
    // Something that folds to a number.
    std::string number();
    // White space or a comment, anything that may stand between two tokens.
    std::string gap();

private:
    std::string operand(int size, int depth);
    std::string scalar(int depth);
    std::string element(const GeneratedVariable& variable);
    std::string tuple(int size, int depth);
    std::string slice(const GeneratedVariable& variable, int size);
    std::string reference_in(int size, bool must_be_writable);

    Dice& dice_;
    const std::vector<GeneratedVariable>& variables_;
    const std::vector<std::string>& constants_;
};

}  // namespace vagus::aesl
