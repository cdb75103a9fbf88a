// The recording of the run that the process serves, if its order names a file for it: begun with
// the run, told what comes from outside, ended with it. Without one it does nothing but what has to
// be done all the same.
//
//     RunRecording::Files read(order);               // before anything of the run is read
//     RunRecording recording(teller);
//     recording.begin(order, read, session, nullptr);
//     recording.begin_turn();                        // at each place at which something can come
//     recording.tell();                              // now and then
//     recording.end();                               // while the session is there
//
// On a bus nothing has to be told: the threads of the run record what comes, and wait for nothing.
//
//     recording.begin_on_bus(order, read, prepared, debugger);
//     recording.let_go();                            // the run is over; its debugger may go
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "base/file.hpp"
#include "record/plan_recording.hpp"
#include "record/studio_recording.hpp"
#include "record/tended_recording.hpp"
#include "serve/runner/teller.hpp"
#include "serve/talk/orders.hpp"

namespace vagus::serve {

constexpr const char* kPlanMaxTime = "1e13";  // seconds: the person at the studio ends it

class RunRecording {
public:
    // What is read for an order, from here on.
    class Files {
    public:
        explicit Files(const talk::Open& order) {
            if (!order.recording.empty()) read_.emplace();
        }
        // All that was read; nothing more is noted.
        std::map<std::string, std::string> take();

    private:
        std::optional<FilesRead> read_;
    };

    // Borrowed.
    explicit RunRecording(Teller& teller)
        : teller_(teller), tended_([this](const std::string& warning) {
              teller_.line(talk::LineKind::Warning, warning);
          }) {}

    // Session and run are borrowed until end(); no run: the world alone. That nothing can be
    // recorded is told, and the run goes on.
    void begin(const talk::Open& order, Files& read, session::SimSession& session,
               embed::PreparedRun* run);
    // The same of a run on a bus; the debugger is borrowed until let_go().
    void begin_on_bus(const talk::Open& order, Files& read, embed::PreparedRun& run,
                      run::Debugger& debugger);
    void let_go();
    void end();

    void begin_turn();
    // Time is stopped for a moment in which the nodes answer.
    void hold(sim::World& world);
    void asked(const run::Request& request);
    void changed(const record::FilesSaved& files);
    void loaded(uint16_t node, const std::string& file, const std::string& text);
    void reseeded(uint64_t seed);

    // Answered once all that is there now is in the file.
    void flush(uint64_t request);
    // What has become of it.
    void tell() { tended_.tend(); }

private:
    void keep(std::unique_ptr<record::Recording> recording);

    Teller& teller_;
    record::TendedRecording tended_;
    // The same one, as what it is.
    record::Recording* recording_ = nullptr;
    record::StudioRecording* in_world_ = nullptr;
    record::PlanRecording* on_bus_ = nullptr;
};

}  // namespace vagus::serve
