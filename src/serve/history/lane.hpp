// What a timeline draws in one row: bars and marks over time, and what is left of them in a window
// of so many pixels: what would fall into one pixel becomes one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vagus::serve {

constexpr size_t kLaneItemsKept = 20'000;  // bars of a lane, and marks; the oldest go first
constexpr double kMarksApart = 6;          // pixels; marks that are closer become a bar

struct LaneWindow {
    double from = 0, to = 0;
    size_t width = 0;  // pixels
    double pixel() const { return (to - from) / static_cast<double>(width); }
};

struct Bar {
    double from = 0;
    double to = std::numeric_limits<double>::infinity();  // still open
    std::string name = {};
    std::string end = {};  // how it ended
    uint64_t count = 1;    // of those that became this one
    bool open() const { return to == std::numeric_limits<double>::infinity(); }
};

struct Mark {
    double t = 0;
    std::string name = {};
    std::string to = {};  // where it leads
    uint64_t count = 1;
};

struct Lane {
    std::string kind, path, name;
    std::deque<Bar> bars = {};
    std::deque<Mark> marks = {};

    void begin(double t, const std::string& bar = {});
    // Of the bar that is open, if there is one.
    void end(double t, const std::string& how = {});
    void mark(Mark mark);
    // As if nothing had been told after that instant: a bar that ended later is open again.
    void cut(double t);
    bool is_open() const { return !bars.empty() && bars.back().open(); }
    // HistoryLane of the protocol.
    nlohmann::json shown(const LaneWindow& window) const;
    // The same, with marks that are close to each other as bars.
    nlohmann::json shown_in_runs(const LaneWindow& window) const;
};

}  // namespace vagus::serve
