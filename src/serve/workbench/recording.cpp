// What the history is told, by the run and by the robot, and when it begins again.
#include "serve/workbench/workbench.hpp"

#include <filesystem>

#include "base/time.hpp"

namespace vagus::serve {

// Seconds of what is kept: those of a simulation, or since the bus or the plan on it began.
double Workbench::history_clock() const {
    if (!bus_) return run_.time();
    return seconds_of(now_ - history_since_);
}

void Workbench::record_history() {
    history_.set_doc_of(
        [this](const std::string& file) { return project_ ? project_->doc_of(file) : file; });
    run_.on_told({
        .plan = [this](const talk::PlanVersion& one) { history_.plan(one.number, one.plans); },
        .trace = [this](const std::string& line) { history_.trace(line); },
        .records = [this](const std::string& bytes) { history_.records(bytes); },
    });
    // A simulation stamps what it tells; on a bus the time is that of hearing it.
    const auto at = [this](double t) { return bus_ ? history_clock() : t; };
    target_.on_told({
        .happening =
            [this, at](const Json& one) {
                history_.happening(one, at(one["t"]));
                if (one["kind"] == "loaded") record_script(one["node"], one["name"]);
            },
        .run = [this] { return history_.run(); },
        .node_state = [this, at](double t, uint16_t node, const std::string& state,
                                 int line) { history_.node_state(at(t), node, state, line); },
        // Of a simulation the records tell all words.
        .words =
            [this](double, uint16_t node, uint16_t address, std::span<const int16_t> values) {
                if (bus_) history_.words(history_clock(), node, address, values);
            },
        .unwatched =
            [this](double, uint16_t node, uint16_t address, uint16_t count) {
                if (bus_) history_.unwatched(history_clock(), node, address, count);
            },
    });
}

void Workbench::record_plan(const RunOrder& order) {
    History::Beginning beginning{.name = order.plan.empty() ? order.world : order.plan};
    beginning.name = beginning.name.substr(beginning.name.rfind('/') + 1);
    history_.begin(std::move(beginning));
}

// A run that cannot be recorded goes all the same.
void Workbench::record_run(RunOrder& order) {
    auto path = recordings_.next();
    if (!path.ok()) return say("warning", "this run is not recorded: " + path.error().what);
    order.recording = std::move(path.value());
}

// What the nodes were loaded with is among the frames; this is for names and lines.
void Workbench::record_script(uint16_t node, const std::string& name) {
    if (bus_ || !project_) return;
    const ScriptPart* const part = scripts_.for_node(name, node);
    const auto text = part ? files_.text(part->file) : Error{Code::NotFound, ""};
    if (text.ok()) run_.script_loaded(node, project_->real(part->file), text.value());
}

Result<std::string> Workbench::recording_of_run() const {
    if (bus_) {
        return Error{Code::Unavailable,
                     "this is asked of a recording, and the run of a robot on a bus is not "
                     "recorded; choose Simulator"};
    }
    const std::string path = recordings_.of_run(run_.time() > 0);
    std::error_code failed;
    if (!path.empty() && std::filesystem::exists(path, failed)) return path;
    return Error{Code::Unavailable,
                 "nothing has run yet, so there is nothing to ask about; Run "
                 "starts it"};
}

void Workbench::record_bus() {
    history_since_ = now_;
    History::Beginning beginning{.kind = "bus", .name = project_ ? project_->target : ""};
    history_.forget();
    history_.begin(std::move(beginning));
}

}  // namespace vagus::serve
