#include "serve/history/lane.hpp"

#include "serve/json.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <vector>

namespace vagus::serve {

namespace {

bool is_narrow(const Bar& bar, double pixel) {
    return bar.to - bar.from < pixel;
}

// Neighbours that are narrower than a pixel become one bar, without a name if theirs differ.
std::vector<Bar> bars_in(const std::deque<Bar>& bars, const LaneWindow& window) {
    std::vector<Bar> found;
    for (const Bar& bar : bars) {
        if (bar.to < window.from || bar.from > window.to) continue;
        const bool joins = !found.empty() && is_narrow(bar, window.pixel()) &&
                           is_narrow(found.back(), window.pixel()) &&
                           bar.to - found.back().from < window.pixel();
        if (!joins) {
            found.push_back(bar);
            continue;
        }
        Bar& last = found.back();
        last.to = bar.to;
        last.count += bar.count;
        if (last.name != bar.name) last.name.clear();
        last.end = bar.end;
    }
    return found;
}

std::vector<Mark> marks_in(const std::deque<Mark>& marks, const LaneWindow& window) {
    std::vector<Mark> found;
    for (const Mark& mark : marks) {
        if (mark.t < window.from || mark.t > window.to) continue;
        if (found.empty() || mark.t - found.back().t >= window.pixel()) {
            found.push_back(mark);
            continue;
        }
        Mark& last = found.back();
        last.count += mark.count;
        if (last.name != mark.name) last.name.clear();
        if (last.to != mark.to) last.to.clear();
    }
    return found;
}

Json json_of(const Bar& bar) {
    Json json = {{"from", bar.from}};
    if (!bar.open()) json["to"] = bar.to;
    if (!bar.name.empty()) json["name"] = bar.name;
    if (!bar.end.empty()) json["end"] = bar.end;
    if (bar.count > 1) json["count"] = bar.count;
    return json;
}

Json json_of(const Mark& mark) {
    Json json = {{"t", mark.t}};
    if (!mark.name.empty()) json["name"] = mark.name;
    if (!mark.to.empty()) json["to"] = mark.to;
    if (mark.count > 1) json["count"] = mark.count;
    return json;
}

template <typename Items>
Json list_of(const Items& items) {
    Json list = Json::array();
    for (const auto& one : items) list.push_back(json_of(one));
    return list;
}

Json lane_json(const Lane& lane, const std::vector<Bar>& bars, const std::vector<Mark>& marks) {
    return {{"kind", lane.kind},
            {"path", lane.path},
            {"name", lane.name},
            {"bars", list_of(bars)},
            {"marks", list_of(marks)}};
}

Bar run_of(const std::vector<Mark>& marks) {
    Bar run{marks.front().t, marks.back().t, marks.front().name, {}, 0};
    for (const Mark& mark : marks) {
        run.count += mark.count;
        if (mark.name != run.name) run.name.clear();
    }
    return run;
}

}  // namespace

void Lane::begin(double t, const std::string& bar) {
    bars.push_back({.from = t, .name = bar});
    if (bars.size() > kLaneItemsKept) bars.pop_front();
}

void Lane::end(double t, const std::string& how) {
    if (!is_open()) return;
    bars.back().to = std::max(t, bars.back().from);
    bars.back().end = how;
}

void Lane::mark(Mark mark) {
    marks.push_back(std::move(mark));
    if (marks.size() > kLaneItemsKept) marks.pop_front();
}

void Lane::cut(double t) {
    while (!bars.empty() && bars.back().from > t) bars.pop_back();
    if (!bars.empty() && bars.back().to > t) {
        bars.back().to = std::numeric_limits<double>::infinity();
        bars.back().end.clear();
    }
    while (!marks.empty() && marks.back().t > t) marks.pop_back();
}

Json Lane::shown(const LaneWindow& window) const {
    return lane_json(*this, bars_in(bars, window), marks_in(marks, window));
}

Json Lane::shown_in_runs(const LaneWindow& window) const {
    std::vector<Bar> runs;
    std::vector<Mark> alone;
    std::vector<Mark> close;
    const auto settle = [&] {
        if (close.size() > 2) {
            runs.push_back(run_of(close));
        } else {
            alone.insert(alone.end(), close.begin(), close.end());
        }
        close.clear();
    };
    for (const Mark& mark : marks_in(marks, window)) {
        if (!close.empty() && mark.t - close.back().t > kMarksApart * window.pixel()) settle();
        close.push_back(mark);
    }
    settle();
    return lane_json(*this, runs, alone);
}

}  // namespace vagus::serve
