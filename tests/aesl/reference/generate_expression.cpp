// Expressions made up from a seed: see generate.hpp.
#include "reference/generate_expression.hpp"

#include <fmt/format.h>

namespace vagus::aesl {

std::string ExpressionGenerator::gap() {
    const int kind = dice_.below(200);
    if (kind < 6) return "\n";
    if (kind < 8) return " # to the end of the line\n";
    if (kind < 10) return " #* between\ntwo tokens *# ";
    if (kind < 12) return "\t\r\n ";
    return " ";
}

std::string ExpressionGenerator::number() {
    switch (dice_.below(10)) {
        case 0:
            return fmt::format("0x{:x}", dice_.below(0x10000));
        case 1:
            return fmt::format("0b{:b}", dice_.below(0x100));
        case 2:
            return fmt::format("{}", dice_.from_to(0, 32767));
        case 3:
            return fmt::format("-{}", dice_.from_to(0, 32768));
        case 4:
            return fmt::format("{}", 1 << dice_.below(15));
        case 5:
            return fmt::format("- {}", dice_.below(20));
        default:
            return fmt::format("{}", dice_.below(12));
    }
}

std::string ExpressionGenerator::divisor(int size) {
    if (size > 1) {
        std::string list = "[" + divisor(1);
        for (int i = 1; i < size; ++i) list += "," + divisor(1);
        return dice_.chance(92) ? list + "]" : reference_in(size, false);
    }
    if (dice_.chance(2)) return number();
    switch (dice_.below(5)) {
        case 0:
            return fmt::format("{}", 1 << dice_.below(15));
        case 1:
            return fmt::format("-{}", 1 << dice_.below(15));
        case 2:
            return fmt::format("(1 << {})", dice_.below(20));
        case 3:
            return fmt::format("{}", dice_.from_to(1, 300));
        default:
            return "(" + reference_in(1, false) + " | 1)";
    }
}

std::string ExpressionGenerator::element(const GeneratedVariable& variable) {
    if (dice_.chance(50)) return fmt::format("{}[{}]", variable.name, dice_.below(variable.size));
    const std::string index =
        dice_.chance(90) ? fmt::format("abs({} % {})", reference_in(1, false), variable.size)
                         : reference_in(1, false) + " + " + number();
    return fmt::format("{}[{}{}]", variable.name, gap(), index);
}

std::string ExpressionGenerator::slice(const GeneratedVariable& variable, int size) {
    const int first = dice_.below(variable.size - size + 1);
    return fmt::format("{}[{}:{}]", variable.name, first, first + size - 1);
}

std::string ExpressionGenerator::reference_in(int size, bool must_be_writable) {
    std::vector<std::string> found;
    for (const GeneratedVariable& variable : variables_) {
        if (variable.size < size || (must_be_writable && !variable.is_writable)) continue;
        if (variable.size == size) found.push_back(variable.name);
        if (size == 1 && variable.size > 1 && variable.size <= 8)
            found.push_back(element(variable));
        if (variable.size > size || dice_.chance(20)) found.push_back(slice(variable, size));
        // Elements call for further references: a few candidates are enough.
        if (found.size() > 6 && dice_.chance(30)) break;
    }
    return found.empty() ? "" : dice_.pick(found);
}

std::string ExpressionGenerator::target(int size) {
    return reference_in(size, true);
}

std::string ExpressionGenerator::reference(int size) {
    return reference_in(size, false);
}

std::string ExpressionGenerator::tuple(int size, int depth) {
    std::string list;
    for (int left = size; left > 0;) {
        const int part = dice_.chance(70) ? 1 : dice_.from_to(1, left);
        std::string one = integer(part, depth - 1);
        // An element that begins with [ is that tuple and no more.
        if (one[0] == '[') one = "(" + one + ")";
        list += (list.empty() ? "" : "," + gap()) + one;
        left -= part;
    }
    return "[" + list + "]";
}

std::string ExpressionGenerator::scalar(int depth) {
    const int kind = dice_.below(100);
    if (kind < 30) return number();
    if (kind < 40) return dice_.pick(constants_);
    if (kind < 45 && depth > 0) return tuple(1, depth);
    return reference_in(1, false);
}

std::string ExpressionGenerator::operand(int size, int depth) {
    if (depth > 0 && dice_.chance(20)) return "(" + integer(size, depth - 1) + ")";
    if (depth > 0 && dice_.chance(15)) {
        constexpr std::string_view kUnary[] = {"- ", "~", "abs "};
        return std::string(dice_.pick(kUnary)) + operand(size, depth - 1);
    }
    if (size == 1) return scalar(depth);
    const std::string whole = dice_.chance(60) ? reference_in(size, false) : "";
    return whole.empty() ? tuple(size, depth) : whole;
}

std::string ExpressionGenerator::integer(int size, int depth) {
    std::string text = operand(size, depth);
    while (depth-- > 0 && dice_.chance(60)) {
        constexpr std::string_view kPlain[] = {"+", "-", "*", "|", "^", "&", "<<", ">>"};
        const bool is_division = dice_.chance(20);
        const std::string op =
            is_division ? (dice_.chance(50) ? "/" : "%") : std::string(dice_.pick(kPlain));
        const std::string right = is_division ? divisor(size) : operand(size, depth);
        text += gap() + op + gap() + right;
    }
    return text;
}

std::string ExpressionGenerator::condition(int depth) {
    const int kind = depth > 0 ? dice_.below(100) : 0;
    if (kind < 50) {
        constexpr std::string_view kComparisons[] = {"==", "!=", "<", "<=", ">", ">="};
        return integer(1, depth) + gap() + std::string(dice_.pick(kComparisons)) + gap() +
               integer(1, depth);
    }
    if (kind < 65) return "not (" + condition(depth - 1) + ")";
    if (kind < 70) return "not not not " + condition(0);
    const std::string both = dice_.chance(50) ? "and" : "or";
    return "(" + condition(depth - 1) + ")" + gap() + both + gap() + condition(depth - 1);
}

}  // namespace vagus::aesl
