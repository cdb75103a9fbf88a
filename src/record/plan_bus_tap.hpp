// Records a run of a plan on a real bus: what goes over the bus, what the plan heard, in the order
// in which it decided on it, and what was done to the run (past_bus.hpp reads that again).
//
//     PlanBusTap tap(*tape, recorder);
//     run.tap(&tap);                                   // an embed::PreparedRun
//     run.listen([&](const auto& event) { tap.sees(event); });
#pragma once

#include <atomic>
#include <functional>
#include <string>

#include "embed/bus_tap.hpp"
#include "plan/trace.hpp"
#include "record/bus_recorder.hpp"
#include "record/recorder.hpp"

namespace vagus::record {

class PlanBusTap final : public embed::BusTap {
public:
    // Both are borrowed.
    PlanBusTap(FileTape& tape, Recorder& recorder) : bus_(tape), recorder_(recorder) {}

    // The first line tells when the clock of the run began; what comes before that is at 0.
    void sees(const plan::TraceEvent& event);
    // By the clock of the run; from any thread.
    Time now() const;

    // On the deciding thread, of the debugger of the run. While it pauses the run, whose clock
    // stands then, the bus goes on.
    void asked(const run::Request& request, Time at);

    // ---- embed::BusTap ----
    void begin(const aesl::CommonDefinitions& common, std::function<Time()> clock) override;
    void described(const debug::NodeView& node) override { bus_.described(now(), node); }
    void happened(const debug::Event& event) override { bus_.happened(now(), event); }
    void node(const std::string& name, toolbox::BusNodes::Change change) override;
    uint32_t frame(const wire::Frame& frame, const run::BusEvent* sent) override;
    void tokens(uint16_t first) override { recorder_.input_at(now(), TokensMoved{first}); }
    void fails(const std::string& why) override { recorder_.input_at(now(), RunFailed{why}); }
    void hears(const run::BusEvent& event, Time at) override;
    void aborts(const std::string& by) override;

private:
    BusRecorder bus_;
    Recorder& recorder_;
    std::function<Time()> clock_;
    std::atomic<int64_t> began_us_ = -1;  // by that clock; below 0: it has not
    std::atomic<bool> aborted_ = false;
};

}  // namespace vagus::record
