#include "record/compare_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "base/json.hpp"
#include "base/nearest.hpp"
#include "base/seconds.hpp"
#include "record/compare_tape.hpp"
#include "record/damage.hpp"
#include "record/recorder.hpp"
#include "record/robot_topics.hpp"
#include "record/run_file.hpp"
#include "record/topics.hpp"

namespace vagus::record {

namespace {

constexpr Duration kOutOfOrder = std::chrono::seconds(1);  // messages of different channels
constexpr uint64_t kLookEvery = 1000;                      // messages
constexpr std::string_view kEndLane = "end";

// ---- what is looked up before ----

struct Survey {
    std::optional<Time> start;        // where it is aligned
    std::set<std::string> known;      // what it could be aligned at
    JsonValue about;                  // /vagus/run
    std::vector<std::string> robots;  // with projects of their own
    Time end{};
    std::string how;  // it ended, as JSON
};

class Surveyor {
public:
    Surveyor(const mcap::Reader& reader, const Align& align) : reader_(reader), align_(align) {}

    Result<Survey> look() {
        if (align_.at == Align::At::Start) made_.start = Time{};
        mcap::Cursor cursor(reader_);
        while (const auto message = cursor.next()) {
            const mcap::Channel* const channel = reader_.channel(message->channel);
            if (channel == nullptr) continue;
            const Time at = time_of(message->log_time);
            made_.end = std::max(made_.end, at);
            see(channel->topic, at, message->data);
        }
        TRY(check_read(cursor, reader_));
        made_.robots = TRY(read_run(json_line(made_.about), reader_.name())).robots;
        if (made_.start) return std::move(made_);
        const bool actor = align_.at == Align::At::Actor;
        const std::vector<std::string> known(made_.known.begin(), made_.known.end());
        return Error{Code::NotFound, fmt::format("--align: in {} {} \"{}\"; {}", reader_.name(),
                                                 actor ? "began no actor" : "came no event",
                                                 align_.name, known_instead(align_.name, known))};
    }

private:
    // The first message of a recording says which robots there are.
    void see(std::string_view topic, Time at, std::string_view data) {
        if (align_.at != Align::At::Start) robot_ = robot_of(topic, robots_);
        topic = below_robot(topic, robot_);
        const bool events = align_.at == Align::At::Event && topic == kEventsTopic;
        if (topic != kRunTopic && topic != kTraceTopic && !events) return;
        auto json = read_json(data);
        auto* const message = std::get_if<JsonValue>(&json);
        if (message == nullptr) return;
        if (topic == kRunTopic) {
            see_robots(*message);
            made_.about = std::move(*message);
        } else if (topic == kTraceTopic) {
            see_trace(*message, at);
        } else {
            meet(text_in(*message, "name"), at);
        }
    }

    void see_robots(const JsonValue& about) {
        const JsonValue* const robots = about.find("robots");
        if (robots == nullptr) return;
        for (const JsonValue& one : robots->items) robots_.insert(one.text);
    }

    void see_trace(const JsonValue& line, Time at) {
        const std::string kind = text_in(line, "kind");
        if (kind == "actor-start" && align_.at == Align::At::Actor)
            meet(text_in(line, "actor"), at);
        if (kind == "event" && align_.at == Align::At::Event) meet(text_in(line, "event"), at);
        const bool outermost = text_in(line, "plan").find('/') == std::string::npos;
        if (kind == "plan-end" && outermost && robot_.empty()) {
            made_.how = json_quote(text_in(line, "result"));
        }
    }

    // Of one robot it is known by both names where that is asked for.
    void meet(const std::string& name, Time at) {
        const std::string full = robot_.empty() ? name : robot_ + "/" + name;
        made_.known.insert(align_.name.find('/') == std::string::npos ? name : full);
        if ((name == align_.name || full == align_.name) && !made_.start) made_.start = at;
    }

    const mcap::Reader& reader_;
    const Align& align_;
    RobotNames robots_;
    std::string robot_;  // whose message is seen
    Survey made_;
};

// ---- the lanes ----

class Lanes {
public:
    // `from_start`: both as a whole. `apart`: how far samples of the two are from each other.
    // `robots`: of either, with projects of their own.
    Lanes(bool from_start, Duration apart, const std::vector<std::string>& robots)
        : from_start_(from_start), apart_(apart), robots_(robots.begin(), robots.end()) {
        lines(kInputTopic, {});
        lines_of_bus("");
        lines(kSceneTopic, {}, Telling::WhatDiffers);
        if (from_start) lines(kCheckTopic, {}, Telling::WhatDiffers);
        for (const std::string& robot : robots) {
            const std::string below = std::string(kRobotTopics) + robot;
            if (by_name_.contains(below + std::string(kTraceTopic))) continue;  // of both
            lines_of_bus(below);
            if (from_start) lines(below + std::string(kCheckTopic), {}, Telling::WhatDiffers);
        }
    }

    void take(Side side, const std::string& topic, Time at, std::string_view data) {
        const bool node = topic.find("/node/") != std::string::npos;
        const auto known = by_name_.find(topic);
        if (!node && topic != kPosesTopic && known == by_name_.end()) return;
        const auto json = read_json(data);
        const auto* const message = std::get_if<JsonValue>(&json);
        if (message == nullptr) return;
        if (topic == kPosesTopic) {
            take_poses(side, at, *message);
        } else if (known != by_name_.end()) {
            known->second->add(side, at, *message);
        } else {
            add(make_values_lane(
                topic, apart_ % kVariablesEvery == Duration{} ? Duration{} : kVariablesEvery));
            by_name_.at(topic)->add(side, at, *message);
        }
    }

    void follow(Time until) {
        for (const auto& lane : lanes_) lane->follow(until);
    }
    void end(Time until) {
        for (const auto& lane : lanes_) lane->end(until);
    }

    std::vector<ComparedLane> result() const {
        std::vector<ComparedLane> all;
        for (const auto& lane : lanes_) {
            all.push_back({lane->name(), robot_of(lane->name(), robots_), lane->compared(),
                           lane->difference()});
        }
        return all;
    }

private:
    void lines(std::string_view topic, std::vector<std::string> without,
               Telling telling = Telling::Lines) {
        without.emplace_back("t");
        add(make_lines_lane(std::string(topic), std::move(without), telling));
    }

    // Activations count from the beginning of the run.
    void lines_of_bus(const std::string& below) {
        lines(below + std::string(kTraceTopic),
              from_start_ ? std::vector<std::string>() : std::vector<std::string>{"activation"});
        lines(below + std::string(kEventsTopic), {"frame"});
    }

    void add(std::unique_ptr<Lane> lane) {
        by_name_[lane->name()] = lane.get();
        lanes_.push_back(std::move(lane));
    }

    void take_poses(Side side, Time at, const JsonValue& scene) {
        const JsonValue* const entities = scene.find("entities");
        if (entities == nullptr) return;
        for (const JsonValue& entity : entities->items) {
            const std::string id = text_in(entity, "id");
            const std::string name = fmt::format("{} {}", kPosesTopic, id);
            if (!by_name_.contains(name)) add(make_pose_lane(name));
            by_name_.at(name)->add(side, at, entity);
        }
    }

    bool from_start_;
    Duration apart_;
    RobotNames robots_;
    std::vector<std::unique_ptr<Lane>> lanes_;
    std::map<std::string, Lane*> by_name_;
};

// One of the two files on its way through the lanes.
class Stream {
public:
    Stream(const mcap::Reader& reader, Side side, Time start)
        : reader_(reader), cursor_(reader), side_(side), start_(start) {}

    // Up to when all has been said; Time::max() at the end.
    Time reached() const { return reached_; }

    void step(Lanes& lanes) {
        const auto message = cursor_.next();
        if (!message) {
            reached_ = Time::max();
            return;
        }
        const Time at = time_of(message->log_time) - start_;
        reached_ = std::max(reached_, at);
        const mcap::Channel* const channel = reader_.channel(message->channel);
        if (channel != nullptr) lanes.take(side_, channel->topic, at, message->data);
    }

    // It was all read before, but somebody may have cut it off since.
    Status check() const { return check_read(cursor_, reader_); }

private:
    const mcap::Reader& reader_;
    mcap::Cursor cursor_;
    Side side_;
    Time start_;
    Time reached_ = Time::min();
};

Status run_through(Lanes& lanes, Stream a, Stream b, Time end) {
    for (uint64_t count = 1;; ++count) {
        const Time reached = std::min(a.reached(), b.reached());
        if (reached == Time::max() || (reached > end && reached - kOutOfOrder > end)) break;
        (a.reached() <= b.reached() ? a : b).step(lanes);
        const bool known = std::min(a.reached(), b.reached()) > Time::min();
        if (count % kLookEvery == 0 && known) {
            lanes.follow(std::min(std::min(a.reached(), b.reached()) - kOutOfOrder, end));
        }
    }
    TRY(a.check());
    TRY(b.check());
    lanes.end(end);
    return Status::done();
}

// Up to when all that happened is in the file, from where it is aligned. Without an end it lacks
// what waited to be written, of the last instant and before.
Time told_until(const mcap::Reader& reader, const Survey& survey) {
    const Time end = survey.end - *survey.start;
    return is_whole(reader) ? end : end - kOutOfOrder;
}

ComparedLane compare_ends(const Survey& a, const Survey& b) {
    const auto text = [](const Survey& one) {
        return fmt::format(R"({{"t":{}{}}})", seconds_text(one.end),
                           one.how.empty() ? "" : ",\"result\":" + one.how);
    };
    ComparedLane lane{.name = std::string(kEndLane), .compared = 1};
    const Time end_a = a.end - *a.start;
    const Time end_b = b.end - *b.start;
    if (end_a == end_b && a.how == b.how) return lane;
    lane.difference = LaneDifference{std::min(end_a, end_b), "", text(a), text(b)};
    return lane;
}

// The earliest before the others; lanes of one instant stay in their order.
void put_first_what_differs(std::vector<ComparedLane>& lanes) {
    std::multimap<Time, ComparedLane> sorted;
    for (ComparedLane& lane : lanes) {
        const Time at = lane.difference ? lane.difference->at : Time::max();
        sorted.emplace(at, std::move(lane));
    }
    lanes.clear();
    for (auto& [at, lane] : sorted) lanes.push_back(std::move(lane));
}

// ---- what they were started with ----

void compare_started(const JsonValue& a, const JsonValue& b, std::vector<StartedApart>& found) {
    const auto text = [](const JsonValue* value) {
        return value != nullptr ? json_line(*value) : std::string();
    };
    std::vector<std::string> keys;
    for (const JsonValue* const of : {&a, &b}) {
        for (const JsonMember& one : of->members) {
            if (one.key == "command" || std::find(keys.begin(), keys.end(), one.key) != keys.end())
                continue;  // how it was typed names its own recording
            keys.push_back(one.key);
        }
    }
    for (const std::string& key : keys) {
        const std::string in_a = text(a.find(key));
        const std::string in_b = text(b.find(key));
        if (in_a != in_b) found.push_back({key, in_a, in_b});
    }
}

void compare_files(const mcap::Reader& a, const mcap::Reader& b, std::vector<StartedApart>& found) {
    const auto bytes = [](const mcap::Attachment* one) {
        return one != nullptr ? fmt::format("{} bytes", one->data.size()) : std::string();
    };
    std::set<std::string> names;
    for (const mcap::Reader* const of : {&a, &b}) {
        for (const mcap::Attachment& one : of->attachments()) names.emplace(one.name);
    }
    for (const std::string& name : names) {
        const mcap::Attachment* const in_a = a.attachment(name);
        const mcap::Attachment* const in_b = b.attachment(name);
        if (in_a != nullptr && in_b != nullptr && in_a->data == in_b->data) continue;
        found.push_back({"file " + name, bytes(in_a), bytes(in_b)});
    }
}

}  // namespace

Result<Align> read_align(const std::vector<std::string>& words) {
    if (words.size() == 1 && words[0] == "start") return Align{};
    if (words.size() == 2 && words[0] == "actor") return Align{Align::At::Actor, words[1]};
    if (words.size() == 2 && words[0] == "event") return Align{Align::At::Event, words[1]};
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
    return Error{
        Code::BadInput,
        fmt::format("--align: expected start, actor NAME or event NAME; found \"{}\"", all)};
}

Result<Comparison> compare_runs(const mcap::Reader& a, const mcap::Reader& b, const Align& align) {
    const Survey of_a = TRY(Surveyor(a, align).look());
    const Survey of_b = TRY(Surveyor(b, align).look());
    Comparison made{.start_a = *of_a.start, .start_b = *of_b.start, .started = {}, .lanes = {}};
    compare_started(of_a.about, of_b.about, made.started);
    compare_files(a, b, made.started);
    const bool from_start = align.at == Align::At::Start;
    std::vector<std::string> robots = of_a.robots;
    robots.insert(robots.end(), of_b.robots.begin(), of_b.robots.end());
    Lanes lanes(from_start, made.start_a - made.start_b, robots);
    const Time end = std::min(told_until(a, of_a), told_until(b, of_b));
    TRY(run_through(lanes, {a, Side::A, made.start_a}, {b, Side::B, made.start_b}, end));
    made.lanes = lanes.result();
    if (is_whole(a) && is_whole(b)) made.lanes.push_back(compare_ends(of_a, of_b));
    put_first_what_differs(made.lanes);
    return made;
}

// ---- as text ----

namespace {

// Of a robot without any difference one name stands for all its lanes.
std::string lanes_without_difference(const std::vector<ComparedLane>& lanes) {
    std::set<std::string> differ;
    for (const ComparedLane& lane : lanes) {
        if (lane.difference && !lane.robot.empty()) differ.insert(lane.robot);
    }
    std::string text;
    std::set<std::string> told;
    for (const ComparedLane& lane : lanes) {
        if (lane.difference) continue;
        const bool of_same = !lane.robot.empty() && !differ.contains(lane.robot);
        if (of_same && !told.insert(lane.robot).second) continue;
        text += text.empty() ? "" : ", ";
        text += of_same ? std::string(kRobotTopics) + lane.robot : lane.name;
    }
    return text;
}

}  // namespace

std::string format_comparison(const Comparison& found, const std::string& a, const std::string& b) {
    std::string text;
    const auto or_nothing = [](const std::string& value) {
        return value.empty() ? std::string("nothing") : value;
    };
    const auto both = [&](const std::string& in_a, const std::string& in_b) {
        return fmt::format("  A: {}\n  B: {}\n", or_nothing(in_a), or_nothing(in_b));
    };
    for (const StartedApart& one : found.started) {
        text += fmt::format("started with another {}\n{}", one.what, both(one.a, one.b));
    }
    uint64_t compared = 0;
    for (const ComparedLane& lane : found.lanes) {
        compared += lane.compared;
        if (!lane.difference) continue;
        const LaneDifference& one = *lane.difference;
        const std::string in_a = seconds_text(found.start_a + one.at);
        const std::string in_b = seconds_text(found.start_b + one.at);
        text += fmt::format("differs at {} s{}: {}{}\n{}", in_a,
                            in_a == in_b ? "" : fmt::format(" of A, {} s of B", in_b), lane.name,
                            one.place.empty() ? "" : ", " + one.place, both(one.a, one.b));
    }
    const std::string same = lanes_without_difference(found.lanes);
    if (!found.differs()) {
        return text + fmt::format("{} and {}: {} values compared: no difference\n", a, b, compared);
    }
    return same.empty() ? text : text + "no difference: " + same + "\n";
}

std::string format_comparison_json(const Comparison& found) {
    std::string text = fmt::format("{{\"aligned\":{{\"a\":{},\"b\":{}}},\n\"started\":[",
                                   seconds_text(found.start_a), seconds_text(found.start_b));
    const char* between = "";
    for (const StartedApart& one : found.started) {
        text += fmt::format("{}\n{{\"what\":{},\"a\":{},\"b\":{}}}", between, json_quote(one.what),
                            json_quote(one.a), json_quote(one.b));
        between = ",";
    }
    text += "],\n\"lanes\":[";
    between = "";
    for (const ComparedLane& lane : found.lanes) {
        std::string difference = "null";
        if (lane.difference) {
            const LaneDifference& one = *lane.difference;
            difference =
                fmt::format(R"({{"a_t":{},"b_t":{},"place":{},"a":{},"b":{}}})",
                            seconds_text(found.start_a + one.at),
                            seconds_text(found.start_b + one.at), json_quote(one.place),
                            one.a.empty() ? "null" : one.a, one.b.empty() ? "null" : one.b);
        }
        text += fmt::format("{}\n{{\"lane\":{},\"compared\":{},\"difference\":{}}}", between,
                            json_quote(lane.name), lane.compared, difference);
        between = ",";
    }
    return text + "]}\n";
}

}  // namespace vagus::record
