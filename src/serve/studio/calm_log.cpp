#include "serve/studio/calm_log.hpp"

#include <fmt/format.h>

namespace vagus::serve {

void CalmLog::add(const std::string& line, Time now) {
    tick(now);
    if (line == last_) {
        if (repeated_++ == 0) repeated_since_ = now;
        return;
    }
    tell_repeated();
    last_ = line;
    write(line);
}

void CalmLog::tick(Time now) {
    tell_left_out(now);
    if (repeated_ > 0 && now >= repeated_since_ + kMergeLinesFor) tell_repeated();
}

void CalmLog::tell_repeated() {
    if (repeated_ > 0) write(fmt::format("{} ({} more times)", last_, repeated_));
    repeated_ = 0;
}

void CalmLog::tell_left_out(Time now) {
    if (now < second_since_ + 1s) return;
    if (left_out_ > 0) write_(fmt::format("{} lines were left out", left_out_));
    second_since_ = now;
    written_ = left_out_ = 0;
}

void CalmLog::write(const std::string& line) {
    if (written_ >= kLogLinesASecond) {
        ++left_out_;
        return;
    }
    ++written_;
    write_(line);
}

}  // namespace vagus::serve
