// What the history is told, by the run and by the robot, and when it begins again.
#include "serve/workbench/workbench.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/seconds.hpp"
#include "base/time.hpp"
#include "record/past_run.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/runner/keep_host.hpp"
#include "trial/test_file.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kNotAgainMax = 1000;  // bytes, as in the protocol

// Why a run that is shown has no recording.
std::string nothing_to_ask(bool on_bus, bool serves) {
    if (!on_bus) return "nothing has run yet, so there is nothing to ask about; Run starts it";
    if (serves) {
        return "this is asked of a recording, and a robot that serves itself records no runs on "
               "its bus; run its plan from the studio of another computer";
    }
    return "the runs of a robot on a bus are recorded, and none has begun yet; Run starts one";
}

}  // namespace

void Workbench::record_history() {
    history_.set_doc_of([this](const std::string& file) { return doc_of(file); });
    history_.set_recording_at([this](const std::string& path) { return recording_at(path); });
    run_.on_told({
        .plan = [this](const talk::PlanVersion& one) { history_.plan(one); },
        .trace = [this](const std::string& line) { history_.trace(line); },
        .records = [this](const std::string& bytes) { history_.records(bytes); },
        .happened = [this](const Happened& one) { history_.happened(one); },
        .picture =
            [this](const talk::PictureThen& one) {
                history_.picture({one.t, one.robot, one.bytes.bytes});
            },
    });
    // A simulation stamps what it tells, and tells itself what happened while its past is run
    // again. On a bus the time is that of hearing it.
    target_.on_told({
        .event = [this](const debug::Event& event) { scripts_recording_.happened(event); },
        .happened =
            [this](const Happened& one) {
                record_happened(one);
                if (one.kind == "loaded") record_script(one.node, one.name);
            },
        .run = [this] { return history_.run(); },
        // Of a simulation the records tell all words.
        .words =
            [this](double, uint16_t node, uint16_t address, std::span<const int16_t> values) {
                if (bus_) history_.words(clock(), node, address, values);
            },
        .unwatched =
            [this](double, uint16_t node, uint16_t address, uint16_t count) {
                if (bus_) history_.unwatched(clock(), node, address, count);
            },
    });
}

void Workbench::record_happened(Happened happened) {
    if (bus_) happened.t = clock();
    history_.happened(std::move(happened));
}

void Workbench::record_plan(const RunOrder& order) {
    History::Beginning beginning{.name = order.plan.empty() ? order.world : order.plan};
    beginning.name = beginning.name.substr(beginning.name.rfind('/') + 1);
    history_.begin(std::move(beginning));
}

// A run that cannot be recorded goes all the same.
void Workbench::record_run(RunOrder& order) {
    auto path = recordings_.next(run_has_begun(), order.past ? order.past->recording : "");
    if (!path.ok()) return say("warning", "this run is not recorded: " + path.error().what);
    order.recording = std::move(path.value());
    std::erase_if(recorded_,
                  [this](const auto& one) { return one.first != recordings_.of_run(false); });
    recorded_[order.recording] = order;
}

// ---- a run that continues from an instant of the one that is shown ----

void Workbench::continue_from(const Call& call) {
    if (!project_) return call.fail("unavailable", "no project is open; open one first");
    const auto recording = recording_of_run();
    if (!recording.ok()) return call.fail(recording.error());
    if (!save_all(call)) return;
    run_.flush_recording([this, call, stops = stops_, file = recording.value()] {
        // The run that is there ends only for one that can be lived again.
        worked<Status>(
            worker_.poster(),
            [file, t = from_seconds(call.in["t"])]() -> Status {
                (void)TRY(record::read_past(file, t));
                return Status::done();
            },
            [this, call, stops, file](const Status& can) {
                if (stops != stops_) return call.fail("failed", kStoppedBefore);
                can.ok() ? continue_run(call, file) : call.fail(can.error());
            });
    });
}

void Workbench::continue_run(const Call& call, const std::string& recording) {
    const auto then = recorded_.find(recording);
    if (then == recorded_.end() || !project_ || bus_) {
        return call.fail("unavailable", "another run has begun meanwhile; look back into that one");
    }
    RunOrder order = then->second;
    order.past = talk::PastOf{recording, call.in["t"]};
    order.set_then = call.in.value("set", Json::array());
    begin_past(call, std::move(order), !call.in.value("paused", false));
}

void Workbench::begin_past(const Call& call, RunOrder order, bool go) {
    order.breakpoints = plan_breakpoint_orders();
    const life::CallNumber number = keep(call);
    saved_plans_.clear();  // what has changed since then is told when it is there
    const bool plan = !order.plan.empty();
    orders_.emplace(number, std::move(order));
    if (plan) {
        life::Start start{.call = number, .plan = true, .go = go, .again = true, .past = true};
        start.by = who_asks(call);
        tell_life(start);
    } else {
        tell_life(life::Open{number, go, who_asks(call), true});
    }
    live();
}

// What the nodes were loaded with is among the frames; this is for names and lines.
void Workbench::record_script(uint16_t node, const std::string& name) {
    if (!project_) return;
    const ScriptPart* const part = scripts_.for_node(name, node);
    const auto text = part ? files_.text(part->file) : Error{Code::NotFound, ""};
    if (!text.ok()) return;
    const std::string file = project_->real(part->file);
    if (bus_) return scripts_recording_.loaded(node, file, text.value());
    run_.script_loaded(node, file, text.value());
}

ShownRun Workbench::shown_run() {
    return {.file = [this] { return recording_of_run(); },
            .flush =
                [this](std::function<void()> done) {
                    if (!scripts_recording_.tended().is_there()) {
                        return run_.flush_recording(std::move(done));
                    }
                    scripts_recording_.tended().flush(std::move(done));
                },
            .kept = [this](const std::string& path) { return asked_recording(path); }};
}

// In a world nothing has been done before time passes; on a bus something has from the first frame.
bool Workbench::run_has_begun() const {
    return bus_ || run_.time() > 0;
}

Result<std::string> Workbench::asked_recording(const std::string& path) const {
    if (is_recording_file(path)) return recording_at(path);
    return Error{Code::Refused, path +
                                    ": a trace tells what a plan did, and not why; record the run "
                                    "to ask that, with --record FILE.mcap"};
}

Result<std::string> Workbench::recording_of_run() const {
    // On a bus nothing of a run before is shown.
    const std::string path = recordings_.of_run(run_has_begun());
    std::error_code failed;
    if (!path.empty() && std::filesystem::exists(path, failed)) return path;
    if (!path.empty() && run_has_begun()) {
        return Error{Code::NotFound, with_short_paths(path) +
                                         ": the recording of this run is not there any more; "
                                         "Run makes a new one"};
    }
    return Error{Code::Unavailable, nothing_to_ask(bus_ != nullptr, places_.serves)};
}

// ---- a recording that is opened: its run is run again, all of it ----

void Workbench::open_recording(const Call& call) {
    if (!project_) return call.fail("unavailable", "no project is open; open one first");
    if (bus_) {
        return call.fail("unavailable", "a recorded run is run again by the simulator; choose it");
    }
    const std::string path = call.in["path"];
    const auto file = recording_at(path);
    if (!file.ok()) return call.fail(file.error());
    using Read = Result<record::PastRun>;
    worked<Read>(
        worker_.poster(), [file = file.value()] { return record::read_past(file, std::nullopt); },
        [this, call, stops = stops_, path](const Read& past) {
            if (stops != stops_) return call.fail("failed", kStoppedBefore);
            if (!project_ || bus_) return call.fail("unavailable", "the project was closed");
            if (past.ok()) return relive(call, project_->real(path), past.value());
            const std::string why = with_short_paths(past.error().what);
            past.error().code == Code::Refused ? not_again(call, why) : call.fail("bad_input", why);
        });
}

// What was recorded can be looked at all the same (history.open).
void Workbench::not_again(const Call& call, const std::string& why) {
    call.done({{"again", false}, {"why", line_of(why, kNotAgainMax)}});
}

Result<std::string> Workbench::recording_at(const std::string& path) const {
    if (!project_) return Error{Code::Unavailable, "no project is open; open one first"};
    std::string file = project_->real(path);
    // Folders whose names begin with a dot are not among the files of a project.
    const bool kept =
        recordings_.keeps(file) || tests_.has_recording(path) || turnings_.has_recording(path);
    if (kept || files_.exists(path)) return file;
    return Error{Code::NotFound, path + ": there is no such file"};
}

void Workbench::list_recordings(const Call& call) {
    if (!project_) return call.fail("unavailable", "no project is open; open one first");
    Json recordings = Json::array();
    for (const Recordings::Kept& one : recordings_.kept()) {
        recordings.push_back({{"path", project_->doc_of(one.path)},
                              {"number", one.number},
                              {"bytes", one.bytes},
                              {"when_wall", one.when_wall}});
    }
    call.done({{"recordings", std::move(recordings)}});
}

// Its files are those of the project, as they were then.
void Workbench::relive(const Call& call, const std::string& recording,
                       const record::PastRun& past) {
    const std::string main = whys_.path_of(past.main());
    if (main.empty()) {
        return not_again(call, fmt::format("the recorded run was of {}, which this project does "
                                           "not have",
                                           past.main()));
    }
    const auto paths = past.paths(project_->real(main));
    if (!paths.ok()) return not_again(call, paths.error().what);
    RunOrder order;
    order.world = paths.value().of(past.about.world);
    if (!past.about.plan.empty()) order.plan = project_->real(main);
    for (const std::string& one : past.about.toolboxes) {
        order.toolboxes.push_back(paths.value().of(one));
    }
    if (past.about.world.empty()) {
        return not_again(call,
                         "the recorded run was of a plan without a world; "
                         "`vagus replay` runs it again");
    }
    order.past = talk::PastOf{.recording = recording};
    const bool live = call.in.value("live", false);
    if (live) order.past->t = 0;
    begin_past(call, std::move(order), live);
}

// ---- a run that becomes a test ----

namespace {

constexpr size_t kTestNamesMax = 1000;  // NAME.test.json, NAME-2.test.json, …
constexpr Duration kKeepWithin = 120s;  // then the one run of the test is not waited for any more

// Of a plan or, where there is none, of a world.
std::string test_beside(const std::string& main, size_t number) {
    std::string stem = main;
    for (const std::string_view ending : {".plan.json", ".world.json"}) {
        if (main.ends_with(ending)) stem.resize(main.size() - ending.size());
    }
    return numbered(stem, number) + std::string(trial::kTestEnding);
}

}  // namespace

QuestionRules Workbench::keep_rules() const {
    return {.program = places_.program,
            .verb = "keep-host",
            .kind = kKeepAsked,
            .memory_max = kTestMemoryMax,
            .within = kKeepWithin,
            .look_every = kTestsLookEvery,
            .refused = "failed",
            .died = "the run was not kept as a test",
            .late = fmt::format("to run this test once takes longer than {} s; use `vagus test "
                                "new` in a terminal",
                                seconds_of(kKeepWithin))};
}

void Workbench::keep_test(const Call& call) {
    const auto recording = recording_of_run();
    if (!recording.ok()) return call.fail(recording.error());
    const auto order = recorded_.find(recording.value());
    std::string main;
    if (order != recorded_.end()) main = order->second.plan;
    if (order != recorded_.end() && main.empty()) main = order->second.world;
    keeps_.ask(call, {{"test", test_beside(main, 1)}}, [this, call, main](const Json& kept) {
        if (!project_) return call.fail("unavailable", "the project was closed");
        const auto path = new_test(project_->doc_of(main), kept["text"]);
        if (!path.ok()) return call.fail(path.error());
        call.done({{"path", path.value()}, {"differs", kept["differs"]}});
    });
}

Result<std::string> Workbench::new_test(const std::string& main, const std::string& text) {
    for (size_t i = 1; i <= kTestNamesMax; ++i) {
        const std::string path = test_beside(main, i);
        if (files_.exists(path)) continue;
        TRY(files_.make(path, text));
        return path;
    }
    return Error{Code::Refused,
                 fmt::format("there are {} tests of {} already; delete some", kTestNamesMax, main)};
}

// What comes before it runs is at its beginning.
void Workbench::record_bus() {
    bus_since_.reset();
    History::Beginning beginning{.kind = "bus", .name = project_ ? project_->target : ""};
    history_.forget();
    history_.begin(std::move(beginning));
    target_.tell_words();
}

void Workbench::end_scripts_recording() {
    scripts_run_ = false;
    scripts_recording_.end();
}

// A robot that serves itself keeps several versions of its project, and has no room for runs.
void Workbench::record_scripts() {
    record_bus();
    if (places_.serves || !project_ || project_->scripts.empty()) return;
    const auto path = recordings_.next(run_has_begun());
    if (!path.ok()) return say("warning", "this run is not recorded: " + path.error().what);
    record::RunFile about;
    about.verb = record::kStudioVerb;
    about.bus = project_->target;
    about.project = project_->real(project_->scripts.front());
    std::map<std::string, std::string> files;
    for (const std::string& script : project_->scripts) {
        const auto text = files_.text(script);
        if (text.ok()) files[project_->real(script)] = text.value();
    }
    scripts_recording_.begin(path.value(), std::move(about), files, *target_.network(),
                             [this] { return from_seconds(clock()); });
}

}  // namespace vagus::serve
