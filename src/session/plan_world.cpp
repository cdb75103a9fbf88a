#include "session/plan_world.hpp"

namespace vagus::session {

namespace {

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
    return text;
}

// The scripts run, or the Error says which do not and why.
Status settle(SimSession& session, const std::string& path) {
    const bool settled = session.settle();
    const std::vector<std::string> mistakes = session.mistakes();
    if (!mistakes.empty()) return Error{Code::BadInput, joined(mistakes)};
    for (const Note& note : session.take_notes()) {
        if (note.kind == NoteKind::Trouble) return Error{Code::Refused, path + ": " + note.text};
        if (note.kind == NoteKind::Fault) return Error{Code::Refused, note.text};
    }
    if (settled) return Status::done();
    return Error{Code::Timeout, path +
                                    ": a robot does not take its script, although the run has "
                                    "not begun; let its script begin without waiting"};
}

}  // namespace

Result<std::unique_ptr<PlanWorld>> PlanWorld::open(const PlanWorldOptions& options,
                                                   toolbox::BusNodes& nodes) {
    SimOptions how;
    how.world.seed = options.seed;
    how.traced = options.traced;
    how.heard = true;
    SimSession session = TRY(open_sim(options.path, how));
    TRY(settle(session, options.path));
    BusNames names(session.common(), "the scripts of " + options.path);
    // make_unique cannot reach the constructor.
    return std::unique_ptr<PlanWorld>(new PlanWorld(std::move(session), std::move(names), nodes));
}

PlanWorld::PlanWorld(SimSession session, BusNames names, toolbox::BusNodes& nodes)
    : session_(std::move(session)),
      camera_(session_.world()),
      names_(std::move(names)),
      ears_(nodes) {
    (void)hear();  // who is there; what scripts said before time 0 is not for the plan
}

void PlanWorld::join(run::RunOptions& options) {
    options.surroundings = this;
    options.may_emit = [this](const run::BusEvent& event) { return names_.may_emit(event); };
}

void PlanWorld::emit(Time at, const run::BusEvent& event) {
    // Refused is only what a supervisor emits as it stops: may_emit() was not asked.
    (void)session_.emit(event.name, event.arguments, at).ok();
}

std::vector<run::BusEvent> PlanWorld::begin() {
    if (before_each_) before_each_(next());
    session_.begin_instant();
    return hear();
}

std::vector<run::BusEvent> PlanWorld::hear() {
    std::vector<run::BusEvent> heard;
    for (const debug::Event& event : session_.take_heard()) {
        if (auto one = ears_.hear(event)) heard.push_back(std::move(*one));
    }
    return heard;
}

}  // namespace vagus::session
