// Runs a recorded run again, from its files and its inputs.
//
//     const mcap::Reader reader = TRY(mcap::Reader::open(file.bytes(), "run.mcap"));
//     auto rerun = TRY(Rerun::open(reader, {}));
//     CompareTape tape(reader);
//     const Rerun::Ended ended = TRY(rerun->run(tape));
//     TRY(tape.end());
//
// In virtual time, by the same code that ran it: `plan run`, alone or beside a world, `sim`, and
// runs of the studio. Of a run on a real bus only the plan decides again (bus_rerun.hpp).
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mcap/reader.hpp"
#include "record/inputs.hpp"
#include "record/recorder.hpp"
#include "record/run_file.hpp"
#include "run/options.hpp"

namespace vagus::embed {
class LoadedPlan;
class RobotsWatcher;
}  // namespace vagus::embed
namespace vagus::session {
class PlanWorld;
}

namespace vagus::record {

class PastBus;

struct RerunOptions {
    // Files in place of those of the recording, by name in it: their content.
    std::map<std::string, std::string> with = {};
    std::optional<Time> until = {};  // it ends there, as if somebody had ended it
    // It is as it was up to then, and goes another way from there on: what a person did later is
    // not done, `set` (NAME=VALUE, of the plan) is, and files of `with` take over there, as they
    // do in a run while they are saved. They are scripts and the plan. What was done is an input
    // of the new run, which can be recorded and run again as any.
    std::optional<Time> from = {};
    std::vector<std::string> set = {};
    // All that is random is drawn from this seed from there on (sim::World::reseed()), and what a
    // person did later is done all the same. At most kReseedMax.
    std::optional<uint64_t> reseed = {};
};

// The file of the recording that a path on a command line means: "NAME=PATH", or a PATH whose last
// part is the last part of one name. The Error lists the names.
Result<std::pair<std::string, std::string>> named_file(const mcap::Reader& reader,
                                                       const std::string& typed);

// The end of an instant: the first that is not earlier.
Time instant_of(Time at);

// A bus of a run, with the plan beside it.
struct RunBus {
    session::SimSession* session = nullptr;   // nullptr: of a plan alone, or a real one
    const embed::LoadedPlan* plan = nullptr;  // nullptr: there is none
    std::string robot = {};                   // whose project it is; empty: the common one
    uint32_t number = 0;                      // sim::RobotId of that robot
    std::string fleet = {};                   // that it is in; empty: none
};

class Rerun {
public:
    struct Ended {
        Time at{};
        std::string how;  // "Ok", "Interrupted", "Error"; empty: of a world without a plan
        std::string message;
    };

    // Writes its files into a folder of its own and prepares the run. The Error says what is wrong
    // with the recording, with a file that was replaced, or what cannot change on the way.
    static Result<std::unique_ptr<Rerun>> open(const mcap::Reader& reader,
                                               const RerunOptions& options);
    virtual ~Rerun() = default;

    // Before run(), of one that was opened without options: their `from`, `reseed` and `until`. So
    // it can be opened once, and continued in many processes that each begin with a copy of it.
    Status continue_from(Time from, uint64_t seed, Time until);
    // Then, before that instant or while it is looked at (each_instant()): with that seed instead.
    void draw_from(uint64_t seed);
    // What it says goes to the tape. Once. The Error says what could not change on the way.
    virtual Result<Ended> run(Tape& tape) = 0;
    // Before run(): is told of each line of the trace of the plan on the common bus, and of the end
    // of each instant.
    virtual void listen(std::function<void(const plan::TraceEvent&)> listener) = 0;
    // Before run(): is told of what each supervisor raises, before it is taken. True: it is passed
    // over, and from then on the run is another one.
    virtual void pass_over(std::function<bool(const run::Raising&)>) {}
    // The same of robots with projects of their own, and more. Borrowed; nullptr: nobody.
    virtual void watch_robots(embed::RobotsWatcher*) {}
    void each_instant(std::function<void(Time)> look) { looks_.push_back(std::move(look)); }
    // Before run(): is told that no more was recorded while the plan is paused, in the middle of an
    // instant. It is ended then.
    void when_paused_at_end(std::function<void()> told) { paused_end_ = std::move(told); }
    // Before run(): is told of each act of a person, before it is done again.
    void before_act(std::function<void(const sim::Act&)> told) { told_of_act_ = std::move(told); }
    // From a listener: no more of it is wanted.
    void stop() { stopped_ = true; }
    // What a check says that is made now (Recorder::check_text()): in each_instant(), or after a
    // run() that was no Error.
    std::string check_at(Time at) const {
        return recorder_ != nullptr ? check_by(*recorder_, at) : last_check_;
    }

    // nullptr for a plan alone; that of the common bus. Valid while this is.
    virtual session::SimSession* session() = 0;
    // nullptr for a plan alone, and for a world without one.
    virtual session::PlanWorld* plan_world() = 0;
    // nullptr without one.
    virtual const embed::LoadedPlan* plan() const = 0;
    // The common one, or the only one; then those of robots with projects of their own, in the
    // order of the file.
    virtual std::vector<RunBus> buses() { return {{session(), plan()}}; }
    // Of a recording of a real bus: what was on it; else nullptr. There is no session then.
    virtual const PastBus* past_bus() const { return nullptr; }
    // When the last thing of it was recorded.
    Time recorded_until() const { return end_; }
    const RunFile& about() const { return about_; }
    const std::vector<Input>& inputs() const { return inputs_; }
    // Who ended the run; empty: nobody so far.
    const std::optional<std::string>& ended_by() const { return ended_by_; }
    // A path of the folder as its name in the recording.
    std::string name_of(const std::string& path) const;
    // Where a file of the recording lies while it is run again.
    std::string path_of(const std::string& name) const { return folder_.path_of(name); }

protected:
    Rerun(RunFile about, UnpackedFolder folder)
        : about_(std::move(about)), folder_(std::move(folder)) {}
    // Before anything of it runs.
    virtual Status prepare() { return Status::done(); }
    // Those up to `from`, what is done there, and those that are done all the same.
    static std::vector<Input> other_inputs(std::vector<Input> recorded,
                                           const RerunOptions& options);
    // Whether each of them can be done: before run().
    Status check_inputs();
    // Does what went another way, or asks only whether it can be done.
    enum class Only : uint8_t { Ask, Do };
    virtual Status change(const ValueGiven& given, Only only);
    virtual Status change(const FileTookOver& other, Only only);
    virtual Status change(const Reseeded& drawn, Only only);
    // What a debugger of the plan is asked, and a new version of it.
    virtual void ask(const run::Request&) {}
    virtual void take(const PlanFiles&) {}
    // Of robots that have projects of their own: one member more of the check; empty: there are
    // none.
    virtual std::string check_of_robots(Time) const { return {}; }
    std::string check_by(const Recorder& recorder, Time at) const;
    // The input with which such a run ends.
    virtual InputWhat end_of_run() const = 0;
    // Whether the run goes on, was ended by somebody then, is recorded up to here, or is to end.
    enum class Then : uint8_t { GoOn, Aborted, Recorded, End };
    // At the end of an instant.
    Then after_instant(Time at, Recorder& recorder);
    // All that is due is done again. With Leave it stops where somebody ended the run.
    enum class Ends : uint8_t { Take, Leave };
    Then do_inputs(Recorder& recorder, Ends ends);
    // What came together, as the next.
    Then do_turn(Recorder& recorder);
    bool is_due();
    Then do_again(const Input& input, Recorder& recorder);
    template <typename Change>
    Then go_another_way(const Change& changed, Recorder& recorder);
    // It ended with its run, which the input done last says; then the last check comes after it.
    bool ends_whole() const;
    // The run is over, and the recorder goes.
    void leave(const Recorder& recorder, Time at) {
        last_check_ = check_by(recorder, at);
        recorder_ = nullptr;
    }
    bool is_of_studio() const { return about_.verb == kStudioVerb; }
    // What came from outside came between two instants, and is done there; else at the end of one.
    virtual bool comes_between_instants() const { return is_of_studio(); }

    RunFile about_;
    UnpackedFolder folder_;
    std::vector<Input> inputs_;
    size_t next_input_ = 0;
    std::optional<Time> until_;
    Time end_{};                // of what was recorded
    bool cut_ = false;          // it has no end: it is run again as far as it goes
    bool another_way_ = false;  // options.from
    Status changed_ = Status::done();
    std::vector<std::function<void(Time)>> looks_;
    std::function<void()> paused_end_;
    std::function<void(const sim::Act&)> told_of_act_;
    bool stopped_ = false;
    std::optional<std::string> ended_by_;  // who ended it then
    Recorder* recorder_ = nullptr;         // of this run(), while it goes on
    std::string last_check_;               // when it was over
    hub::LinkId outside_;                  // from where frames come again; 0: none came yet
};

}  // namespace vagus::record
