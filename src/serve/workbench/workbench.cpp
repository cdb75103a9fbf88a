#include "serve/workbench/workbench.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "aesl/project_text.hpp"
#include "aesl/target.hpp"
#include "base/time.hpp"
#include "serve/history/kept_run.hpp"
#include "serve/json.hpp"
#include "serve/workbench/new_files.hpp"
#include "session/known_nodes.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr size_t kEntriesMax = 2000;  // of a folder that is shown for choosing

}  // namespace

Workbench::Workbench(net::Links& links, Desk& desk, const WorkbenchPlaces& places)
    : links_(links),
      desk_(desk),
      places_(places),
      library_(places.library),
      settings_(places.settings, &kept_on_disk_),
      scripts_(files_,
               [this](const std::string& name, uint16_t id) { return target_of(name, id); }),
      editing_(desk, files_, scripts_, desk.epoch()),
      target_(desk, files_, scripts_, breakpoints_),
      run_(desk, places.runner ? places.runner : start_runner(places.program)),
      worker_([&links] { links.wake(); }),
      history_(desk, files_, worker_.poster()),
      whys_(desk, files_, scripts_, places.program, shown_run()),
      turnings_(desk, files_, start_runner(places.program, "turning-host", kTurningMemoryMax),
                shown_run(),
                {.chain_of = [this](const Json& chain) { return whys_.shown_chain(chain); },
                 .shorten = [this](const std::string& text) { return with_short_paths(text); },
                 .run = [this] { return history_.run(); }}),
      logs_(desk, scripts_, places.program, shown_run()),
      pairs_(desk, places.program, shown_run(),
             {.recording_at = [this](const std::string& path) { return recording_at(path); },
              .doc_of = [this](const std::string& file) { return doc_of(file); }}),
      keeps_(keep_rules(), kKeepsAtOnce, shown_run()),
      compares_(
          desk, files_, [this](const std::string& doc) { return run_.plan_text(doc); },
          [this](double t, const std::string& doc) { return history_.plan_text(t, doc); }),
      tries_(desk, files_, places.program,
             {.toolboxes = [this] { return toolboxes_on_disk(); },
              .real = [this](const std::string& doc) { return real(doc); },
              .doc_of = [this](const std::string& file) { return doc_of(file); },
              .new_test = [this](const std::string& plan,
                                 const std::string& text) { return new_test(plan, text); }}),
      tests_(desk, files_, scripts_, start_runner(places.program, "test-host", kTestMemoryMax),
             {.doc_of = [this](const std::string& file) { return doc_of(file); },
              .shorten = [this](const std::string& text) { return with_short_paths(text); },
              .save_all = [this](const Call& call) { return save_all(call); }}),
      sleep_({.slept = places.slept}) {
    files_.on_wake([&links] { links.wake(); });
    const auto tell = [this](const std::string& kind, const std::string& text) {
        say(kind, with_short_paths(text));
    };
    editing_.on_say(tell);
    target_.on_say(tell);
    run_.on_say(tell);
    editing_.on_text_changed([this](const std::string& path) {
        target_.script_changed(path);
        tests_.text_changed(path);
        world_edited(path);
        if (project_ && path == project_->project_file) project_file_changed();
    });
    editing_.on_saved([this](const std::string& path) { file_saved(path); });
    editing_.on_renamed([this](const std::string& from, const std::string& to) {
        breakpoints_.rename(from, to);
        plan_breakpoints_.rename(from, to);
        keep_breakpoints();
    });
    target_.on_breakpoints_changed([this] { keep_breakpoints(); });
    target_.set_hints({
        .robot_of = [this](uint16_t node) { return run_.robot_of(node); },
        .plan_hears = [this](const std::string& event) { return run_.plan_hears(event); },
        .load = [this] { return run_.load(); },
        .stopped_at_breakpoint = [this] { tell_life(life::Halted{}); },
        .time = [this] { return clock(); },
        .loaded_already =
            [this](uint16_t node) {
                const auto found = loaded_by_world_.find(node);
                return found == loaded_by_world_.end() ? std::optional<std::string>()
                                                       : std::optional(found->second);
            },
    });
    run_.set_doc_of([this](const std::string& file) { return doc_of(file); });
    run_.set_short([this](const std::string& text) { return with_short_paths(text); });
    hear_run();
    run_.on_breakpoints([this](const Run::BreakpointsNow& list) {
        if (plan_breakpoints_.note(list)) desk_.topics().touch("breakpoints");
    });
    record_history();
    desk.on_people([this] { people_changed(); });
    declare_topics();
    declare_project_commands();
    declare_kept_commands();
    declare_run_commands();
    declare_plan_commands();
    declare_debug_commands();
    declare_world_commands();
}

Workbench::~Workbench() = default;

void Workbench::say(const std::string& kind, const std::string& text) {
    desk_.topics().add("console", {{"t", clock()}, {"kind", kind}, {"text", text}});
    line_(kind, text);
}

// Seconds: those of a simulation, or since what runs on the bus began; since it was connected, if
// nothing has.
double Workbench::clock() const {
    if (!bus_) return run_.time();
    return bus_since_ ? seconds_of(now_ - *bus_since_) : 0;
}

// ---- documents ----

void Workbench::declare_topics() {
    Topics& topics = desk_.topics();
    topics.document("studio", [this](const Json&) { return studio_document(); });
    topics.document("start", [this](const Json&) {
        return Json{{"examples", library_.examples()}, {"recent", library_.recent()}};
    });
    topics.document("targets", [this](const Json&) { return targets_.document(); });
    topics.document("state", [this](const Json&) {
        return Json{{"values", state_.object("window")}};
    });
    topics.document("breakpoints", [this](const Json&) {
        return Json{{"breakpoints", target_.breakpoints_list()},
                    {"plans", plan_breakpoints_.list()}};
    });
    topics.document("end", [this](const Json&) { return ends_.document(); });
    topics.stream("console", Protocol::get().limit("lines_kept"));
}

Json Workbench::studio_document() const {
    Json studio = desk_.people();
    studio["settings"] = settings_.values();
    studio["recovered"] = files_.recovered();
    if (project_) studio["project"] = project_->to_json();
    if (project_ && simulates() && world_has_changed()) studio["project"]["world_changed"] = true;
    if (places_.serves) studio["serves"] = true;
    return studio;
}

// ---- what is open ----

void Workbench::declare_project_commands() {
    const auto enter_for = [this](const Call& call, const Result<OpenedProject>& project) {
        if (!project.ok()) return call.fail(project.error());
        const auto then = [this, call] {
            if (!project_) return call.fail("unavailable", "the project was closed meanwhile");
            call.done({{"path", project_->folder}});
        };
        leave_for(project.value(), then, who_asks(call));
    };
    const auto open_for = [enter_for](const Call& call, const Result<std::string>& path) {
        enter_for(call, path.ok() ? open_path(path.value()) : path.error());
    };
    desk_.command("project.example", [this, open_for](const Call& call) {
        open_for(call, library_.copy_of_example(call.in["id"]));
    });
    desk_.command("project.open", [this, enter_for](const Call& call) {
        const std::string path = call.in["path"];
        if (!is_recording_file(path)) return enter_for(call, open_path(path));
        // It is read and copied first, which may take seconds.
        worked<Result<OpenedProject>>(
            worker_.poster(), [this, path] { return project_at(path); },
            [call, enter_for](const Result<OpenedProject>& project) { enter_for(call, project); });
    });
    desk_.command("project.new", [this, open_for](const Call& call) {
        open_for(call, library_.make_project(call.in["name"], call.in["robot"], call.in["plan"]));
    });
    desk_.command("project.make", [this, open_for](const Call& call) {
        open_for(call, project_made_for(call.in.value("doc", "")));
    });
    desk_.command("project.close", [this](const Call& call) {
        leave({who_asks(call), life::Why::Project}, [this, call] {
            forget_project();
            call.done();
        });
    });
    desk_.command("project.forget", [this](const Call& call) {
        library_.forget(call.in["path"]);
        desk_.topics().touch("start");
        call.done();
    });
    desk_.command("script.add", [this](const Call& call) {
        if (!project_) return call.fail("unavailable", "no project is open; open one first");
        const auto added = add_script(call.in["node"]);
        if (!added.ok()) return call.fail(added.error());
        call.done({{"doc", added.value()}});
    });
    desk_.command("folder.list", [this](const Call& call) {
        std::error_code failed;
        const std::string asked = call.in["path"];
        const fs::path folder = fs::canonical(asked.empty() ? places_.home : asked, failed);
        if (failed || !fs::is_directory(folder, failed)) {
            return call.fail("not_found", asked + ": there is no such folder");
        }
        call.done(list_folder(folder.string()));
    });
}

Result<std::string> Workbench::project_made_for(const std::string& doc) const {
    if (!project_) return Error{Code::Unavailable, "no project is open; open one first"};
    if (!project_->project_file.empty()) {
        return Error{Code::BadInput, project_->folder + ": is a project already"};
    }
    return library_.make_project_of(*project_, doc.substr(0, doc.find('#')));
}

Json Workbench::list_folder(const std::string& path) const {
    Json entries = Json::array();
    std::error_code failed;
    for (const FolderEntry& entry : entries_of(path, failed)) {
        const std::string& name = entry.name;
        if (entries.size() >= kEntriesMax) break;
        if (entry.failed || name.starts_with(".") || name.size() > 500) continue;
        const bool folder =
            entry.is == FolderEntry::Is::Folder || entry.is == FolderEntry::Is::LinkToFolder;
        if (folder) {
            const bool project = fs::exists(fs::path(path) / name / "vagus.json", failed);
            entries.push_back({{"name", name}, {"kind", project ? "project" : "folder"}});
            continue;
        }
        const std::string kind = is_recording_file(name) ? "recording" : kind_of_file(name);
        if (kind == "script" || kind == "plan" || kind == "world" || kind == "recording") {
            entries.push_back({{"name", name}, {"kind", kind}});
        }
    }
    std::sort(entries.begin(), entries.end(), [](const Json& one, const Json& other) {
        const auto order = [](const Json& entry) {
            const std::string kind = entry["kind"];
            return std::pair(kind != "folder" && kind != "project",
                             entry["name"].get<std::string>());
        };
        return order(one) < order(other);
    });
    return {{"path", path},
            {"parent", fs::path(path).parent_path().string()},
            {"entries", std::move(entries)}};
}

Status Workbench::open(const std::string& path, Time now, std::function<void()> then,
                       const std::string& by) {
    now_ = now;
    leave_for(TRY(project_at(path)), std::move(then), by);
    return Status::done();
}

void Workbench::leave_for(OpenedProject project, std::function<void()> then,
                          const std::string& by) {
    leave({by, life::Why::Project}, [this, project = std::move(project), then = std::move(then)] {
        forget_project();
        enter(project);
        then();
    });
}

// Also on the worker's thread: of what is here it uses only places that stay as they are.
Result<OpenedProject> Workbench::project_at(const std::string& path) const {
    if (!is_recording_file(path)) return open_path(path);
    const RecordedProject made = TRY(library_.project_of_recording(path));
    OpenedProject project = TRY(open_path(made.folder));
    project.recording = project.doc_of(made.folder + "/" + made.recording);
    return project;
}

Status Workbench::open_example(const std::string& id, Time now) {
    return open(TRY(library_.copy_of_example(id, true)), now);
}

void Workbench::enter(OpenedProject project) {
    project.copy_of = library_.example_of(project.root);
    project_ = std::move(project);
    if (!places_.target.empty()) project_->target = places_.target;
    files_.enter(project_->root, project_->only);
    scripts_.prefer(project_->scripts);
    scripts_.reread();
    state_ = Kept((project_->root / ".vagus" / "state.json").string(), &kept_on_disk_);
    recordings_.enter(project_->root / ".vagus" / "recordings");
    breakpoints_.from_json(state_.get("breakpoints"));
    target_.follow_breakpoints();
    plan_breakpoints_.from_json(state_.get("plan_breakpoints"));
    editing_.set_project(edited_project());
    take_safe_stop();
    library_.opened(project_->file, project_->name, desk_.wall_ms());
    for (const std::string& path : files_.recovered()) {
        say("warning", path + ": this text was not saved when the studio ended; here it is again");
    }
    for (const char* topic : {"studio", "state", "start"}) desk_.topics().touch(topic);
    // What the project is for; a robot that is not there is looked for until it is.
    const bool nothing =
        project_->target.empty() || (project_->target == "sim" && project_->world.empty());
    if (nothing) return;
    const Status chosen = join_target(project_->target);
    if (!chosen.ok()) say("error", chosen.error().what);
}

EditedProject Workbench::edited_project() const {
    if (!project_) return {};
    return {.plan = project_->plan,
            .world = project_->world,
            .project_file = project_->project_file,
            .toolboxes = project_->toolboxes};
}

void Workbench::close() {
    perform(life::Disconnect{});
    forget_project();
}

void Workbench::forget_project() {
    history_.forget();
    tests_.forget();
    turnings_.forget();
    desk_.topics().forget("happenings");
    files_.leave();
    scripts_.reread();
    breakpoints_ = {};
    plan_breakpoints_ = {};
    state_ = {};
    recordings_.enter({});
    project_.reset();
    editing_.set_project({});
    for (const char* topic : {"studio", "state", "start", "breakpoints"}) {
        desk_.topics().touch(topic);
    }
}

std::string Workbench::doc_of(const std::string& file) const {
    return project_ ? project_->doc_of(file) : file;
}

std::string Workbench::real(const std::string& doc) const {
    return project_ ? project_->real(doc) : doc;
}

std::vector<std::string> Workbench::toolboxes_on_disk() const {
    std::vector<std::string> files;
    if (!project_) return files;
    for (const std::string& one : project_->toolboxes) files.push_back(project_->real(one));
    return files;
}

// What makes its nodes safe. A toolbox file that cannot be read is told where it is used.
void Workbench::take_safe_stop() {
    const std::vector<std::string> toolboxes = toolboxes_on_disk();
    auto safe = session::safe_stop_of(toolboxes, project_->safe_stop);
    if (!safe.ok()) safe = session::safe_stop_of({}, project_->safe_stop);
    if (safe.ok()) target_.set_safe_stop(std::move(safe.value()));
}

// Its plan, world and scripts may be others now; the target stays until someone chooses another.
void Workbench::project_file_changed() {
    auto read = open_path(project_->folder);
    if (!read.ok()) return;
    read.value().copy_of = project_->copy_of;
    read.value().target = project_->target;
    project_ = std::move(read.value());
    scripts_.prefer(project_->scripts);
    editing_.set_project(edited_project());
    take_safe_stop();
    desk_.topics().touch("studio");
}

// ---- scripts for nodes that have none ----

Result<std::string> Workbench::add_script(uint16_t node) {
    const std::string name = target_.described_name(node);
    if (name.empty()) {
        return Error{Code::NotFound,
                     fmt::format("there is no node {} that has told what it is", node)};
    }
    if (const ScriptPart* there = scripts_.for_node(name, node)) return there->doc;
    std::string file;
    for (const std::string& script : project_->scripts) {
        if (file.empty() && scripts_.common(script) != nullptr) file = script;
    }
    if (file.empty()) {
        file = (fs::path(project_->project_file).parent_path() / "robot.aesl").generic_string();
        TRY(files_.make(file, new_scripts_file()));
    }
    const aesl::ProjectText text(TRY(files_.text(file)));
    (void)TRY(files_.replace(file, text.add_script(name, node), "server"));
    TRY(files_.save(file));
    return fmt::format("{}#{}", file, text.scripts() + 1);
}

// A project that was made for a robot grows with the nodes that come.
void Workbench::add_missing_scripts() {
    if (!bus_ || !project_ || !library_.is_robot_project(project_->folder)) return;
    for (const uint16_t node : target_.without_script()) {
        const auto added = add_script(node);
        if (!added.ok()) return say("warning", added.error().what);
    }
}

// Files of the project by their paths inside it, as pages call them.
std::string Workbench::with_short_paths(std::string text) const {
    if (!project_) return text;
    const std::string root = project_->root.string() + "/";
    for (size_t at = text.find(root); at != text.npos; at = text.find(root, at)) {
        text.erase(at, root.size());
    }
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

// ---- what is kept ----

void Workbench::declare_kept_commands() {
    desk_.command("settings.put", [this](const Call& call) {
        const Status kept = settings_.put(call.in["key"], call.in["value"]);
        desk_.topics().touch("studio");
        call.answer(kept);
    });
    desk_.command("state.put", [this](const Call& call) {
        if (!project_) {
            return call.fail("unavailable", "no project is open; open one first");
        }
        Json window = state_.object("window");
        window[call.in["key"].get<std::string>()] = call.in["value"];
        const Status kept = state_.put("window", std::move(window));
        desk_.topics().touch("state");
        call.answer(kept);
    });
}

void Workbench::keep_breakpoints() {
    if (!project_) return;
    for (const Status& kept : {state_.put("breakpoints", breakpoints_.to_json()),
                               state_.put("plan_breakpoints", plan_breakpoints_.to_json())}) {
        if (!kept.ok()) say("warning", kept.error().what);
    }
}

// What has run since is what people look at.
void Workbench::forget_recording() {
    if (!project_ || project_->recording.empty()) return;
    if (run_.time() <= 0 && !scripts_run_) return;
    project_->recording.clear();
    desk_.topics().touch("studio");
}

// ---- time ----

void Workbench::hear(const net::Event& event) {
    if (bus_) bus_->hear(event);
}

void Workbench::tick(Time now) {
    now_ = now;
    watch_sleep();
    run_.tick(now);
    forget_recording();
    live();
    watch_run();
    target_.tick(now);
    if (bus_) run_.hold_nodes(target_.held_nodes());
    if (run_.is_open() || bus_) history_.tick(clock());
    add_missing_scripts();
    tick_life();
    worker_.tick();
    scripts_recording_.tended().tend();
    whys_.tick(now);
    turnings_.tick(now);
    logs_.tick(now);
    pairs_.tick(now);
    keeps_.tick(now);
    compares_.tick(now);
    tries_.tick(now);
    tests_.tick(now);
    editing_.tick(now);
    change_plan();
    look_at_picture();
    follow_world_text();
    if (desk_.topics().watched("targets") && targets_.look(now)) desk_.topics().touch("targets");
}

void Workbench::watch_run() {
    const std::pair now_there(run_.descriptor(), run_.generation());
    if (now_there == watched_run_) return;
    if (watched_run_.first >= 0) links_.unwatch_input(watched_run_.first);
    watched_run_ = now_there;
    // One that cannot be watched is asked at each tick all the same.
    if (now_there.first >= 0) (void)links_.watch_input(now_there.first).ok();
}

Time Workbench::next_tick(Time now) const {
    Time next = std::min({run_.next_tick(), target_.next_tick(), editing_.next_tick()});
    if (desk_.topics().watched("targets")) next = std::min(next, now + kLookEvery);
    if (project_ && !picture_.empty()) next = std::min(next, next_picture_look_);
    if (world_edited_ && !is_being_opened()) {
        next = std::min(next, *world_edited_ + kWorldFollowsAfter);
    }
    next = std::min({next, whys_.next_tick(), turnings_.next_tick(), logs_.next_tick(),
                     pairs_.next_tick(), keeps_.next_tick(), compares_.next_tick(),
                     tries_.next_tick(), tests_.next_tick()});
    next = std::min(next, scripts_recording_.tended().next_tick(now));
    if (life_.waits_for_nodes()) next = std::min(next, now + 20ms);
    if (!told_life_.empty()) return now;
    return std::min(next, life_.next_tick());
}

}  // namespace vagus::serve
