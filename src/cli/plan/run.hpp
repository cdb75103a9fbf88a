// A plan made ready to run as the command line says: what `vagus plan run` and `debug` share.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/temporary_folder.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/prepared_run.hpp"
#include "plan/check.hpp"
#include "plan/graph.hpp"
#include "record/plan_recording.hpp"
#include "run/code.hpp"
#include "run/options.hpp"
#include "toolbox/parts.hpp"

namespace CLI {
class App;
}

namespace vagus::cli {

// On stderr, one a line.
void show_findings(const plan::Findings& findings);

struct PlanRunOptions {
    std::string verb = "plan run";  // as recordings say it
    std::string file;
    embed::RunWords words;
    bool headless = false;  // plain lines also on a terminal
    bool quiet = false;     // neither lines nor a view
    std::string theme;      // "dark", "light"; empty: found out
    bool watch = false;     // starts again when a file is saved
    std::string record;     // a file for the recording of the first run; empty: none
    bool record_camera = false;
    bool asked = false;  // without `record`, one that nobody keeps answers questions (recorded())
};

void add_plan_file(CLI::App& verb, std::string& file);
void add_run_options(CLI::App& verb, PlanRunOptions& options);

class TerminalRun {
public:
    // Nothing if it cannot run; it has complained then.
    static std::unique_ptr<TerminalRun> prepare(const PlanRunOptions& options);
    ~TerminalRun();

    const embed::LoadedPlan& loaded() const { return *plan_; }
    const plan::Graph& graph() const { return plan_->graph(); }
    const plan::Plan& plan() const { return plan_->plans().front(); }  // the outermost
    // All that were read: of the plans, their toolboxes, the world and its scripts.
    std::vector<std::string> files() const;
    embed::PreparedRun& prepared() { return *prepared_; }
    // Can be called again: each is a run of its own. One that cannot begin has complained, and is
    // over with an error.
    run::Ended run();
    // That of the plan; where it ended well, 1 if its trace or its recording could not be written.
    int exit_status(const run::Ended& ended);
    // The recording of the first run: what --record named, or one that nobody keeps; empty: none.
    const std::string& record() const { return record_; }
    // A recording of the first run with all that has happened so far, also while it goes on, for
    // questions. The Error says why there is none.
    Result<std::string> recorded();
    // Before run(); borrowed.
    void set_debugger(run::Debugger& debugger);

private:
    TerminalRun();
    Status begin_recording(const PlanRunOptions& options, const FilesRead& files);
    Status begin_unkept_recording(const PlanRunOptions& options, const FilesRead& files);
    void end_recording();

    toolbox::Parts parts_;  // before the library, whose code looks at them
    run::CodeLibrary library_;
    std::optional<embed::LoadedPlan> plan_;
    std::unique_ptr<embed::PreparedRun> prepared_;
    run::Debugger* debugger_ = nullptr;
    std::string record_;
    std::optional<TemporaryFolder> unkept_;  // of a recording for questions alone
    Status recorded_ = Status::done();       // why there is none
    std::mutex recording_mutex_;             // the thread of the run ends what follows
    std::unique_ptr<record::PlanRecording> recording_;
    bool all_recorded_ = true;
};

}  // namespace vagus::cli
