#include "record/compare_lanes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "record/compare_tape.hpp"
#include "record/scene_shape.hpp"

namespace vagus::record {

namespace {

void leave_out(JsonValue& value, std::string_view key) {
    std::erase_if(value.members, [key](const JsonMember& one) { return one.key == key; });
}

// Of scenes: also far inside.
void leave_out_everywhere(JsonValue& value, std::string_view key) {
    leave_out(value, key);
    for (JsonMember& one : value.members) leave_out_everywhere(one.value, key);
    for (JsonValue& one : value.items) leave_out_everywhere(one, key);
}

// ---- lines ----

class LinesLane final : public Lane {
public:
    LinesLane(std::string name, std::vector<std::string> without, Telling telling)
        : Lane(std::move(name)), without_(std::move(without)), telling_(telling) {}

    void add(Side side, Time at, const JsonValue& message) override {
        if (difference() || at < Time{}) return;
        JsonValue line = message;
        for (const std::string& key : without_) leave_out(line, key);
        leave_out_everywhere(line, "timestamp");
        lines_[index(side)].push_back({at, json_line(line)});
    }

    void follow(Time until) override {
        std::deque<Line>& a = lines_[0];
        std::deque<Line>& b = lines_[1];
        while (!difference() && (!a.empty() || !b.empty())) {
            const bool both = !a.empty() && !b.empty() && a.front().at == b.front().at;
            const bool of_a = b.empty() || (!a.empty() && a.front().at <= b.front().at);
            const Line& first = of_a ? a.front() : b.front();
            if (first.at > until) return;
            ++compared_;
            if (!both) {
                found({first.at, "", of_a ? first.text : "", of_a ? "" : first.text});
            } else if (a.front().text != b.front().text) {
                differs(a.front().text, b.front().text, first.at);
            } else {
                a.pop_front();
                b.pop_front();
            }
        }
    }

private:
    struct Line {
        Time at{};
        std::string text;
    };
    void differs(const std::string& a, const std::string& b, Time at) {
        const Difference inside = first_difference(a, b);
        const bool whole = telling_ == Telling::Lines;
        found({at, inside.place, whole ? a : inside.then, whole ? b : inside.now});
    }

    std::vector<std::string> without_;
    Telling telling_;
    std::array<std::deque<Line>, 2> lines_;
};

// ---- variables ----

class ValuesLane final : public Lane {
public:
    ValuesLane(std::string name, Duration window) : Lane(std::move(name)), window_(window) {}

    void add(Side side, Time at, const JsonValue& message) override {
        if (difference()) return;
        Said said{.at = at, .values = {}};
        const JsonValue* const set = message.find("set");
        if (set == nullptr) return;
        for (const JsonMember& one : set->members) {
            said.values.emplace_back(one.key, json_line(one.value));
        }
        said_[index(side)].push_back(std::move(said));
    }

    // What comes within the window is needed, too.
    void follow(Time until) override { compare(until - window_); }
    void end(Time until) override {
        compare(until);
        if (!difference()) begin();
    }

private:
    struct Said {
        Time at{};
        std::vector<std::pair<std::string, std::string>> values;
    };
    using History = std::deque<std::pair<Time, std::string>>;  // of one variable

    void compare(Time until) {
        while (!difference()) {
            Time next = Time::max();
            for (const auto& queue : said_) {
                if (!queue.empty()) next = std::min(next, queue.front().at);
            }
            if (next > until || next == Time::max()) return;
            if (next > Time{}) begin();
            std::array<std::set<std::string>, 2> changed;
            for (const size_t side : {0u, 1u}) take(side, next, changed[side]);
            if (next < Time{}) continue;
            for (const size_t side : {0u, 1u}) {
                for (const std::string& name : changed[side]) compare(side, name, next);
            }
        }
    }

    // What both hold where they are aligned.
    void begin() {
        if (std::exchange(begun_, true)) return;
        for (const auto& [name, history] : known_[0]) compare(0, name, Time{});
    }

    void take(size_t side, Time at, std::set<std::string>& changed) {
        for (auto& queue = said_[side]; !queue.empty() && queue.front().at == at;
             queue.pop_front()) {
            for (auto& [name, value] : queue.front().values) {
                History& history = known_[side][name];
                // One older than the window is enough.
                while (history.size() > 1 && history[1].first < at - 2 * window_) {
                    history.pop_front();
                }
                history.emplace_back(at, std::move(value));
                changed.insert(name);
            }
        }
    }

    void compare(size_t side, const std::string& name, Time at) {
        const auto mine = known_[side].find(name);
        const auto other = known_[1 - side].find(name);
        if (mine == known_[side].end() || other == known_[1 - side].end()) return;
        ++compared_;
        const std::string& value = mine->second.back().second;
        const History& history = other->second;
        for (size_t i = history.size(); i-- > 0;) {
            if (history[i].second == value) return;
            if (history[i].first <= at - window_) break;
        }
        for (const Said& later : said_[1 - side]) {
            if (later.at > at + window_) break;
            for (const auto& [key, next] : later.values) {
                if (key == name && next == value) return;
            }
        }
        const std::string& theirs = history.back().second;
        found({at, name, side == 0 ? value : theirs, side == 0 ? theirs : value});
    }

    Duration window_;
    bool begun_ = false;
    std::array<std::deque<Said>, 2> said_;
    std::array<std::map<std::string, History>, 2> known_;
};

// ---- poses ----

struct Sample {
    Time at{};
    double x = 0;  // m
    double y = 0;
    double angle = 0;  // rad
};

std::string pose_json(const Sample& pose) {
    return fmt::format(R"({{"x":{:.6f},"y":{:.6f},"angle":{:.2f}}})", pose.x, pose.y,
                       pose.angle * 180 / trig::kPi);
}

// From a to b, the shorter way round.
double turned(double a, double b) {
    return std::remainder(b - a, 2 * trig::kPi);
}

class PoseLane final : public Lane {
public:
    using Lane::Lane;

    void add(Side side, Time at, const JsonValue& entity) override {
        if (difference()) return;
        const auto shape = scene_shape(entity);
        if (shape) samples_[index(side)].push_back({at, shape->x, shape->y, shape->angle});
    }

    void follow(Time until) override {
        std::deque<Sample>& a = samples_[0];
        std::deque<Sample>& b = samples_[1];
        for (; !difference() && !a.empty() && a.front().at <= until; a.pop_front()) {
            while (b.size() > 1 && b[1].at <= a.front().at) b.pop_front();
            if (a.front().at < Time{} || b.empty() || b.front().at > a.front().at) continue;
            if (b.front().at == a.front().at) {
                compare(a.front(), b.front(), 0, 0);
            } else if (b.size() > 1) {
                compare(a.front(), between(b[0], b[1], a.front().at), kPoseApart, kPoseTurned);
            }
        }
    }

private:
    static Sample between(const Sample& a, const Sample& b, Time at) {
        const double share = seconds_of(at - a.at) / seconds_of(b.at - a.at);
        return {at, a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
                a.angle + share * turned(a.angle, b.angle)};
    }

    void compare(const Sample& a, const Sample& b, double apart, double angle) {
        ++compared_;
        const bool here = std::abs(a.x - b.x) <= apart && std::abs(a.y - b.y) <= apart;
        if (here && std::abs(turned(a.angle, b.angle)) <= angle) return;
        found({a.at, "", pose_json(a), pose_json(b)});
    }

    std::array<std::deque<Sample>, 2> samples_;
};

}  // namespace

std::unique_ptr<Lane> make_lines_lane(std::string name, std::vector<std::string> without,
                                      Telling telling) {
    return std::make_unique<LinesLane>(std::move(name), std::move(without), telling);
}

std::unique_ptr<Lane> make_values_lane(std::string name, Duration window) {
    return std::make_unique<ValuesLane>(std::move(name), window);
}

std::unique_ptr<Lane> make_pose_lane(std::string name) {
    return std::make_unique<PoseLane>(std::move(name));
}

}  // namespace vagus::record
