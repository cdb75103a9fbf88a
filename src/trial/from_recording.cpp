#include "trial/from_recording.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/json.hpp"
#include "base/text.hpp"
#include "plan/value.hpp"
#include "record/damage.hpp"
#include "record/inputs.hpp"
#include "record/run_file.hpp"
#include "record/topics.hpp"
#include "trial/draft_text.hpp"
#include "trial/from_scripts.hpp"

namespace vagus::trial {

namespace {

// What the trace says, of the outermost plan.
struct Told {
    struct Came {
        std::string actor;
        double at = 0;
    };
    std::vector<Came> came;  // for the first time
    std::string ends, by;
    double end = 0;

    void line(const JsonValue& json) {
        if (text_in(json, "plan").find('/') != std::string::npos) return;
        const JsonValue* const t = json.find("t");
        if (t != nullptr) end = t->number;
        const std::string kind = text_in(json, "kind");
        if (kind == "actor-start") {
            const std::string actor = text_in(json, "actor");
            if (std::ranges::find(came, actor, &Came::actor) == came.end()) {
                came.push_back({actor, end});
            }
        } else if (kind == "event" && text_in(json, "target") == "@terminate") {
            by = text_in(json, "supervisor");
        } else if (kind == "plan-end") {
            ends = text_in(json, "result");
        }
    }
};

struct Recorded {
    record::RunFile run;
    Told told;
    std::string seed;  // of the run, or of its world
    size_t inputs = 0;
    std::map<std::string, std::string> set;  // by a person, in the outermost plan; its last values

    void input(const Result<record::Input>& input) {
        ++inputs;
        if (!input.ok()) return;  // of another version of Vagus; it counts all the same
        const auto* const request = std::get_if<run::Request>(&input.value().what);
        const auto* const order =
            request == nullptr ? nullptr : std::get_if<run::SetVariable>(request);
        if (order == nullptr || order->level != 0) return;
        const auto value = plan::text_of(order->value);
        if (value.ok()) set[order->name] = value.value();
    }
    // What its variables began with, and NAME=VALUE of a person in place of that.
    std::vector<std::string> words(bool by_hand) const {
        std::vector<std::string> words = run.set;
        if (!by_hand) return words;
        std::erase_if(words, [this](const std::string& word) {
            return set.contains(word.substr(0, word.find('=')));
        });
        for (const auto& [name, value] : set) words.push_back(name + "=" + value);
        return words;
    }
};

Result<Recorded> read_recorded(const mcap::Reader& reader) {
    Recorded recorded;
    std::string run;
    const auto id_of = [&reader](std::string_view topic) {
        const mcap::Channel* const channel = reader.find(topic);
        return channel == nullptr ? -1 : int{channel->id};
    };
    const int run_id = id_of(record::kRunTopic);
    const int trace_id = id_of(record::kTraceTopic);
    const int input_id = id_of(record::kInputTopic);
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        if (message->channel == run_id) run = message->data;
        if (message->channel == input_id) {
            recorded.input(record::read_input(message->data, Time{}, reader.name()));
        }
        if (message->channel != trace_id) continue;
        const auto json = read_json(message->data);
        if (const auto* tree = std::get_if<JsonValue>(&json)) recorded.told.line(*tree);
    }
    TRY(record::check_read(cursor, reader));
    recorded.run = TRY(record::read_run(run, reader.name()));
    recorded.seed = seed_of(reader, recorded.run);
    return recorded;
}

std::string quoted_list(const std::vector<Told::Came>& came) {
    std::string text;
    for (const Told::Came& one : came) text += (text.empty() ? "" : ", ") + json_quote(one.actor);
    return text;
}

// `NAME=VALUE`: as a number where it is one.
std::string set_member(const std::string& word) {
    const size_t equals = word.find('=');
    const std::string value = word.substr(equals + 1);
    const bool plain = value == "true" || value == "false" ||
                       (plan::float_from_text(value).ok() && !value.starts_with('+'));
    return json_quote(word.substr(0, equals)) + ": " + (plain ? value : json_quote(value));
}

std::vector<std::string> expectations(const Told& told, bool timed_out, bool untouched) {
    std::vector<std::string> lines;
    if (!told.came.empty()) {
        const Told::Came& last = told.came.back();
        lines.push_back(fmt::format("{{ \"order\": [{}] }}", quoted_list(told.came)));
        lines.push_back(fmt::format("{{ \"within\": {}, \"eventually\": {} }}",
                                    number(round_up(std::max(last.at, 0.1))),
                                    json_quote("actor == '" + last.actor + "'")));
    }
    if (untouched) {
        lines.emplace_back(kUntouched);
    }
    if (timed_out) {
        lines.emplace_back(kTimeWasOver);
    } else {
        lines.push_back(fmt::format("{{ \"ends\": {}{} }}", json_quote(told.ends),
                                    told.by.empty() || told.ends != "Interrupted"
                                        ? ""
                                        : ", \"by\": " + json_quote(told.by)));
    }
    return lines;
}

// The keys of the test, a line each.
std::vector<std::string> members_of(const Recorded& recorded, const Draft& draft, bool timed_out,
                                    const DraftOptions& options, const std::string& name) {
    const record::RunFile& run = recorded.run;
    const bool untouched = options.untouched && !draft.world.empty();
    std::vector<std::string> members = first_members(name);
    members.push_back("\"plan\": " + json_quote(draft.plan));
    if (!draft.world.empty()) members.push_back("\"world\": " + json_quote(draft.world));
    if (!run.robot.empty()) members.push_back("\"robot\": " + json_quote(run.robot));
    std::string set;
    add_files(members, "toolboxes", run.plan, run.toolboxes);
    for (const std::string& one : recorded.words(options.set)) {
        set += (set.empty() ? "" : ", ") + set_member(one);
    }
    if (!set.empty()) members.push_back("\"set\": { " + set + " }");
    members.push_back(seeds_member(recorded.seed));
    const double end = recorded.told.end;
    members.push_back("\"max_time\": " + number(timed_out ? end : round_up(end)));
    members.push_back(expect_member(expectations(recorded.told, timed_out, untouched)));
    return members;
}

}  // namespace

Result<Draft> draft_test(const mcap::Reader& reader, const DraftOptions& options) {
    const Recorded recorded = TRY(read_recorded(reader));
    const Told& told = recorded.told;
    TRY(record::check_no_fleet(recorded.run, reader.name(),
                               "; a test is of one robot, with a plan or without: record that with "
                               "`vagus plan run … --record FILE` or `vagus sim … --record FILE`"));
    if (recorded.run.is_of_bus()) {
        return Error{Code::Refused, reader.name() +
                                        ": is a recording of a real bus, and a test runs in a "
                                        "world: record the plan with `vagus plan run … --world "
                                        "WORLD --record FILE`, or scripts with `vagus sim WORLD "
                                        "--record FILE`"};
    }
    if (recorded.run.plan.empty()) return draft_script_test(reader, options);
    // It goes on, or its time or a person ended it: a test of what was until then.
    const bool timed_out = told.ends.empty() || (told.ends == "Interrupted" && told.by.empty());
    if (told.came.empty()) {
        return Error{Code::Refused, reader.name() +
                                        ": no actor of the plan had begun when the recording "
                                        "ended; let it run for longer"};
    }
    Draft draft{.plan = last_part(recorded.run.plan),
                .world = beside(recorded.run.plan, recorded.run.world),
                .was_set = !recorded.set.empty()};
    draft.text = test_text(members_of(recorded, draft, timed_out, options, reader.name()));
    draft.hints = hints_of(recorded.run, recorded.inputs);
    return draft;
}

}  // namespace vagus::trial
