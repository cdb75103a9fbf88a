#include "record/bus_rerun.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "aesl/project.hpp"
#include "base/file.hpp"
#include "base/seconds.hpp"
#include "embed/bus_check.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/plan_versions.hpp"
#include "embed/prepared_run.hpp"
#include "record/damage.hpp"
#include "record/past_bus.hpp"
#include "record/past_run.hpp"
#include "session/toolboxes.hpp"

namespace vagus::record {

namespace {

class BusRerun final : public Rerun {
public:
    BusRerun(RunFile about, UnpackedFolder folder, const RerunOptions& options, Time end)
        : Rerun(std::move(about), std::move(folder)) {
        until_ = options.until;
        end_ = end;
    }

    Status read(const mcap::Reader& reader) {
        cut_ = !is_whole(reader);
        aesl::Project project;
        if (!about_.project.empty()) {
            const std::string text = TRY(read_file(folder_.path_of(about_.project)));
            project = TRY(aesl::parse_project(text, about_.project));
        }
        names_.emplace(project.common, about_.project);
        past_ = TRY(PastBus::read(reader, std::move(project), about_.project,
                                  until_.value_or(Time::max())));
        ended_by_ = past_->ended_by();
        cut_ = cut_ || past_->is_cut();
        if (about_.plan.empty()) return Status::done();
        std::vector<std::string> toolboxes;
        for (const std::string& one : about_.toolboxes) toolboxes.push_back(folder_.path_of(one));
        TRY(session::add_toolboxes(library_, parts_, toolboxes));
        plan_ = embed::LoadedPlan::from_file(folder_.path_of(about_.plan), library_);
        if (!plan_->ok()) {
            return Error{Code::BadInput, embed::format_findings(plan_->findings())};
        }
        versions_.emplace(*plan_, folder_.path_of(about_.plan));
        if (!about_.from.empty()) plan_ = TRY(plan_->starting_at(about_.from));
        TRY(embed::check_names(*names_, *plan_));
        parts_.bus = &nodes_;
        return take_options();
    }

    Result<Ended> run(Tape& tape) override {
        if (!plan_ || past_->never_began()) return Ended{end_, "", ""};
        const uint16_t trace = tape.declare({.name = std::string(kTraceTopic)});
        const auto tell = [&](const std::vector<PastBus::Told>& lines) {
            for (const PastBus::Told& one : lines) tape.put(trace, one.at, one.text);
        };
        Time last{};
        run::VirtualTime* running = nullptr;
        how_.on_trace = [&](const plan::TraceEvent& event) {
            const std::vector<PastBus::Told> told = past_->take(event);
            tell(told);
            if (told.empty()) return running->abort();
            plan::TraceEvent then = event;
            last = then.at = told.back().at;
            for (const auto& listener : listeners_) listener(then);
            if (stopped_) running->abort();
        };
        run::VirtualTime run(plan_->graph(), library_, how_);
        running = &run;
        past_->on_saved([&](const PlanFiles& files) { take(files, run); });
        past_->join(run, nodes_);
        const run::Ended ended = run.run();
        tell(past_->rest());
        return Ended{last, std::string(plan::name_of(ended.result)), ended.message};
    }

    void listen(std::function<void(const plan::TraceEvent&)> listener) override {
        listeners_.push_back(std::move(listener));
    }
    void pass_over(std::function<bool(const run::Raising&)> passes) override {
        passes_ = std::move(passes);
    }
    session::SimSession* session() override { return nullptr; }
    session::PlanWorld* plan_world() override { return nullptr; }
    const embed::LoadedPlan* plan() const override { return plan_ ? &*plan_ : nullptr; }
    const PastBus* past_bus() const override { return past_.get(); }

private:
    InputWhat end_of_run() const override { return RecordingEnds{}; }

    // One that was refused is refused again.
    void take(const PlanFiles& files, run::VirtualTime& run) {
        std::vector<std::string> saved;
        for (const auto& [name, text] : files.texts) (void)folder_.add(name, text).ok();
        for (const std::string& name : files.saved) saved.push_back(folder_.path_of(name));
        const embed::PlanVersions::Made made = versions_->read(saved);
        if (!made.plan.ok()) return;
        versions_->hand_in(made);
        if (run.do_as_asked(run::TakeVersion{made.next}).ok()) {
            (void)versions_->took(made.plan.graph());
        } else {
            versions_->refused(made.plan.graph());
        }
    }

    Status take_options() {
        if (!about_.seed.empty()) how_.seed = TRY(embed::parse_seed(about_.seed));
        for (const std::string& text : about_.set) {
            how_.set.push_back(TRY(embed::parse_set(plan_->graph().plans.front(), text)));
        }
        // A plan that decides otherwise may go on, but nothing is known of that.
        const Time over = cut_ ? end_ + Duration(1) : end_ + kInStepWithin;
        how_.max_time = std::min(over, until_ ? *until_ + Duration(1) : over);
        if (!about_.max_time.empty()) {
            const auto max = TRY(embed::parse_max_time(about_.max_time));
            how_.max_time = std::min(*how_.max_time, max.value_or(Time::max()));
        }
        how_.surroundings = past_.get();
        how_.may_emit = [this](const run::BusEvent& event) { return names_->may_emit(event); };
        how_.passes_over = [this](const run::Raising& raising) {
            return past_->passes_over(raising) || (passes_ && passes_(raising));
        };
        return Status::done();
    }

    toolbox::BusNodes nodes_;
    toolbox::Parts parts_;  // before the library, whose code looks at them
    run::CodeLibrary library_;
    std::optional<session::BusNames> names_;
    std::optional<embed::LoadedPlan> plan_;
    std::optional<embed::PlanVersions> versions_;
    std::unique_ptr<PastBus> past_;
    run::RunOptions how_;
    std::vector<std::function<void(const plan::TraceEvent&)>> listeners_;
    std::function<bool(const run::Raising&)> passes_;
};

}  // namespace

Result<std::unique_ptr<Rerun>> open_bus_rerun(const mcap::Reader& reader, RunFile about,
                                              const RerunOptions& options) {
    if (options.from) {
        return Error{Code::Refused,
                     fmt::format("--from {}: {} is a recording of a real bus: from an instant on "
                                 "its nodes cannot do anything else than they did; ask what the "
                                 "plan decides with another file, by --with FILE",
                                 seconds_text(*options.from), reader.name())};
    }
    UnpackedFolder folder = TRY(UnpackedFolder::make());
    for (const mcap::Attachment& one : reader.attachments()) {
        const auto instead = options.with.find(one.name);
        TRY(folder.add(one.name, instead == options.with.end()
                                     ? one.data
                                     : std::string_view(instead->second)));
    }
    auto made =
        std::make_unique<BusRerun>(std::move(about), std::move(folder), options, end_of(reader));
    TRY(made->read(reader));
    return std::unique_ptr<Rerun>(std::move(made));
}

}  // namespace vagus::record
