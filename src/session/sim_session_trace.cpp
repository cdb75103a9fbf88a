// What a session tells of its world: the lines of its trace, and the faults of its run.
#include "session/sim_session.hpp"
#include "session/trace.hpp"

namespace vagus::session {

void SimSession::trace_happenings(size_t first) {
    for (const sim::Happening& happening : world_->happenings().subspan(first)) {
        const bool on_bus = std::holds_alternative<sim::Emitted>(happening.what) ||
                            std::holds_alternative<sim::Fault>(happening.what);
        if (!on_bus) {
            trace_of_body(happening);
        } else if (is_of_its_bus(happening.robot)) {
            trace_on_bus(happening);
        }
    }
}

void SimSession::trace_on_bus(const sim::Happening& happening) {
    if (const auto* sent = std::get_if<sim::Emitted>(&happening.what)) {
        const auto& events = network_.common().events;
        const std::string event =
            sent->event < events.size() ? events[sent->event].name : std::to_string(sent->event);
        trace_ += trace_line(happening.at, "event")
                      .number("node", happening.node)
                      .text("name", event)
                      .words("args", sent->arguments)
                      .done();
    } else if (const auto* fault = std::get_if<sim::Fault>(&happening.what)) {
        trace_ += trace_line(happening.at, "fault")
                      .number("node", happening.node)
                      .text("what", fault->what)
                      .number("pc", fault->pc)
                      .done();
    }
}

// The session of the common bus tells it of all robots.
void SimSession::trace_of_body(const sim::Happening& happening) {
    if (robot_) return;
    if (const auto* const told = std::get_if<sim::ChaosNote>(&happening.what)) {
        trace_ += TraceLine(happening.at, "chaos")
                      .text("what", told->what)
                      .text("state", told->begins ? "begins" : "ends")
                      .done();
        return;
    }
    const std::string& name = world_->definition().robots[happening.robot.number - 1].name;
    if (const auto* pose = std::get_if<sim::PoseNote>(&happening.what)) {
        trace_ += TraceLine(happening.at, "pose")
                      .text("robot", name)
                      .real("x", pose->pose.at.x)
                      .real("y", pose->pose.at.y)
                      .real("angle", pose->pose.angle)
                      .done();
    } else if (const auto* contact = std::get_if<sim::Contact>(&happening.what)) {
        trace_ += TraceLine(happening.at, "contact")
                      .text("robot", name)
                      .text("with", contact->with)
                      .done();
    }
}

// ---- faults ----

void SimSession::open_chaos() {
    const std::string main(sim::kMainComputer);
    auto chaos = std::make_unique<sim::HostChaos>(
        world_->chaos(), robot_ ? robot_name_ + "/" + main : main, world_->chaos_seed());
    if (!chaos->empty()) chaos_ = std::move(chaos);
}

// The session of the common bus tells it of all.
void SimSession::tell_chaos() {
    if (robot_) return;
    for (const sim::Happening& happening : world_->happenings()) {
        const auto* const told = std::get_if<sim::ChaosNote>(&happening.what);
        if (told != nullptr) note(NoteKind::Chaos, told->what);
    }
}

}  // namespace vagus::session
