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

Result<std::unique_ptr<PlanRecording>> PlanRecording::begin(const std::string& path, RunFile about,
                                                            const FilesRead& files,
                                                            embed::PreparedRun& run, Pace pace) {
    if (run.world() != nullptr) {
        const auto& faults = run.world()->session().world().chaos();
        if (!faults.empty()) about.chaos = sim::format_chaos(faults);
    }
    auto tape = TRY(start_tape(path, about, pack(files.all()), pace));
    // make_unique cannot reach the constructor.
    std::unique_ptr<PlanRecording> made(new PlanRecording(std::move(tape), format_run(about)));
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

Status PlanRecording::end() {
    for (const int listener : std::exchange(listeners_, {})) run_->unlisten(listener);
    run_->defer_aborts(false);
    if (tap_) {
        run_->tap(nullptr);
        recorder_->input_at(tap_->now(), RecordingEnds{});
    } else if (recorder_) {
        recorder_->end(last_);
    }
    tap_.reset();
    recorder_.reset();
    return tape_->end();
}

}  // namespace vagus::record
