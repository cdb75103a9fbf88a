#include "plan/icon.hpp"

#include <algorithm>

#include "plan/value.hpp"

namespace vagus::plan {

namespace {

constexpr std::string_view kSpaces = " \t\n\r";

// Numbers that a command takes; -1: there is no such command.
int arguments_of(char command) {
    switch (command | 0x20) {
        case 'z':
            return 0;
        case 'h':
        case 'v':
            return 1;
        case 'm':
        case 'l':
        case 't':
            return 2;
        case 's':
        case 'q':
            return 4;
        case 'c':
            return 6;
        case 'a':
            return 7;
        default:
            return -1;
    }
}

class PathReader {
public:
    explicit PathReader(std::string_view text) : rest_(text) {}

    bool read() {
        skip_spaces();
        if (rest_.empty() || (rest_[0] != 'M' && rest_[0] != 'm')) return false;
        while (!rest_.empty()) {
            if (!command()) return false;
        }
        return true;
    }

private:
    bool command() {
        const char letter = rest_[0];
        const bool is_letter = (letter >= 'A' && letter <= 'Z') || (letter >= 'a' && letter <= 'z');
        const int wanted = is_letter ? arguments_of(letter) : -1;
        if (wanted < 0) return false;
        rest_.remove_prefix(1);
        skip_spaces();
        int found = 0;
        const bool arc = wanted == 7;
        while (wanted > 0 && (found % wanted != 0 || found == 0 || number_follows())) {
            const bool is_flag = arc && (found % 7 == 3 || found % 7 == 4);
            if (!(is_flag ? flag() : number())) return false;
            ++found;
        }
        return true;
    }

    bool number_follows() const {
        return !rest_.empty() && std::string_view("+-.0123456789").find(rest_[0]) != rest_.npos;
    }

    // One digit, which the next number may follow at once.
    bool flag() {
        if (rest_.empty() || (rest_[0] != '0' && rest_[0] != '1')) return false;
        rest_.remove_prefix(1);
        skip_comma();
        return true;
    }

    // [sign] digits [. digits] [exponent], or without the digits before the point.
    bool number() {
        if (!rest_.empty() && (rest_[0] == '+' || rest_[0] == '-')) rest_.remove_prefix(1);
        const bool small = rest_.starts_with('.');
        if (small) rest_.remove_prefix(1);
        // Behind a first point a second one begins the next number.
        const std::string_view rest = small ? rest_.substr(0, rest_.find('.')) : rest_;
        const size_t length = number_at(rest).length;
        if (length == 0) return false;
        rest_.remove_prefix(length);
        skip_comma();
        return true;
    }

    void skip_spaces() { rest_.remove_prefix(std::min(rest_.find_first_not_of(kSpaces), size())); }

    void skip_comma() {
        skip_spaces();
        if (!rest_.starts_with(',')) return;
        rest_.remove_prefix(1);
        skip_spaces();
    }

    size_t size() const { return rest_.size(); }

    std::string_view rest_;
};

}  // namespace

bool is_path_data(std::string_view text) {
    return text.size() <= kIconBytesMax && PathReader(text).read();
}

}  // namespace vagus::plan
