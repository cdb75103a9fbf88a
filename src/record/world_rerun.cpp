#include "record/world_rerun.hpp"

#include <optional>
#include <string>
#include <utility>

#include "base/file.hpp"
#include "embed/prepared_run.hpp"
#include "embed/robots_run.hpp"
#include "record/robot_recorders.hpp"
#include "session/sim_session.hpp"

namespace vagus::record {

namespace {

class WorldRerun final : public Rerun {
public:
    WorldRerun(RunFile about, UnpackedFolder folder) : Rerun(std::move(about), std::move(folder)) {}

    Status prepare() override {
        const std::string world = folder_.path_of(about_.world);
        session::SimOptions options;
        options.world = TRY(embed::world_options({about_.seed, about_.poses, about_.chaos}));
        if (is_of_studio()) {
            own_ = std::make_unique<session::SimSession>(TRY(session::open_sim(world, options)));
        } else {
            robots_ = TRY(embed::RobotsRun::open({.world = world, .sim = options}));
        }
        for (const std::string& one : about_.loads) {
            const std::string path = folder_.path_of(one);
            const std::string text = TRY(read_file(path));
            session()->load(path, text);
        }
        if (is_of_studio()) {
            (void)own_->settle();
            own_->world().stops_with_nodes();
        }
        if (about_.verb == kTestVerb) (void)robots_->buses().settle();
        return check_inputs();
    }

    Result<Ended> run(Tape& tape) override {
        Result<Ended> ended = run_to_its_end(tape);
        watch_robots(nullptr);  // plans that go with the run are nobody's
        return ended;
    }

    void listen(std::function<void(const plan::TraceEvent&)>) override {}
    void watch_robots(embed::RobotsWatcher* watcher) override {
        if (robots_) robots_->watch(watcher);
    }
    session::SimSession* session() override {
        return own_ ? own_.get() : &robots_->buses().common();
    }
    session::PlanWorld* plan_world() override { return nullptr; }
    const embed::LoadedPlan* plan() const override { return nullptr; }
    std::vector<RunBus> buses() override {
        std::vector<RunBus> all = Rerun::buses();
        if (!robots_) return all;
        const auto& robots = robots_->buses().robots();
        for (size_t i = 0; i < robots.size(); ++i) {
            all.push_back({robots[i].session.get(), robots_->plan(i), robots[i].name,
                           robots[i].id.number, robots[i].project.fleet.name});
        }
        return all;
    }

private:
    Result<Ended> run_to_its_end(Tape& tape) {
        Recorder recorder(tape, format_run(about_));
        recorder_ = &recorder;
        recorder.follow(*session());
        if (robots_) {
            recorded_.emplace(tape, *robots_);
            TRY(robots_->start());
        }
        Then then = do_inputs(recorder, Ends::Take);
        recorder.after_instant([&](Time at) {
            if (then == Then::GoOn) then = after_instant(at, recorder);
        });
        while (then == Then::GoOn && session()->now() < end_) {
            robots_ ? robots_->step(sim::kNodeStep) : own_->step(sim::kNodeStep);
            const bool next = then == Then::GoOn && comes_between_instants();
            if (next) then = do_inputs(recorder, Ends::Take);
        }
        TRY(changed_);
        const bool whole = then == Then::Recorded && ends_whole();
        if (whole || (another_way_ && !stopped_)) {
            recorder.end(session()->now());
            if (recorded_) recorded_->end(session()->now());
        }
        leave(recorder, session()->now());
        recorded_.reset();
        return Ended{session()->now(), "", ""};
    }

    InputWhat end_of_run() const override { return RecordingEnds{}; }
    // Where robots have projects an instant is over when all their buses have had it.
    bool comes_between_instants() const override {
        return is_of_studio() || !about_.robots.empty();
    }

    using Rerun::change;
    Status change(const Reseeded& drawn, Only only) override {
        if (!robots_) return Rerun::change(drawn, only);
        if (only == Only::Do) robots_->reseed(drawn.seed);
        return Status::done();
    }

    std::string check_of_robots(Time at) const override {
        return recorded_ && !about_.robots.empty() ? recorded_->check_member(at) : "";
    }

    std::unique_ptr<embed::RobotsRun> robots_;
    std::optional<RobotRecorders> recorded_;  // during run()
    std::unique_ptr<session::SimSession> own_;
};

}  // namespace

std::unique_ptr<Rerun> make_world_rerun(RunFile about, UnpackedFolder folder) {
    return std::make_unique<WorldRerun>(std::move(about), std::move(folder));
}

}  // namespace vagus::record
