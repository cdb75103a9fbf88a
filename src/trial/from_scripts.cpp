#include "trial/from_scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>

#include "base/json.hpp"
#include "plan/value.hpp"
#include "record/damage.hpp"
#include "record/past_run.hpp"
#include "record/scene_shape.hpp"
#include "record/topics.hpp"
#include "trial/draft_text.hpp"
#include "wire/messages.hpp"

namespace vagus::trial {

namespace {

namespace fs = std::filesystem;

// ---- what the recording tells ----

struct EventCame {
    std::string event;
    double at = 0;
};

struct ScriptsTold {
    record::RecordedRun run;
    double end = 0;                    // s: in whole tenths, at which there is a pose
    std::vector<std::string> robots;   // by name
    std::vector<std::string> scripts;  // that the world does not name, by name
    std::vector<EventCame> came;       // for the first time
    std::optional<sim::Point> place;   // of the first robot, at the end
};

// The robots of its world, and the scripts that it names for them.
void read_robots(const mcap::Reader& reader, ScriptsTold& told, std::set<std::string>& named) {
    const std::string& world = told.run.about.world;
    const mcap::Attachment* const file = reader.attachment(world);
    if (file == nullptr) return;
    const auto json = read_json(file->data);
    const auto* const tree = std::get_if<JsonValue>(&json);
    const JsonValue* const robots = tree == nullptr ? nullptr : tree->find("robots");
    if (robots == nullptr) return;
    for (const JsonValue& robot : robots->items) {
        told.robots.push_back(text_in(robot, "name"));
        const fs::path script = fs::path(world).parent_path() / text_in(robot, "script");
        named.insert(script.lexically_normal().generic_string());
    }
}

// Those that were loaded beside the world: by --load, or by the studio as the run began.
void read_scripts(ScriptsTold& told, const std::set<std::string>& named) {
    told.scripts = told.run.about.loads;
    for (const record::Input& input : told.run.inputs) {
        const auto* const loaded = std::get_if<record::ScriptLoaded>(&input.what);
        const bool is_other = loaded != nullptr && !named.contains(loaded->file);
        if (!is_other || std::ranges::find(told.scripts, loaded->file) != told.scripts.end()) {
            continue;
        }
        told.scripts.push_back(loaded->file);
    }
}

void read_event(std::string_view data, ScriptsTold& told) {
    const auto json = read_json(data);
    const auto* const tree = std::get_if<JsonValue>(&json);
    const JsonValue* const name = tree == nullptr ? nullptr : tree->find("name");
    const JsonValue* const t = tree == nullptr ? nullptr : tree->find("t");
    // Without a name it is a number.
    if (name == nullptr || name->kind != JsonKind::String || t == nullptr) return;
    if (t->number > told.end || told.came.size() >= kEventsDrafted) return;
    if (std::ranges::find(told.came, name->text, &EventCame::event) != told.came.end()) return;
    told.came.push_back({name->text, t->number});
}

// Of a SceneUpdate: the middle of the robot's body.
std::optional<sim::Point> place_in(std::string_view data, const std::string& robot) {
    const auto json = read_json(data);
    const auto* const tree = std::get_if<JsonValue>(&json);
    const JsonValue* const entities = tree == nullptr ? nullptr : tree->find("entities");
    if (entities == nullptr) return std::nullopt;
    for (const JsonValue& entity : entities->items) {
        if (text_in(entity, "id") != "robot/" + robot) continue;
        const auto shape = record::scene_shape(entity);
        if (shape) return sim::Point{shape->x, shape->y};
    }
    return std::nullopt;
}

Result<ScriptsTold> read_told(const mcap::Reader& reader) {
    ScriptsTold told;
    told.run = TRY(record::read_recorded(reader));
    constexpr double kTenth = 10;
    told.end = std::floor(seconds_of(told.run.end) * kTenth) / kTenth;
    std::set<std::string> named;
    read_robots(reader, told, named);
    read_scripts(told, named);
    const mcap::Channel* const events = reader.find(record::kEventsTopic);
    const mcap::Channel* const poses = reader.find(record::kPosesTopic);
    std::string pose;
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        if (events != nullptr && message->channel == events->id) read_event(message->data, told);
        const bool is_pose = poses != nullptr && message->channel == poses->id;
        const double at = seconds_of(record::time_of(message->log_time));
        if (is_pose && at <= told.end) pose = message->data;
    }
    TRY(record::check_read(cursor, reader));
    if (!told.robots.empty()) told.place = place_in(pose, told.robots.front());
    return told;
}

// ---- the test ----

std::string two_places(double value) {
    constexpr double kHundredth = 100;
    return plan::text_of(std::round(value * kHundredth) / kHundredth + 0.0);
}

std::string near(std::string_view name, double value) {
    return fmt::format("abs({} - {}) < {}", name,
                       value < 0 ? "(" + two_places(value) + ")" : two_places(value), kPlaceRoom);
}

std::vector<std::string> expectations(const ScriptsTold& told, const DraftOptions& options) {
    std::vector<std::string> lines;
    if (options.untouched) lines.emplace_back(kUntouched);
    for (const EventCame& one : told.came) {
        if (!options.events) break;
        const double within = std::min(round_up(std::max(one.at, 0.1)), told.end);
        lines.push_back(fmt::format("{{ \"within\": {}, \"eventually\": {} }}", number(within),
                                    json_quote("event == '" + one.event + "'")));
    }
    if (told.place) {
        const std::string place = fmt::format("t > {} and {} and {}", number(told.end - 0.1),
                                              near("x", told.place->x), near("y", told.place->y));
        lines.push_back(fmt::format(
            "{{ \"eventually\": {}, \"help\": \"where it is at the end\" }}", json_quote(place)));
    }
    lines.emplace_back(kTimeWasOver);
    return lines;
}

bool is_by_hand(const record::Input& input) {
    const auto* const frame = std::get_if<wire::Frame>(&input.what);
    if (frame == nullptr) return std::holds_alternative<sim::Act>(input.what);
    return wire::is_user_event(frame->type) ||
           frame->type == static_cast<uint16_t>(wire::MessageType::SetVariables);
}

}  // namespace

Result<Draft> draft_script_test(const mcap::Reader& reader, const DraftOptions& options) {
    const ScriptsTold told = TRY(read_told(reader));
    const record::RunFile& about = told.run.about;
    if (told.end < kScriptsRunMin) {
        return Error{Code::Refused, fmt::format("{}: the run took {} s, in which nothing is seen; "
                                                "let it run for longer",
                                                reader.name(), plan::text_of(told.end))};
    }
    Draft draft{.world = last_part(about.world)};
    std::vector<std::string> members = first_members(reader.name());
    members.push_back("\"world\": " + json_quote(draft.world));
    const bool several = told.robots.size() > 1;
    if (several) members.push_back("\"robot\": " + json_quote(told.robots.front()));
    add_files(members, "scripts", about.world, told.scripts);
    members.push_back(seeds_member(seed_of(reader, about)));
    members.push_back("\"max_time\": " + number(told.end));
    members.push_back(expect_member(expectations(told, options)));
    draft.text = test_text(members);
    const auto by_hand = std::ranges::count_if(told.run.inputs, is_by_hand);
    draft.hints = hints_of(about, static_cast<size_t>(by_hand));
    if (several) {
        draft.hints.push_back(fmt::format(
            "of {} robots the test is about the first, {}; name another one as its \"robot\"",
            told.robots.size(), told.robots.front()));
    }
    return draft;
}

}  // namespace vagus::trial
