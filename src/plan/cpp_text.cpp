#include "plan/cpp_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace vagus::plan {

namespace {

// Keywords of C++20, and the macros in lower case that common headers define.
const std::set<std::string_view>& words_of_cpp() {
    static const std::set<std::string_view> words = {
        "alignas", "alignof", "and", "and_eq", "asm", "auto", "bitand", "bitor", "bool", "break",
        "case", "catch", "char", "char8_t", "char16_t", "char32_t", "class", "compl", "concept",
        "const", "consteval", "constexpr", "constinit", "const_cast", "continue", "co_await",
        "co_return", "co_yield", "decltype", "default", "delete", "do", "double", "dynamic_cast",
        "else", "enum", "explicit", "export", "extern", "false", "float", "for", "friend", "goto",
        "if", "inline", "int", "long", "mutable", "namespace", "new", "noexcept", "not", "not_eq",
        "nullptr", "operator", "or", "or_eq", "private", "protected", "public", "register",
        "reinterpret_cast", "requires", "return", "short", "signed", "sizeof", "static",
        "static_assert", "static_cast", "struct", "switch", "template", "this", "thread_local",
        "throw", "true", "try", "typedef", "typeid", "typename", "union", "unsigned", "using",
        "virtual", "void", "volatile", "wchar_t", "while", "xor", "xor_eq",
        // macros
        "alloca", "assert", "errno", "i386", "linux", "major", "makedev", "minor", "offsetof",
        "stderr", "stdin", "stdout", "unix", "sa_handler", "sa_sigaction", "st_atime", "st_ctime",
        "st_mtime", "va_arg", "va_copy", "va_end", "va_start",
        // the namespaces that generated code uses
        "std", "vagus"};
    return words;
}

// Of the kind that macros and the compiler's own names are: EOF, __x, _X.
bool is_foreign(std::string_view name) {
    const bool capitals = std::none_of(name.begin(), name.end(),
                                       [](unsigned char c) { return std::islower(c) != 0; });
    return (capitals && name.size() > 2) || name.find("__") != std::string_view::npos ||
           name.front() == '_';
}

// Without what the compiler keeps for itself.
std::string tame(std::string_view name) {
    if (!is_foreign(name)) return std::string(name);
    std::string tamed = "x";
    for (const char c : name) {
        if (c != '_' || tamed.back() != '_') tamed += c;
    }
    return tamed;
}

}  // namespace

CppNames::CppNames(std::initializer_list<std::string_view> taken) {
    for (const std::string_view name : taken) taken_.emplace(name);
}

std::string CppNames::give(std::string_view name) {
    std::string given = tame(name);
    // A `_` behind one would make two.
    const std::string_view joint = given.ends_with('_') ? "x" : "_";
    if (words_of_cpp().contains(given) || taken_.contains(given)) given += joint;
    const std::string stem = given.ends_with('_') ? given : given + "_";
    for (int number = 2; taken_.contains(given); ++number) {
        given = fmt::format("{}{}", stem, number);
    }
    taken_.insert(given);
    return given;
}

std::string cpp_string(std::string_view text) {
    std::string literal = "\"";
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\') literal += '\\';
        if (byte < 0x20 || byte == 0x7f) {
            literal += fmt::format("\\{:03o}", byte);
        } else {
            literal += c;
        }
    }
    literal += '"';
    if (text.find('\0') == std::string_view::npos) return literal;
    return fmt::format("std::string({}, {})", literal, text.size());
}

}  // namespace vagus::plan
