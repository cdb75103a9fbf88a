// A log that outsiders cannot fill: equal lines one behind the other are merged, and no more than
// so many are written in a second; what was left out is counted. Told the time.
//
//     CalmLog log([](const std::string& line) { print(line); });
//     log.add("127.0.0.1: a wrong token", now);
//     log.tick(now);                              // says how often, when it was quiet
#pragma once

#include <functional>
#include <string>

#include "base/time.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr size_t kLogLinesASecond = 20;
constexpr Duration kMergeLinesFor = 10s;  // then it is said how often the line came

class CalmLog {
public:
    explicit CalmLog(std::function<void(const std::string&)> write) : write_(std::move(write)) {}

    void add(const std::string& line, Time now);
    void tick(Time now);

private:
    void tell_repeated();
    void tell_left_out(Time now);
    void write(const std::string& line);

    std::function<void(const std::string&)> write_;
    std::string last_;
    size_t repeated_ = 0;
    Time repeated_since_{};
    Time second_since_{};
    size_t written_ = 0, left_out_ = 0;  // in this second
};

}  // namespace vagus::serve
