#include "trial/continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/json.hpp"
#include "embed/loaded_plan.hpp"
#include "embed/robots_watcher.hpp"
#include "record/causes.hpp"
#include "record/file_tape.hpp"
#include "session/plan_world.hpp"
#include "wire/messages.hpp"

namespace vagus::trial {

namespace {

Error cannot(const mcap::Reader& reader, const std::string& why) {
    return {Code::Refused, reader.name() + ": " + why};
}

Error at_condition(std::string_view condition, const Error& error) {
    return {error.code, fmt::format("the condition {}: {}", json_quote(condition), error.what)};
}

bool is_breakpoint(const wire::Frame& frame) {
    return frame.type == static_cast<uint16_t>(wire::MessageType::BreakpointSet);
}

// What a person did at an instant is done at it in each continuation. What halts a run where its
// plan or a script comes to a place halts another one elsewhere, and nobody is there to let it go.
bool halts_at_a_place(const record::Input& input) {
    if (const auto* const frame = std::get_if<wire::Frame>(&input.what)) {
        return is_breakpoint(*frame);
    }
    const auto* const asked = std::get_if<run::Request>(&input.what);
    return asked != nullptr && (std::holds_alternative<run::AddBreakpoint>(*asked) ||
                                std::holds_alternative<run::Step>(*asked) ||
                                std::holds_alternative<run::StepEvent>(*asked));
}

Status check_can_continue(const mcap::Reader& reader, record::Rerun& rerun) {
    if (rerun.about().is_of_bus()) {
        return cannot(reader,
                      "is of a real bus, whose nodes cannot be continued from an instant; record a "
                      "run beside a world, with `vagus plan run --world`");
    }
    if (rerun.session() == nullptr) {
        return cannot(reader,
                      "is of a plan without a world, which cannot be continued from an instant; "
                      "record one that runs beside a world, with `vagus plan run --world`");
    }
    if (std::ranges::any_of(rerun.inputs(), halts_at_a_place)) {
        return cannot(reader,
                      "is of a run that somebody stepped or stopped at a breakpoint, which would "
                      "be elsewhere in another run; run it without breakpoints and steps, and ask "
                      "again");
    }
    return Status::done();
}

// Of the plan on that bus.
class LinesOfRobot final : public embed::RobotsWatcher {
public:
    LinesOfRobot(size_t bus, std::function<void(const plan::TraceEvent&)> told)
        : bus_(bus), told_(std::move(told)) {}
    void line(size_t robot, const plan::TraceEvent& event) override {
        if (robot + 1 == bus_) told_(event);
    }

private:
    size_t bus_;
    std::function<void(const plan::TraceEvent&)> told_;
};

}  // namespace

Result<std::unique_ptr<Continued>> Continued::open(const mcap::Reader& reader,
                                                   std::string_view condition,
                                                   std::optional<Time> until,
                                                   const std::string& robot) {
    Result<Condition> parsed = Condition::parse(condition);
    if (!parsed.ok()) return at_condition(condition, parsed.error());
    auto rerun = TRY(record::Rerun::open(reader, {}));
    TRY(check_can_continue(reader, *rerun));
    // make_unique cannot reach the constructor.
    std::unique_ptr<Continued> made(
        new Continued(reader, std::move(parsed.value()), std::move(rerun)));
    TRY(made->choose_bus(robot));
    made->until_ = until.value_or(made->rerun_->recorded_until());
    const Status bound = made->bind();
    if (!bound.ok()) return at_condition(condition, bound.error());
    return made;
}

// Where robots have projects of their own, each is another world for a condition.
Status Continued::choose_bus(const std::string& robot) {
    const std::vector<record::RunBus> buses = rerun_->buses();
    bus_ = buses.front();
    const bool fleet = buses.size() > 1;
    if (!fleet && robot.empty()) return Status::done();
    if (!fleet) {
        return Error{Code::BadInput,
                     fmt::format("--robot {}: {} is of a run with one bus and at most one plan, so "
                                 "its condition needs no robot; leave --robot out",
                                 robot, reader_.name())};
    }
    const sim::World& world = rerun_->session()->world();
    if (robot.empty()) {
        return Error{Code::BadInput,
                     fmt::format("{}: --turning-point needs to know whose condition it is, for {} "
                                 "robots of this run have projects of their own; say so, as "
                                 "--robot {}",
                                 reader_.name(), buses.size() - 1, buses[1].robot)};
    }
    const auto found = world.find_robot(robot);
    if (!found) {
        return Error{Code::NotFound, sim::no_robot(world.definition(), robot, " in this run")};
    }
    for (size_t i = 1; i < buses.size(); ++i) {
        if (buses[i].robot == robot) bus_index_ = i;
    }
    bus_ = buses[bus_index_];
    bus_.number = found->number;
    return Status::done();
}

Status Continued::bind() {
    if (bus_.plan != nullptr) return condition_.bind(bus_.plan->graph(), true);
    no_plan_.plans.emplace_back();
    return condition_.bind_without_plan();
}

Result<RunEnd> Continued::as_it_was() {
    record::NullTape tape;
    return run(tape, Ends::WhenItCame);
}

Result<std::optional<RunEnd>> Continued::from_each(Time at, std::span<const uint64_t> seeds,
                                                   const std::function<bool()>& split) {
    TRY(rerun_->continue_from(at, seeds.front(), until_));
    bool divided = false, is_copy = false;
    const auto divide = [&] {
        divided = true;
        for (const uint64_t seed : seeds) {
            if (!split()) continue;
            is_copy = true;
            return rerun_->draw_from(seed);
        }
        rerun_->stop();
    };
    // Before the first instant nobody looks.
    if (at == Time{}) divide();
    if (divided && !is_copy) return std::optional<RunEnd>();
    rerun_->each_instant([&](Time now) {
        if (now >= at && !divided) divide();
    });
    record::NullTape tape;
    const RunEnd end = TRY(run(tape, Ends::WhenItCame));
    return is_copy ? std::optional(end) : std::nullopt;
}

Status Continued::record(const Continuation& start, const std::string& file) {
    TRY(rerun_->continue_from(start.at, start.seed, until_));
    const auto tape = TRY(record::FileTape::create(file, record::Pace::Waits));
    for (const mcap::Attachment& one : reader_.attachments()) tape->attach(one.name, one.data);
    (void)TRY(run(*tape, Ends::AtItsEnd));
    return tape->end();
}

Result<RunEnd> Continued::run(record::Tape& tape, Ends ends) {
    const ReadWorld world = rerun_->plan_world() != nullptr
                                ? read_world_of(rerun_->plan_world())
                                : ReadWorld{bus_.session, sim::RobotId{std::max(1u, bus_.number)}};
    Awaited awaited(condition_, bus_.plan != nullptr ? bus_.plan->graph() : no_plan_, world);
    const auto line = [&awaited](const plan::TraceEvent& event) { awaited.line(event); };
    LinesOfRobot lines(bus_index_, line);
    bus_index_ == 0 ? rerun_->listen(line) : rerun_->watch_robots(&lines);
    if (bus_.plan == nullptr) {
        hear_events(*bus_.session, [&](Time at, const auto& name) { awaited.event(at, name); });
    }
    rerun_->each_instant([&](Time at) {
        awaited.instant();
        const bool enough = at >= until_ || awaited.is_over();
        if (enough && ends == Ends::WhenItCame) rerun_->stop();
    });
    const record::Rerun::Ended ended = TRY(rerun_->run(tape));
    TRY(awaited.trouble());
    return RunEnd{.came = awaited.came(), .end = std::min(ended.at, until_)};
}

std::string format_run_end(const RunEnd& end) {
    return fmt::format("{} {}", end.came ? end.came->count() : -1, end.end.count());
}

RunEnd read_run_end(std::string_view text) {
    int64_t came = -1, end = 0;
    const char* const last = text.data() + text.size();
    const auto read = std::from_chars(text.data(), last, came);
    if (read.ptr != last) std::from_chars(read.ptr + 1, last, end);
    return {.came = came < 0 ? std::nullopt : std::optional(Time(came)), .end = Time(end)};
}

}  // namespace vagus::trial
