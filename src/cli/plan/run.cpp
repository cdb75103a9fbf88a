#include "cli/plan/run.hpp"

#include <CLI/CLI.hpp>
#include <thread>

#include "cli/options.hpp"
#include "cli/output.hpp"
#include "embed/loaded_plan.hpp"
#include "session/plan_world.hpp"
#include "session/toolboxes.hpp"

namespace vagus::cli {

namespace {

// What cannot be run again is not recorded as if it could.
Status check_recording(const embed::RunWords& words, const std::string& what) {
    if (!words.listen.empty()) {
        return Error{Code::Refused, what + "not together with --listen; leave one of them out"};
    }
    if (words.world.empty() && words.bus.empty() && words.clock != "virtual") {
        return Error{Code::Refused, what +
                                        "a run in real time cannot be run again; give it a "
                                        "--world, or --clock virtual"};
    }
    return Status::done();
}

}  // namespace

void show_findings(const plan::Findings& findings) {
    say(embed::format_findings(findings));
}

TerminalRun::TerminalRun() = default;
TerminalRun::~TerminalRun() = default;

std::unique_ptr<TerminalRun> TerminalRun::prepare(const PlanRunOptions& options) {
    std::unique_ptr<TerminalRun> made(
        new TerminalRun());  // make_unique cannot reach the constructor
    const embed::RunWords& words = options.words;
    std::optional<FilesRead> files;  // all that is read from here on
    if (!options.record.empty() || options.asked) files.emplace();
    const Status added = session::add_toolboxes(made->library_, made->parts_, words.toolboxes);
    if (!added.ok()) {
        complain(added.error());
        return nullptr;
    }
    made->plan_ = embed::LoadedPlan::from_file(options.file, made->library_);
    show_findings(made->plan_->findings());
    if (!made->plan_->ok()) return nullptr;
    auto prepared = embed::PreparedRun::prepare(*made->plan_, words, made->parts_);
    if (!prepared.ok()) {
        complain(prepared.error());
        return nullptr;
    }
    made->prepared_ = std::move(prepared.value());
    made->prepared_->tell([](const std::string& sentence) { complain(sentence); });
    if (options.quiet) made->prepared_->report([](const std::string&) {});
    if (!options.record.empty()) {
        Status begun = check_recording(options.words, "--record " + options.record + ": ");
        if (begun.ok()) begun = made->begin_recording(options, *files);
        if (!begun.ok()) {
            complain(begun.error());
            return nullptr;
        }
    } else if (files) {
        made->recorded_ = made->begin_unkept_recording(options, *files);
    }
    const std::string listening = made->prepared_->listening();
    if (listening.empty()) return made;
    const std::string line = "listening " + listening + "\n";
    words.traces_on_stdout() ? say(line) : void(print(line));
    return made;
}

std::vector<std::string> TerminalRun::files() const {
    std::vector<std::string> files = prepared_->files();
    for (const plan::Plan& one : plan_->plans()) files.push_back(one.file);
    return files;
}

Status TerminalRun::begin_recording(const PlanRunOptions& options, const FilesRead& files) {
    session::PlanWorld* const world = prepared_->world();
    if (options.record_camera) {
        TRY(record::check_cameras(world == nullptr ? nullptr : &world->session().world()));
    }
    const embed::RunWords& words = options.words;
    record::RunFile about;
    if (!words.bus.empty()) about.kind = record::kBusKind;
    about.verb = options.verb;
    about.bus = words.bus;
    about.project = words.project;
    about.plan = options.file;
    about.world = words.world;
    about.toolboxes = words.toolboxes;
    about.set = words.set;
    about.from = words.from;
    about.seed = words.seed;
    about.max_time = words.max_time;
    about.robot = words.robot;
    about.poses = words.poses;
    about.answers = words.answers;
    const auto pace = words.clock == "virtual" ? record::Pace::Waits : record::Pace::NeverWaits;
    recording_ =
        TRY(record::PlanRecording::begin(options.record, about, files.all(), *prepared_, pace));
    if (options.record_camera) recording_->follow_cameras();
    record_ = options.record;
    return Status::done();
}

// A real bus has an observer only where somebody wants it.
Status TerminalRun::begin_unkept_recording(const PlanRunOptions& options, const FilesRead& files) {
    if (!options.words.bus.empty()) {
        return Error{Code::Refused,
                     "why: a run on a real bus is recorded where it is asked for: begin with "
                     "--record run.mcap"};
    }
    TRY(check_recording(options.words, "why: "));
    PlanRunOptions unkept = options;
    unkept_.emplace(TRY(TemporaryFolder::make("asked")));
    unkept.record = unkept_->path() + "/run.mcap";
    return begin_recording(unkept, files);
}

Result<std::string> TerminalRun::recorded() {
    const std::lock_guard lock(recording_mutex_);
    TRY(recorded_);
    if (!recording_) return record_;
    const uint64_t number = recording_->flush();
    while (!recording_->flushed(number)) std::this_thread::yield();
    return record_;
}

void TerminalRun::end_recording() {
    const std::lock_guard lock(recording_mutex_);
    if (!recording_) return;
    const Status written = recording_->end();
    if (unkept_) {
        recorded_ = written;
    } else {
        if (!written.ok()) complain(written.error());
        all_recorded_ = written.ok();
        complain_left_out(record_, recording_->dropped(), "variables, poses and cameras");
    }
    recording_.reset();
}

void TerminalRun::set_debugger(run::Debugger& debugger) {
    debugger_ = &debugger;
    if (recording_) recording_->follow(debugger);
}

run::Ended TerminalRun::run() {
    Result<run::Ended> ended = prepared_->run(debugger_);
    end_recording();
    if (ended.ok()) return ended.value();
    complain(ended.error());
    return {.result = plan::PlanResult::Error, .message = {}};
}

int TerminalRun::exit_status(const run::Ended& ended) {
    const int status = prepared_->exit_status(ended);
    return status == kExitDone && !all_recorded_ ? kExitFailed : status;
}

void add_plan_file(CLI::App& verb, std::string& file) {
    CLI::Option* option = verb.add_option("FILE", file, "the plan, NAME.plan.json")->required();
    takes_file(*option, {".plan.json"});
}

namespace {

// An empty word stands for an option that was not given.
std::string refuse_empty(std::string& given) {
    return given.empty() ? "expected a value, found nothing" : "";
}

}  // namespace

void add_run_options(CLI::App& verb, PlanRunOptions& options) {
    add_plan_file(verb, options.file);
    embed::RunWords& words = options.words;
    for (const embed::RunOption& option : embed::run_options()) {
        const std::string name(option.name);
        const std::string help(option.help);
        CLI::Option* const added =
            option.many ? verb.add_option(name, words.*option.many, help)->allow_extra_args(false)
                        : verb.add_option(name, words.*option.one, help)
                              ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
        added->check(CLI::Validator(refuse_empty, ""));
        if (!option.choices.empty()) {
            takes_one_of(*added, option.choices);
        } else if (!option.endings.empty()) {
            takes_file(*added, option.endings);
        } else {
            added->type_name(std::string(option.value));
        }
    }
}

}  // namespace vagus::cli
