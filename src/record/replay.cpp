#include "record/replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/file.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/plan_versions.hpp"
#include "embed/prepared_run.hpp"
#include "record/bus_rerun.hpp"
#include "record/damage.hpp"
#include "record/past_run.hpp"
#include "record/plan_recording.hpp"
#include "record/world_rerun.hpp"
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

}  // namespace

Time instant_of(Time at) {
    return (at + sim::kNodeStep - Duration(1)) / sim::kNodeStep * sim::kNodeStep;
}

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

// ---- what is done again ----

std::vector<Input> Rerun::other_inputs(std::vector<Input> recorded, const RerunOptions& options) {
    const Time from = instant_of(*options.from);
    std::vector<Input> inputs;
    std::vector<Input> later;
    for (Input& one : recorded) {
        const bool ends = std::holds_alternative<RecordingEnds>(one.what);
        if (!ends && one.at <= from) {
            inputs.push_back(std::move(one));
        } else if (ends || (options.reseed && !std::holds_alternative<Reseeded>(one.what))) {
            later.push_back(std::move(one));  // an end: so long the run was to take
        }
    }
    if (options.reseed) inputs.push_back({.at = from, .what = Reseeded{*options.reseed}});
    for (const std::string& text : options.set) {
        inputs.push_back({.at = from, .what = ValueGiven{text}});
    }
    for (const auto& [name, content] : options.with) {
        inputs.push_back({.at = from, .what = FileTookOver{name, content}});
    }
    for (Input& one : later) inputs.push_back(std::move(one));
    return inputs;
}

Status Rerun::check_inputs() {
    for (const Input& one : inputs_) {
        if (const auto* const given = std::get_if<ValueGiven>(&one.what)) {
            TRY(change(*given, Only::Ask));
        } else if (const auto* const other = std::get_if<FileTookOver>(&one.what)) {
            TRY(change(*other, Only::Ask));
        } else if (const auto* const drawn = std::get_if<Reseeded>(&one.what)) {
            TRY(change(*drawn, Only::Ask));
        }
    }
    return Status::done();
}

Status Rerun::change(const ValueGiven& given, Only) {
    return Error{Code::Refused, fmt::format("--set {}: the run has no plan whose variables could "
                                            "be set",
                                            given.text)};
}

Status Rerun::change(const Reseeded& drawn, Only only) {
    if (only == Only::Do) session()->world().reseed(drawn.seed);
    return Status::done();
}

// Of a world: a script that it has loaded.
Status Rerun::change(const FileTookOver& other, Only only) {
    const std::string path = path_of(other.file);
    const std::vector<std::string> scripts =
        session() != nullptr ? session()->script_paths() : std::vector<std::string>();
    if (std::find(scripts.begin(), scripts.end(), path) == scripts.end()) {
        return Error{Code::Refused,
                     fmt::format("{} cannot change while the run goes on: expected a script of "
                                 "its nodes, or a file of its plan; without --from the whole run "
                                 "has the other file",
                                 other.file)};
    }
    if (only == Only::Ask) return Status::done();
    session()->reload(path, other.text);
    std::vector<std::string> lines;
    for (const Diagnostic& one : session()->mistakes()) {
        lines.push_back(report_of(one));
        if (lines.back().ends_with('\n')) lines.back().pop_back();
    }
    if (lines.empty()) return Status::done();
    return Error{Code::BadInput, joined_lines(lines)};
}

Status Rerun::continue_from(Time from, uint64_t seed, Time until) {
    RerunOptions options;
    options.from = from;
    options.reseed = seed;
    inputs_ = other_inputs(std::move(inputs_), options);
    until_ = until;
    another_way_ = true;
    cut_ = false;
    return check_inputs();
}

void Rerun::draw_from(uint64_t seed) {
    for (size_t i = next_input_; i < inputs_.size(); ++i) {
        if (auto* const drawn = std::get_if<Reseeded>(&inputs_[i].what)) drawn->seed = seed;
    }
}

Rerun::Then Rerun::after_instant(Time at, Recorder& recorder) {
    for (const auto& look : looks_) look(at);
    const bool ended_here = is_due() && std::holds_alternative<Aborted>(inputs_[next_input_].what);
    if (!comes_between_instants() || ended_here) {
        const Then then = do_inputs(recorder, Ends::Take);
        if (then != Then::GoOn) return then;
    }
    // Nobody knows what came behind its last whole chunk.
    const bool cut = cut_ && !is_of_studio() && at >= end_;
    const bool until = (until_ && at >= *until_) || cut;
    // An end as any, of a run that can be run again.
    if (until && another_way_) recorder.input(end_of_run());
    return stopped_ || until ? Then::End : Then::GoOn;
}

bool Rerun::is_due() {
    return next_input_ < inputs_.size() && inputs_[next_input_].at <= session()->now();
}

Rerun::Then Rerun::do_inputs(Recorder& recorder, Ends ends) {
    while (is_due()) {
        const bool aborts = std::holds_alternative<Aborted>(inputs_[next_input_].what);
        if (aborts && ends == Ends::Leave) return Then::GoOn;
        const Then then = do_again(inputs_[next_input_++], recorder);
        if (then != Then::GoOn) return then;
    }
    return Then::GoOn;
}

Rerun::Then Rerun::do_turn(Recorder& recorder) {
    const uint32_t turn = inputs_[next_input_].turn;
    while (is_due() && inputs_[next_input_].turn == turn) {
        const Then then = do_again(inputs_[next_input_++], recorder);
        if (then != Then::GoOn) return then;
    }
    return Then::GoOn;
}

std::string Rerun::check_by(const Recorder& recorder, Time at) const {
    std::string text = recorder.check_text(at);
    const std::string more = check_of_robots(at);
    if (!more.empty()) text.insert(text.size() - 1, "," + more);
    return text;
}

bool Rerun::ends_whole() const {
    if (next_input_ == 0) return false;
    const auto* const end = std::get_if<RecordingEnds>(&inputs_[next_input_ - 1].what);
    return end != nullptr && end->why.empty();
}

template <typename Change>
Rerun::Then Rerun::go_another_way(const Change& changed, Recorder& recorder) {
    recorder.input(changed);
    if (changed_.ok()) changed_ = change(changed, Only::Do);
    return changed_.ok() ? Then::GoOn : Then::End;
}

// Acts, frames and looks ahead are recorded where they come in.
Rerun::Then Rerun::do_again(const Input& input, Recorder& recorder) {
    recorder.set_turn(input.turn);
    sim::World& world = session()->world();
    if (const auto* const act = std::get_if<sim::Act>(&input.what)) {
        if (told_of_act_) told_of_act_(*act);
        (void)world.act(*act).ok();  // it worked then
    } else if (const auto* const frame = std::get_if<wire::Frame>(&input.what)) {
        if (outside_.number == 0) {
            const auto link = world.bus().add({.name = "outside"});
            if (!link.ok()) return Then::GoOn;
            outside_ = link.value();
        }
        world.bus().receive(outside_, *frame);
    } else if (std::holds_alternative<HeldMoment>(input.what)) {
        recorder.hold();
    } else if (std::holds_alternative<HeardAhead>(input.what)) {
        session()->hear_ahead();
    } else if (const auto* const script = std::get_if<ScriptLoaded>(&input.what)) {
        recorder.script(*script, path_of(script->file));
    } else if (const auto* const given = std::get_if<ValueGiven>(&input.what)) {
        return go_another_way(*given, recorder);
    } else if (const auto* const other = std::get_if<FileTookOver>(&input.what)) {
        return go_another_way(*other, recorder);
    } else if (const auto* const drawn = std::get_if<Reseeded>(&input.what)) {
        return go_another_way(*drawn, recorder);
    } else {
        recorder.input(input.what);
    }
    if (const auto* const request = std::get_if<run::Request>(&input.what)) ask(*request);
    if (const auto* const files = std::get_if<PlanFiles>(&input.what)) {
        for (const auto& [name, text] : files->texts) (void)folder_.add(name, text).ok();
        take(*files);
    }
    if (std::holds_alternative<RecordingEnds>(input.what)) return Then::Recorded;
    const auto* const aborted = std::get_if<Aborted>(&input.what);
    if (aborted != nullptr) ended_by_ = aborted->by;
    return aborted != nullptr ? Then::Aborted : Then::GoOn;
}

std::string Rerun::name_of(const std::string& path) const {
    const std::string root = folder_.path_of(".");
    const auto relative = std::filesystem::path(path).lexically_normal().lexically_relative(
        std::filesystem::path(root).lexically_normal());
    const std::string name = relative.generic_string();
    return name.empty() || name.starts_with("..") ? path : name;
}

// Lets through what is said until the recording ends.
class EndingTape final : public Tape {
public:
    explicit EndingTape(Tape& to) : to_(to) {}
    uint16_t declare(const Topic& topic) override { return to_.declare(topic); }
    void put(uint16_t topic, Time at, std::string_view data) override {
        if (!over_) to_.put(topic, at, data);
    }
    void put_later(uint16_t topic, Time at, size_t about_bytes, Word word) override {
        if (!over_) to_.put_later(topic, at, about_bytes, std::move(word));
    }
    void end() { over_ = true; }

private:
    Tape& to_;
    bool over_ = false;
};

// ---- a plan, alone or beside a world ----

class PlanRerun final : public Rerun {
public:
    PlanRerun(RunFile about, UnpackedFolder folder) : Rerun(std::move(about), std::move(folder)) {}

    Status prepare() override {
        embed::RunWords words;
        for (const std::string& one : about_.toolboxes) {
            words.toolboxes.push_back(folder_.path_of(one));
        }
        words.world = folder_.path_of(about_.world);
        words.set = about_.set;
        words.from = about_.from;
        words.seed = about_.seed;
        words.max_time = about_.max_time;
        // Alone it has no instants at whose end it could be ended.
        const bool is_later =
            words.max_time.empty() ||
            TRY(embed::parse_max_time(words.max_time)).value_or(Time::max()) > until_;
        if (about_.world.empty() && until_ && is_later) {
            words.max_time = seconds_text(*until_ + Duration(1));
        }
        words.robot = about_.robot;
        words.poses = about_.poses;
        words.chaos = about_.chaos;
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
        EndingTape ending(tape);
        Recorder recorder(ending, format_run(about_));
        attach(recorder, *prepared_);
        recorder_ = &recorder;
        tape_ = &ending;
        recorder.after_instant([this, &recorder](Time at) {
            hear_debugger();
            if (!over_) obey(after_instant(at, recorder));
        });
        Time last{};
        prepared_->listen([&last](const plan::TraceEvent& event) { last = event.at; });
        if (is_of_studio() && session() != nullptr) begin_as_in_studio();
        if (about_.verb == kDebugVerb) begin_as_debugged(recorder);
        const run::Ended ended = TRY(prepared_->run(debugger_ ? &*debugger_ : nullptr));
        if (debugger_) debugger_->follow({});
        hear_debugger();
        TRY(changed_);
        plan_over_ = true;
        if (is_of_studio() && session() != nullptr) {
            last = live_on();
        } else if ((!until_ || another_way_) && !stopped_) {
            recorder.end(last);
        }
        leave(recorder, last);
        return Ended{last, std::string(plan::name_of(ended.result)), ended.message};
    }

    void listen(std::function<void(const plan::TraceEvent&)> listener) override {
        prepared_->listen(std::move(listener));
    }
    void pass_over(std::function<bool(const run::Raising&)> passes) override {
        prepared_->pass_over(std::move(passes));
    }
    session::SimSession* session() override {
        return prepared_->world() != nullptr ? &prepared_->world()->session() : nullptr;
    }
    session::PlanWorld* plan_world() override { return prepared_->world(); }
    const embed::LoadedPlan* plan() const override { return &*plan_; }

private:
    InputWhat end_of_run() const override {
        if (is_of_studio()) return RecordingEnds{};
        return Aborted{"the replay"};
    }

    // Its debugger is there, and what came before the run began is asked before it begins.
    void begin_as_in_studio() {
        if (!debugger_) debugger_.emplace(plan_->graph(), run::Debugger::At::Run);
        debugger_->while_paused([this] { while_paused(); });
        prepared_->pace([this](Time) { between_instants(); });
        session()->world().stops_with_nodes();
        if (is_due() && inputs_[next_input_].turn == 0) obey(do_turn(*recorder_));
    }

    // What was asked of its debugger is asked again at the same places of the run.
    void begin_as_debugged(Recorder& recorder) {
        std::vector<Input> others;
        for (Input& one : inputs_) {
            const bool is_asked = std::holds_alternative<run::Request>(one.what) ||
                                  std::holds_alternative<HeardAhead>(one.what);
            (is_asked ? asks_ : others).push_back(std::move(one));
        }
        inputs_ = std::move(others);
        debugger_.emplace(plan_->graph(), run::Debugger::At::Start);
        debugger_->while_paused([this] { let_debugged_go_on(); });
        debugger_->follow({.comes =
                               [this, &recorder](uint64_t place, Time now) {
                                   recorder.set_turn(static_cast<uint32_t>(place));
                                   ask_at(place, now, recorder);
                               },
                           .asked = {}});
    }

    void ask_at(uint64_t place, Time now, Recorder& recorder) {
        asked_until_ = now;
        while (next_ask_ < asks_.size() && asks_[next_ask_].turn <= place) {
            const Input& one = asks_[next_ask_++];
            if (std::holds_alternative<HeardAhead>(one.what)) {
                if (session() != nullptr) session()->hear_ahead();
            } else {
                recorder.input_at(now, one.what);
                ask(std::get<run::Request>(one.what));
            }
        }
    }

    // Nobody asks any more: nothing is known from here on. What is another run by now goes on.
    void let_debugged_go_on() {
        if (another_way_ || next_ask_ < asks_.size()) {
            recorder_->input_at(asked_until_, run::Request(run::Continue{}));
            return post(run::Continue{});
        }
        end_paused();
        post(run::Abort{});
    }

    // The world lives on when its plan is over.
    Time live_on() {
        between_instants();
        while (!over_ && session()->now() < end_) {
            session()->step(sim::kNodeStep);
            between_instants();
        }
        return session()->now();
    }

    void between_instants() {
        hear_debugger();
        if (!over_) obey(do_inputs(*recorder_, Ends::Leave));
        const bool is_cut = cut_ && !is_due() && session()->now() >= end_;
        if (!over_ && is_cut) obey(Then::End);
    }

    void end_paused() {
        if (paused_end_) paused_end_();
        tape_->end();
        over_ = true;
    }

    // What was not done to the paused plan lets it go on.
    void while_paused() {
        hear_debugger();
        if (!over_ && next_input_ >= inputs_.size()) end_paused();
        if (over_) return post(run::Abort{});
        if (!is_due()) return post(run::Continue{});
        obey(do_turn(*recorder_));
    }

    void obey(Then then) {
        if (then == Then::GoOn || (then == Then::Aborted && plan_over_)) return;
        if (then == Then::Recorded && is_of_studio()) {
            if (ends_whole()) recorder_->end(session()->now());
            tape_->end();
        }
        // The world of the studio lives on.
        over_ = then != Then::Aborted || !is_of_studio();
        prepared_->abort(ended_by_.value_or("the replay"));
        (void)prepared_->take_abort();
    }

    void post(run::Request request) { (void)debugger_->post(std::move(request)).ok(); }

    void ask(const run::Request& request) override {
        if (!debugger_) return;
        if (std::holds_alternative<run::Abort>(request)) ended_by_ = "";
        run::Request asked = request;
        if (auto* const stop = std::get_if<run::AddBreakpoint>(&asked)) {
            std::string& plan = stop->breakpoint.plan;
            if (is_of_studio() ? !plan.empty() : has_file(plan)) plan = path_of(plan);
        }
        post(std::move(asked));
    }

    bool has_file(const std::string& name) const {
        return std::ranges::any_of(plan_->plans(), [this, &name](const plan::Plan& one) {
            return name_of(one.file) == name;
        });
    }

    void take(const PlanFiles& files) override {
        if (!debugger_) return;
        std::vector<std::string> saved;
        for (const std::string& name : files.saved) saved.push_back(path_of(name));
        const embed::PlanVersions::Made made = versions_->read(saved);
        if (made.plan.ok()) (void)hand_in(made, Must::No).ok();
    }

    Status check_beside_world() const {
        if (prepared_->world() != nullptr) return Status::done();
        return Error{Code::Refused,
                     "a plan alone cannot go another way from an instant on; change it for "
                     "the whole run, without --from"};
    }

    Status change(const ValueGiven& given, Only only) override {
        TRY(check_beside_world());
        const auto [slot, value] = TRY(embed::parse_set(plan_->graph().plans.front(), given.text));
        if (only == Only::Do) prepared_->set(slot, value);
        return Status::done();
    }

    Status change(const FileTookOver& other, Only only) override {
        TRY(check_beside_world());
        if (!versions_->is_part(path_of(other.file))) return Rerun::change(other, only);
        const embed::PlanVersions::Made made = versions_->with({{path_of(other.file), other.text}});
        if (!made.plan.ok()) {
            return Error{Code::BadInput, joined_lines(embed::errors_of(made.plan))};
        }
        if (!debugger_) debugger_.emplace(plan_->graph(), run::Debugger::At::Run);
        return only == Only::Ask ? Status::done() : hand_in(made, Must::Yes);
    }

    Status change(const Reseeded& drawn, Only only) override {
        TRY(check_beside_world());
        if (only == Only::Do) prepared_->reseed(drawn.seed);
        return Rerun::change(drawn, only);
    }

    // Whether the run fails if the version is refused.
    enum class Must : uint8_t { No, Yes };
    Status hand_in(const embed::PlanVersions::Made& made, Must must) {
        versions_->hand_in(made);
        const uint64_t number = TRY(debugger_->post(run::TakeVersion{made.next}));
        asked_.emplace(number, Asked{made.plan, must});
        return Status::done();
    }

    // What the run says to new versions of its plan.
    void hear_debugger() {
        while (debugger_ && !asked_.empty()) {
            const std::optional<run::Report> report = debugger_->wait_report(Duration{});
            if (!report) return;
            const auto* const answer = std::get_if<run::Answer>(&*report);
            if (answer != nullptr && asked_.contains(answer->request)) hear(*answer);
        }
    }

    void hear(const run::Answer& answer) {
        const Asked asked = asked_.extract(answer.request).mapped();
        const std::vector<std::string> reasons =
            answer.reply.ok() ? std::get<run::Change>(answer.reply.value()).reasons
                              : std::vector{answer.reply.error().what};
        if (reasons.empty()) {
            versions_->took(asked.plan.graph());
        } else if (asked.must == Must::No) {
            versions_->refused(asked.plan.graph());
        } else if (changed_.ok()) {
            changed_ = Error{Code::Refused, joined_lines(reasons)};
        }
    }

    // A version that is not answered yet.
    struct Asked {
        embed::LoadedPlan plan;
        Must must = Must::No;
    };

    toolbox::Parts parts_;  // before the library, whose code looks at them
    run::CodeLibrary library_;
    std::optional<embed::LoadedPlan> plan_;
    std::unique_ptr<embed::PreparedRun> prepared_;
    std::optional<embed::PlanVersions> versions_;
    std::optional<run::Debugger> debugger_;  // where something asks it
    std::map<uint64_t, Asked> asked_;        // by the debugger's number
    std::vector<Input> asks_;                // of its debugger, of a run with kDebugVerb
    size_t next_ask_ = 0;
    Time asked_until_{};
    EndingTape* tape_ = nullptr;
    bool plan_over_ = false;
    bool over_ = false;
};

Result<std::unique_ptr<Rerun>> Rerun::open(const mcap::Reader& reader,
                                           const RerunOptions& options) {
    RecordedRun recorded = TRY(read_recorded(reader));
    RunFile run = std::move(recorded.about);
    if (run.is_of_bus()) return open_bus_rerun(reader, std::move(run), options);
    UnpackedFolder folder = TRY(UnpackedFolder::make());
    for (const mcap::Attachment& one : reader.attachments()) {
        const auto instead = options.with.find(one.name);
        const bool as_it_was = instead == options.with.end() || options.from;
        TRY(folder.add(one.name, as_it_was ? one.data : std::string_view(instead->second)));
    }
    std::vector<Input> inputs = std::move(recorded.inputs);
    const Time end = recorded.end;
    if (options.from && *options.from > end) {
        return Error{Code::BadInput,
                     fmt::format("--from {}: {} ends at {} s", seconds_text(*options.from),
                                 reader.name(), seconds_text(end))};
    }
    if (options.from) inputs = other_inputs(std::move(inputs), options);
    std::unique_ptr<Rerun> made;
    if (run.plan.empty()) {
        made = make_world_rerun(std::move(run), std::move(folder));
    } else {
        made = std::make_unique<PlanRerun>(std::move(run), std::move(folder));
    }
    made->inputs_ = std::move(inputs);
    made->until_ = options.until;
    made->end_ = end;
    made->cut_ = !is_whole(reader) && !options.from;
    made->another_way_ = options.from.has_value();
    TRY(made->prepare());
    return made;
}

}  // namespace vagus::record
