#include "base/shell_word.hpp"

namespace vagus {

std::string shell_word(std::string_view text) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./:@%+,=";
    const bool plain = !text.empty() && text.find_first_not_of(kPlain) == std::string_view::npos;
    if (plain) return std::string(text);
    std::string word = "'";
    for (const char letter : text) {
        if (letter == '\'') word += "'\\'";  // out of the quotes, and into them again
        word += letter;
    }
    return word + "'";
}

}  // namespace vagus
