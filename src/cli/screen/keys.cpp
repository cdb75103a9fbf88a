#include "cli/screen/keys.hpp"

namespace vagus::cli {
namespace {

constexpr char kEscape = '\x1b';

std::optional<Key> plain_key(char byte) {
    switch (byte) {
        case ' ':
        case 'p':
            return Key::Pause;
        case 'r':
        case 'R':
            return Key::Restart;
        case '+':
        case '=':
            return Key::Faster;
        case '-':
            return Key::Slower;
        case '\t':
            return Key::NextRobot;
        case 'b':
            return Key::Centre;
        case 't':
            return Key::Tap;
        case 'e':
            return Key::Escape;
        case 'q':
        case 'Q':
        case '\x03':
            return Key::Quit;
        case '\x0c':
            return Key::Redraw;
        default:
            return static_cast<unsigned char>(byte) < 0x80 ? std::optional(Key::Other)
                                                           : std::nullopt;
    }
}

// An answer of the terminal, ended by BEL or ESC \. Alt and ] begin alike, but no digit follows.
size_t answer_length(std::string_view bytes) {
    if (bytes.size() < 3) return 0;
    if (bytes[2] < '0' || bytes[2] > '9') return 2;
    for (size_t i = 3; i < bytes.size(); i++) {
        if (bytes[i] == '\x07') return i + 1;
        if (bytes[i] == '\\' && bytes[i - 1] == kEscape) return i + 1;
    }
    return 0;
}

// Arrows come as ESC [ letter or ESC O letter, by the mode of the terminal.
std::optional<Key> sequence_key(std::string_view sequence) {
    if (sequence == "\x1b[Z") return Key::LastRobot;
    if (sequence == "\x1b[5~") return Key::Earlier;
    if (sequence == "\x1b[6~") return Key::Later;
    if (sequence.size() != 3) return std::nullopt;
    switch (sequence[2]) {
        case 'A':
            return Key::Forward;
        case 'B':
            return Key::Backward;
        case 'C':
            return Key::Right;
        case 'D':
            return Key::Left;
        default:
            return std::nullopt;
    }
}

}  // namespace

size_t sequence_length(std::string_view bytes) {
    if (bytes.size() < 2) return 0;
    if (bytes[1] == 'O') return bytes.size() < 3 ? 0 : 3;
    if (bytes[1] == ']') return answer_length(bytes);
    if (bytes[1] != '[') return bytes[1] == kEscape ? 1 : 2;
    for (size_t i = 2; i < bytes.size(); i++) {
        if (bytes[i] >= 0x40 && bytes[i] <= 0x7e) return i + 1;
    }
    return 0;
}

std::vector<Key> keys_of(std::string_view bytes, std::string& rest) {
    std::vector<Key> keys;
    rest += bytes;
    std::string_view left = rest;
    while (!left.empty()) {
        if (left[0] != kEscape) {
            if (const auto key = plain_key(left[0])) keys.push_back(*key);
            left.remove_prefix(1);
            continue;
        }
        const size_t length = sequence_length(left);
        if (length == 0) break;
        if (const auto key = sequence_key(left.substr(0, length))) keys.push_back(*key);
        left.remove_prefix(length);
    }
    rest = left.size() > kSequenceMax ? "" : std::string(left);
    return keys;
}

}  // namespace vagus::cli
