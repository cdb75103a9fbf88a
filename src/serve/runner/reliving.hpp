// The past of a run that continues from an instant of a run before it: what was recorded of that
// one up to then is done once more, with the files of then, before anybody hears of it.
//
//     Reliving past({.plan = plan, .recording = recording, .abort = abort});
//     TRY(past.begin(order));                         // before the run reads its files
//     past.enter(session, link);                      // before its first instant
//     if (past.is_on() && !past.between_instants(now)) go_on(past.end());
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "record/past_run.hpp"
#include "serve/runner/plan_runner.hpp"
#include "serve/runner/run_recording.hpp"
#include "serve/talk/orders.hpp"
#include "session/sim_session.hpp"

namespace vagus::serve {

class Reliving {
public:
    // Borrowed. `abort` ends the plan, as a person did then; `loaded` is told what a person did.
    struct Run {
        PlanRunner& plan;
        RunRecording& recording;
        std::function<void()> abort;
        std::function<void(uint16_t node)> loaded;  // with another program
        std::function<void(uint64_t seed)> reseed;  // of all that is random
    };
    explicit Reliving(Run run) : run_(std::move(run)) {}

    // If the order has a past: from here on its files are read as they were, and the run begins as
    // that one did. The Error says why it cannot be lived again.
    Status begin(talk::Open& order);
    // The run is open, and is to have what came before its first instant.
    void enter(session::SimSession& session, hub::LinkId link);
    bool is_on() const { return past_.has_value(); }

    // Does what came then. False: nothing more comes, and the run is where it was to be.
    bool between_instants(Time now);
    // The same while the plan is held within an instant. False: it stays held.
    bool while_held(Time now);

    // From here on it is a run as any. Gives the files that are others on the disk now.
    std::vector<std::string> end();

private:
    bool is_due(Time now) const;
    void do_again(const record::Input& input);
    void ask(const run::Request& request);
    void take(const record::PlanFiles& files);
    std::string path_of(const std::string& name) const { return paths_->of(name); }

    Run run_;
    std::optional<record::PastRun> past_;
    std::optional<FilesInstead> instead_;
    std::optional<record::PastPaths> paths_;
    size_t next_ = 0;  // of the inputs
    int breakpoints_ = 0;
    session::SimSession* session_ = nullptr;
    hub::LinkId link_;
};

}  // namespace vagus::serve
