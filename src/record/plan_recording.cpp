#include "record/plan_recording.hpp"

#include <utility>

#include "session/plan_world.hpp"
#include "sim/chaos_file.hpp"

namespace vagus::record {

int attach(Recorder& recorder, embed::PreparedRun& run) {
    const int listener =
        run.listen([&recorder](const plan::TraceEvent& event) { recorder.trace(event); });
    if (run.world() == nullptr) return listener;
    recorder.follow(run.world()->session());
    // Ended by a person at an instant, so that the same run can be ended there again.
    run.defer_aborts();
    recorder.after_instant([&recorder, &run](Time) {
        const std::optional<std::string> by = run.take_abort();
        if (by) recorder.input(Aborted{*by});
    });
    return listener;
}

Result<std::unique_ptr<PlanRecording>> PlanRecording::begin(
    const std::string& path, RunFile about, const std::map<std::string, std::string>& files,
    embed::PreparedRun& run, Pace pace) {
    if (run.world() != nullptr) {
        const auto& faults = run.world()->session().world().chaos();
        if (!faults.empty()) about.chaos = sim::format_chaos(faults);
    }
    PackedFiles packed = pack(files);
    auto tape = TRY(start_tape(path, about, packed, pace));
    // make_unique cannot reach the constructor.
    std::unique_ptr<PlanRecording> made(
        new PlanRecording(std::move(tape), format_run(about), std::move(packed)));
    std::vector<int>& listeners = made->listeners_;
    listeners.push_back(attach(*made->recorder_, run));
    listeners.push_back(run.listen(
        [recording = made.get()](const plan::TraceEvent& event) { recording->last_ = event.at; }));
    made->run_ = &run;
    if (!about.is_of_bus()) return made;
    made->tap_ = std::make_unique<PlanBusTap>(*made->tape_, *made->recorder_);
    listeners.push_back(
        run.listen([tap = made->tap_.get()](const plan::TraceEvent& event) { tap->sees(event); }));
    run.tap(made->tap_.get());
    return made;
}

void PlanRecording::follow(run::Debugger& debugger) {
    debugger_ = &debugger;
    run::Debugger::Follower follower;
    follower.asked = [this](const run::Request& request, Time at) { asked(request, at); };
    if (!tap_) {
        follower.comes = [this](uint64_t place, Time) {
            recorder_->set_turn(static_cast<uint32_t>(place));
        };
    }
    debugger.follow(std::move(follower));
}

// A plan that was named by its file is that file of the recording.
void PlanRecording::asked(const run::Request& request, Time at) {
    if (const auto* const version = std::get_if<run::TakeVersion>(&request)) {
        return takes(*version, at);
    }
    if (!does_something(request)) return;
    run::Request named = request;
    if (auto* const stop = std::get_if<run::AddBreakpoint>(&named)) {
        std::string& plan = stop->breakpoint.plan;
        const std::string name = files_.name_of(plan);
        if (files_.files.contains(name)) plan = name;
    }
    if (tap_) {
        tap_->asked(named, at);
    } else {
        recorder_->input_at(at, std::move(named));
    }
}

void PlanRecording::changed(const FilesSaved& files) {
    if (files.version == nullptr) return;
    auto named_files = named(files);
    if (!named_files.ok()) return stop(named_files.error().what);
    const std::lock_guard lock(mutex_);
    versions_[files.version] = std::move(named_files.value());
}

// On the deciding thread, so that it has its place among what was decided.
void PlanRecording::takes(const run::TakeVersion& version, Time at) {
    if (version.only_ask) return;
    const std::lock_guard lock(mutex_);
    const auto files = versions_.extract(version.next.graph.get());
    if (files) recorder_->input_at(at, files.mapped());
}

void PlanRecording::let_go() {
    if (run_ == nullptr) return;
    if (debugger_ != nullptr) std::exchange(debugger_, nullptr)->follow({});
    for (const int listener : std::exchange(listeners_, {})) run_->unlisten(listener);
    run_->defer_aborts(false);
    if (tap_) {
        if (!is_stopped()) put(RecordingEnds{});
        run_->tap(nullptr);
    } else {
        recorder_->end(last_);
    }
    run_ = nullptr;
}

Status PlanRecording::end() {
    let_go();
    tap_.reset();
    recorder_.reset();
    const Status written = tape_->end();
    return is_stopped() ? Status::done() : written;
}

}  // namespace vagus::record
