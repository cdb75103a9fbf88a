#include "trial/recorded_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/json.hpp"
#include "embed/loaded_plan.hpp"
#include "record/damage.hpp"
#include "record/emitters.hpp"
#include "record/past_bus.hpp"
#include "record/replay.hpp"
#include "record/topics.hpp"
#include "wire/protocol.hpp"

namespace vagus::trial {

namespace {

std::string_view view_at(const JsonValue& json, std::string_view key) {
    const JsonValue* const value = json.find(key);
    return value == nullptr ? std::string_view() : std::string_view(value->text);
}

// A line of a trace of the kinds that are counted, which points into the JSON.
std::optional<plan::TraceEvent> counted_event(const JsonValue& json) {
    plan::TraceEvent event{.at = {}, .plan = std::string(view_at(json, "plan")), .what = {}};
    const std::string_view kind = view_at(json, "kind");
    if (kind == "plan-start") {
        event.what = plan::PlanStarted{};
    } else if (kind == "actor-start") {
        event.what = plan::ActorStarted{view_at(json, "actor"), 0, {}};
    } else if (kind == "actor-end") {
        event.what = plan::ActorEnded{view_at(json, "actor"), 0, view_at(json, "state"), {}};
    } else if (kind == "event") {
        const JsonValue* const global = json.find("global");
        event.what = plan::EventRaised{view_at(json, "supervisor"),
                                       view_at(json, "event"),
                                       {},
                                       global != nullptr && global->boolean,
                                       0};
    } else {
        return std::nullopt;
    }
    return event;
}

Error not_of_plan(const mcap::Reader& reader, std::string_view line) {
    return {Code::BadInput,
            fmt::format("{}: its trace does not fit its plan at {}; expected names of actors, "
                        "states, supervisors and events of the plan that is attached; record the "
                        "run again",
                        reader.name(), line)};
}

// Up to its end, or to where another version of the plan took over.
Status count_trace(const mcap::Reader& reader, PlanCounter& counter, CountedRun& run) {
    const mcap::Channel* const channel = reader.find(record::kTraceTopic);
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        if (channel == nullptr || message->channel != channel->id) continue;
        const auto json = read_json(message->data);
        const auto* const tree = std::get_if<JsonValue>(&json);
        if (tree == nullptr) return not_of_plan(reader, message->data);
        run.end = record::time_of(message->log_time);
        run.changed = view_at(*tree, "kind") == "change";
        if (run.changed) return Status::done();
        const std::optional<plan::TraceEvent> event = counted_event(*tree);
        if (!event) continue;
        if (!counter.fits(*event)) return not_of_plan(reader, message->data);
        counter.see(*event);
    }
    return record::check_read(cursor, reader);
}

// The lines that alone can have sent what was on the bus, of the script that is attached.
ScriptCoverage told_by_frames(const record::PastBus& past) {
    // Of the file, by node and event; 0: not known.
    std::map<uint16_t, std::map<std::string, int>> lines;
    ScriptCoverage told;
    told.only_told = true;
    for (const auto& [number, one] : past.events()) {
        const record::RecordedEvent& event = one.event;
        if (event.node == wire::kHostId) continue;
        const auto [script, common, file, is_attached] = past.script_of(event.node, event.at);
        if (script == nullptr || !is_attached) continue;
        const auto [line, is_first] = lines[event.node].try_emplace(event.name, 0);
        if (is_first) {
            const auto from = record::emitters_of(*script, *common, event.name);
            const bool is_sure = from.lines.size() == 1;
            if (is_sure) line->second = script->first_line + *from.lines.begin() - 1;
        }
        if (line->second > 0) ++told.lines[line->second];
    }
    return told;
}

}  // namespace

void RecordedRuns::know(const std::string& path, std::string content) {
    files_[path] = std::move(content);
}

std::string RecordedRuns::name_of(const mcap::Reader& reader, const std::string& file) {
    const mcap::Attachment* const attached = reader.attachment(file);
    const std::string content(attached == nullptr ? std::string_view() : attached->data);
    const auto same = std::ranges::find_if(
        files_, [&content](const auto& known) { return known.second == content; });
    if (same != files_.end()) return same->first;
    const std::string name = files_.contains(file) ? reader.name() + ":" + file : file;
    files_[name] = content;
    return name;
}

Result<CountedRun> RecordedRuns::add(const mcap::Reader& reader) {
    const auto rerun = TRY(record::Rerun::open(reader, {}));
    const record::RunFile& about = rerun->about();
    TRY(record::check_no_fleet(about, reader.name(),
                               "; coverage counts what one plan went through: record it with "
                               "`vagus plan run … --record FILE`"));
    if (rerun->plan() == nullptr) {
        return Error{Code::Refused, reader.name() +
                                        ": is the recording of a run without a plan, and what a "
                                        "plan went through is counted: record with `vagus plan "
                                        "run … --record FILE`"};
    }
    PlanCounter counter(rerun->plan()->graph());
    CountedRun counted{.plan = name_of(reader, about.plan), .of_bus = about.is_of_bus()};
    TRY(count_trace(reader, counter, counted));
    Coverage of_run;
    const Coverage of_plan = counter.coverage();
    for (const auto& [path, counts] : of_plan.plans) {
        of_run.plans.emplace(name_of(reader, rerun->name_of(path)), counts);
    }
    if (rerun->past_bus() != nullptr && !about.project.empty()) {
        ScriptCoverage told = told_by_frames(*rerun->past_bus());
        if (!told.lines.empty()) {
            of_run.scripts.emplace(name_of(reader, about.project), std::move(told));
        }
    }
    coverage_.add(of_run);
    for (plan::Plan plan : rerun->plan()->plans()) {
        plan.file = name_of(reader, rerun->name_of(plan.file));
        const bool is_there =
            std::ranges::find(plans_, plan.file, &plan::Plan::file) != plans_.end();
        if (!is_there) plans_.push_back(std::move(plan));
    }
    return counted;
}

}  // namespace vagus::trial
