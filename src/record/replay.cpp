#include "record/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/file.hpp"
#include "base/json.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/plan_versions.hpp"
#include "embed/prepared_run.hpp"
#include "embed/robots_run.hpp"
#include "record/plan_recording.hpp"
#include "record/sim_recording.hpp"
#include "run/debugger.hpp"
#include "session/plan_world.hpp"
#include "session/toolboxes.hpp"

namespace vagus::record {

namespace {

std::string last_part(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

std::string names_of_files(const mcap::Reader& reader) {
    std::vector<std::string_view> names;
    for (const mcap::Attachment& one : reader.attachments()) names.emplace_back(one.name);
    return list_of(names);
}

std::optional<sim::Act::Kind> kind_of(std::string_view name) {
    using Kind = sim::Act::Kind;
    static const std::map<std::string_view, Kind> kKinds = {
        {"press", Kind::Press},          {"release", Kind::Release}, {"tap", Kind::Tap},
        {"move-robot", Kind::MoveRobot}, {"move", Kind::Move},       {"remove", Kind::Remove},
        {"light", Kind::Light}};
    const auto found = kKinds.find(name);
    return found == kKinds.end() ? std::nullopt : std::optional(found->second);
}

double number_of(const JsonValue& from, std::string_view key) {
    const JsonValue* const value = from.find(key);
    return value != nullptr && value->is_number() ? value->number : 0;
}

std::string string_of(const JsonValue& from, std::string_view key) {
    const JsonValue* const value = from.find(key);
    return value != nullptr ? value->text : "";
}

sim::Act act_of(const JsonValue& from, sim::Act::Kind kind) {
    sim::Act act;
    act.kind = kind;
    act.robot.number = static_cast<uint32_t>(number_of(from, "robot"));
    act.object.number = static_cast<uint32_t>(number_of(from, "object"));
    act.button = string_of(from, "button");
    act.to = {{number_of(from, "x"), number_of(from, "y")}, number_of(from, "angle")};
    const JsonValue* const on = from.find("on");
    act.on = on != nullptr && on->boolean;
    return act;
}

std::string set_input(Time at, const std::string& text) {
    return fmt::format(R"({{"t":{},"do":"set","value":{}}})", seconds_text(at), json_quote(text));
}

std::string load_input(Time at, const std::string& file, const std::string& content) {
    return fmt::format(R"({{"t":{},"do":"load","file":{},"value":{}}})", seconds_text(at),
                       json_quote(file), json_quote(content));
}

// The first one that is not earlier.
Time instant_of(Time at) {
    return (at + sim::kNodeStep - Duration(1)) / sim::kNodeStep * sim::kNodeStep;
}

Result<RunFile> run_file_of(const mcap::Reader& reader) {
    const mcap::Channel* const channel = reader.find(kRunTopic);
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        if (channel != nullptr && message->channel == channel->id) {
            return read_run(message->data, reader.name());
        }
    }
    return read_run("", reader.name());
}

}  // namespace

Result<std::pair<std::string, std::string>> named_file(const mcap::Reader& reader,
                                                       const std::string& typed) {
    const size_t equals = typed.find('=');
    const std::string path = equals == std::string::npos ? typed : typed.substr(equals + 1);
    std::vector<std::string> found;
    for (const mcap::Attachment& one : reader.attachments()) {
        const bool meant = equals == std::string::npos ? last_part(one.name) == last_part(path)
                                                       : one.name == typed.substr(0, equals);
        if (meant) found.push_back(one.name);
    }
    if (found.size() == 1) return std::pair(found.front(), path);
    return Error{
        Code::NotFound,
        fmt::format("--with {}: {} of the recording {}; its files are {}; name one, as "
                    "--with NAME=FILE",
                    typed, found.empty() ? "no file" : "more than one file",
                    found.empty() ? "is called so" : "are called so", names_of_files(reader))};
}

Time end_of(const mcap::Reader& reader) {
    Time end{};
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) end = std::max(end, time_of(message->log_time));
    return end;
}

// ---- what is done again ----

Result<std::vector<Rerun::Input>> Rerun::inputs_of(const mcap::Reader& reader) {
    std::vector<Input> inputs;
    const mcap::Channel* const channel = reader.find(kInputTopic);
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        if (channel == nullptr || message->channel != channel->id) continue;
        const auto json = read_json(message->data);
        const auto* const tree = std::get_if<JsonValue>(&json);
        Input input{.at = time_of(message->log_time), .what = {}, .text = {}};
        input.text = message->data;
        if (tree != nullptr) input.what = string_of(*tree, "do");
        if (const auto kind = kind_of(input.what)) input.act = act_of(*tree, *kind);
        if (tree != nullptr) input.by = string_of(*tree, "by");
        if (tree != nullptr) input.file = string_of(*tree, "file");
        if (tree != nullptr) input.value = string_of(*tree, "value");
        static const std::set<std::string_view> kOthers = {"abort", "end", "set", "load"};
        if (!input.act && !kOthers.contains(input.what)) {
            return Error{Code::BadInput,
                         fmt::format("{}: the input at {} s cannot be done again: expected one "
                                     "that this version of Vagus knows, found {}",
                                     reader.name(), seconds_text(input.at), input.text)};
        }
        inputs.push_back(std::move(input));
    }
    return inputs;
}

std::vector<Rerun::Input> Rerun::other_inputs(std::vector<Input> recorded,
                                              const RerunOptions& options) {
    const Time from = instant_of(*options.from);
    std::vector<Input> inputs;
    std::vector<Input> ends;
    for (Input& one : recorded) {
        if (one.what == "end") {
            ends.push_back(std::move(one));  // so long the run was to take
        } else if (one.at <= from) {
            inputs.push_back(std::move(one));
        }
    }
    for (const std::string& text : options.set) {
        inputs.push_back({.at = from, .what = "set", .text = set_input(from, text), .value = text});
    }
    for (const auto& [name, content] : options.with) {
        inputs.push_back({.at = from,
                          .what = "load",
                          .text = load_input(from, name, content),
                          .file = name,
                          .value = content});
    }
    for (Input& one : ends) inputs.push_back(std::move(one));
    return inputs;
}

Status Rerun::check_inputs() {
    for (const Input& one : inputs_) {
        if (one.what == "set" || one.what == "load") TRY(change(one, Only::Ask));
    }
    return Status::done();
}

// Of a world: a script that it has loaded.
Status Rerun::change(const Input& input, Only only) {
    if (input.what == "set") {
        return Error{Code::Refused, fmt::format("--set {}: the run has no plan whose variables "
                                                "could be set",
                                                input.value)};
    }
    const std::string path = path_of(input.file);
    const std::vector<std::string> scripts =
        session() != nullptr ? session()->script_paths() : std::vector<std::string>();
    if (std::find(scripts.begin(), scripts.end(), path) == scripts.end()) {
        return Error{Code::Refused,
                     fmt::format("{} cannot change while the run goes on: expected a script of "
                                 "its nodes, or a file of its plan; without --from the whole run "
                                 "has the other file",
                                 input.file)};
    }
    if (only == Only::Ask) return Status::done();
    session()->reload(path, input.value);
    std::vector<std::string> lines;
    for (const Diagnostic& one : session()->mistakes()) {
        lines.push_back(report_of(one));
        if (lines.back().ends_with('\n')) lines.back().pop_back();
    }
    if (lines.empty()) return Status::done();
    return Error{Code::BadInput, joined_lines(lines)};
}

bool Rerun::after_instant(Time at, Recorder& recorder, session::SimSession& session) {
    for (const auto& look : looks_) look(at);
    for (; next_input_ < inputs_.size() && inputs_[next_input_].at <= at; ++next_input_) {
        const Input& input = inputs_[next_input_];
        if (input.act && told_of_act_) told_of_act_(*input.act);
        if (input.act) (void)session.world().act(*input.act).ok();  // it worked then
        if (input.what == "set" || input.what == "load") {
            recorder.input(at, input.text);
            if (changed_.ok()) changed_ = change(input, Only::Do);
        }
        if (!changed_.ok()) return true;
        if (input.what != "abort") continue;
        ended_by_ = input.by;
        recorder.input(at, input.text);
        return true;
    }
    const bool until = until_ && at >= *until_;
    // An end as any, of a run that can be run again.
    if (until && another_way_) recorder.input(at, end_of_run(at));
    return stopped_ || until;
}

std::string Rerun::name_of(const std::string& path) const {
    const std::string root = folder_.path_of(".");
    const auto relative = std::filesystem::path(path).lexically_relative(
        std::filesystem::path(root).lexically_normal());
    const std::string name = relative.generic_string();
    return name.empty() || name.starts_with("..") ? path : name;
}

// ---- a plan, alone or beside a world ----

class PlanRerun final : public Rerun {
public:
    PlanRerun(RunFile about, UnpackedFolder folder) : Rerun(std::move(about), std::move(folder)) {}

    Status prepare() {
        embed::RunWords words;
        for (const std::string& one : about_.toolboxes) {
            words.toolboxes.push_back(folder_.path_of(one));
        }
        words.world = folder_.path_of(about_.world);
        words.set = about_.set;
        words.from = about_.from;
        words.seed = about_.seed;
        words.max_time = about_.max_time;
        words.robot = about_.robot;
        words.poses = about_.poses;
        if (!about_.answers.empty()) words.answers = folder_.path_of(about_.answers);
        words.clock = "virtual";
        TRY(session::add_toolboxes(library_, parts_, words.toolboxes));
        plan_ = embed::LoadedPlan::from_file(folder_.path_of(about_.plan), library_);
        if (!plan_->ok()) {
            return Error{Code::BadInput, embed::format_findings(plan_->findings())};
        }
        prepared_ = TRY(embed::PreparedRun::prepare(*plan_, words, parts_));
        prepared_->tell([](const std::string&) {});
        versions_.emplace(*plan_, folder_.path_of(about_.plan));
        return check_inputs();
    }

    Result<Ended> run(Tape& tape) override {
        Recorder recorder(tape, format_run(about_));
        attach(recorder, *prepared_);
        recorder.after_instant([this, &recorder](Time at) {
            if (over_) return;
            hear_debugger();
            if (!after_instant(at, recorder, *session())) return;
            over_ = true;
            prepared_->abort(ended_by_.empty() ? "the replay" : ended_by_);
            (void)prepared_->take_abort();
        });
        Time last{};
        prepared_->listen([&last](const plan::TraceEvent& event) { last = event.at; });
        const run::Ended ended = TRY(prepared_->run(debugger_ ? &*debugger_ : nullptr));
        hear_debugger();
        TRY(changed_);
        if ((!until_ || another_way_) && !stopped_) recorder.end(last);
        return Ended{last, std::string(plan::name_of(ended.result)), ended.message};
    }

    void listen(std::function<void(const plan::TraceEvent&)> listener) override {
        prepared_->listen(std::move(listener));
    }
    session::SimSession* session() override {
        return prepared_->world() != nullptr ? &prepared_->world()->session() : nullptr;
    }
    session::PlanWorld* plan_world() override { return prepared_->world(); }
    const embed::LoadedPlan* plan() const override { return &*plan_; }

private:
    std::string end_of_run(Time at) const override { return abort_input(at, "the replay"); }

    Status change(const Input& input, Only only) override {
        if (prepared_->world() == nullptr) {
            return Error{Code::Refused,
                         "a plan alone cannot go another way from an instant on; change it for "
                         "the whole run, without --from"};
        }
        if (input.what == "set") {
            const auto [slot, value] =
                TRY(embed::parse_set(plan_->graph().plans.front(), input.value));
            if (only == Only::Do) prepared_->set(slot, value);
            return Status::done();
        }
        if (!versions_->is_part(path_of(input.file))) return Rerun::change(input, only);
        embed::PlanVersions::Made made = versions_->with({{path_of(input.file), input.value}});
        if (!made.plan.ok()) {
            return Error{Code::BadInput, joined_lines(embed::errors_of(made.plan))};
        }
        if (!debugger_) debugger_.emplace(plan_->graph(), run::Debugger::At::Run);
        if (only == Only::Ask) return Status::done();
        versions_->hand_in(made);
        asked_.push_back(made.plan);
        (void)TRY(debugger_->post(run::TakeVersion{made.next}));
        return Status::done();
    }

    // What the run says to new versions of its plan.
    void hear_debugger() {
        while (debugger_ && !asked_.empty()) {
            const std::optional<run::Report> report = debugger_->wait_report(Duration{});
            if (!report) return;
            const auto* const answer = std::get_if<run::Answer>(&*report);
            if (answer == nullptr) continue;
            const embed::LoadedPlan asked = asked_.front();
            asked_.erase(asked_.begin());
            const std::vector<std::string> reasons =
                answer->reply.ok() ? std::get<run::Change>(answer->reply.value()).reasons
                                   : std::vector{answer->reply.error().what};
            if (reasons.empty()) {
                versions_->took(asked.graph());
            } else if (changed_.ok()) {
                changed_ = Error{Code::Refused, joined_lines(reasons)};
            }
        }
    }

    toolbox::Parts parts_;  // before the library, whose code looks at them
    run::CodeLibrary library_;
    std::optional<embed::LoadedPlan> plan_;
    std::unique_ptr<embed::PreparedRun> prepared_;
    std::optional<embed::PlanVersions> versions_;
    std::optional<run::Debugger> debugger_;  // only where versions of the plan take over
    std::vector<embed::LoadedPlan> asked_;   // not answered yet
    bool over_ = false;
};

// ---- a world with its scripts ----

class WorldRerun final : public Rerun {
public:
    WorldRerun(RunFile about, UnpackedFolder folder) : Rerun(std::move(about), std::move(folder)) {}

    Status prepare() {
        embed::RobotsOptions options{.world = folder_.path_of(about_.world)};
        if (!about_.seed.empty()) options.sim.world.seed = TRY(embed::parse_seed(about_.seed));
        robots_ = TRY(embed::RobotsRun::open(options));
        for (const std::string& one : about_.loads) {
            const std::string path = folder_.path_of(one);
            const std::string text = TRY(read_file(path));
            robots_->buses().common().load(path, text);
        }
        return check_inputs();
    }

    Result<Ended> run(Tape& tape) override {
        Recorder recorder(tape, format_run(about_));
        recorder.follow(*session());
        bool over = false;
        recorder.after_instant(
            [&](Time at) { over = over || after_instant(at, recorder, *session()); });
        const Time end = inputs_.empty() ? Time{} : inputs_.back().at;
        while (!over && session()->now() < end) session()->step(sim::kNodeStep);
        TRY(changed_);
        const bool whole = !until_ && !stopped_ && !inputs_.empty();
        if (whole) recorder.input(inputs_.back().at, inputs_.back().text);
        if (whole || (another_way_ && !stopped_)) recorder.end(session()->now());
        return Ended{session()->now(), "", ""};
    }

    void listen(std::function<void(const plan::TraceEvent&)>) override {}
    session::SimSession* session() override { return &robots_->buses().common(); }
    session::PlanWorld* plan_world() override { return nullptr; }
    const embed::LoadedPlan* plan() const override { return nullptr; }

private:
    std::string end_of_run(Time at) const override { return end_input(at); }

    std::unique_ptr<embed::RobotsRun> robots_;
};

Result<std::unique_ptr<Rerun>> Rerun::open(const mcap::Reader& reader,
                                           const RerunOptions& options) {
    RunFile run = TRY(run_file_of(reader));
    if (run.kind != "simulated") {
        return Error{Code::Refused, reader.name() +
                                        ": is a recording of a real bus, whose robot "
                                        "cannot be run again"};
    }
    UnpackedFolder folder = TRY(UnpackedFolder::make());
    for (const mcap::Attachment& one : reader.attachments()) {
        const auto instead = options.with.find(one.name);
        const bool as_it_was = instead == options.with.end() || options.from;
        TRY(folder.add(one.name, as_it_was ? one.data : std::string_view(instead->second)));
    }
    std::vector<Input> inputs = TRY(inputs_of(reader));
    if (options.from && *options.from > end_of(reader)) {
        return Error{Code::BadInput,
                     fmt::format("--from {}: {} ends at {} s", seconds_text(*options.from),
                                 reader.name(), seconds_text(end_of(reader)))};
    }
    if (options.from) inputs = other_inputs(std::move(inputs), options);
    const auto finish = [&](auto made) -> Result<std::unique_ptr<Rerun>> {
        made->inputs_ = std::move(inputs);
        made->until_ = options.until;
        made->another_way_ = options.from.has_value();
        TRY(made->prepare());
        return std::unique_ptr<Rerun>(std::move(made));
    };
    if (run.verb == "sim") {
        return finish(std::make_unique<WorldRerun>(std::move(run), std::move(folder)));
    }
    return finish(std::make_unique<PlanRerun>(std::move(run), std::move(folder)));
}

}  // namespace vagus::record
