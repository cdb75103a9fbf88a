// The workbench of a robot that works by itself: what nobody's page asks for.
#include <algorithm>

#include "serve/json.hpp"
#include "serve/workbench/missing_nodes.hpp"
#include "serve/workbench/workbench.hpp"
#include "session/known_nodes.hpp"

namespace vagus::serve {

namespace {

constexpr uint32_t kNobody = 0;  // in the place of a client: the server itself

}  // namespace

aesl::Target Workbench::target_of(const std::string& name, uint16_t id) const {
    const auto live = target_.target_of(name, id);
    return live ? *live : session::known_node(name);
}

Scripts::TargetOf Workbench::targets_now() const {
    return [nodes = target_.described()](const std::string& name, uint16_t id) {
        const auto live = target_among(nodes, name, id);
        return live ? *live : session::known_node(name);
    };
}

std::vector<std::string> Workbench::missing_nodes() const {
    std::vector<std::string> missing;
    if (!bus_ || !project_) return missing;
    const std::vector<std::string>& files = project_->scripts;
    for (const ScriptPart& part : scripts_.parts()) {
        if (std::find(files.begin(), files.end(), part.file) == files.end()) continue;
        if (!target_.target_of(part.node, part.node_id)) missing.push_back(part.node);
    }
    if (missing.empty() && !target_.all_described(1)) missing.push_back(kAnyNode);
    return missing;
}

void Workbench::start_run(std::function<void(const std::string& why)> done) {
    failed_loads_.clear();
    start(
        Call(Json::object(), kNobody, [this, done = std::move(done)](const Call::Outcome& outcome) {
            const auto* problem = std::get_if<Problem>(&outcome);
            done(problem ? problem->what : failed_loads_);
        }));
}

void Workbench::stop_run(const life::Cause& cause, std::function<void()> done) {
    stop(Call(Json::object(), kNobody, [done = std::move(done)](const Call::Outcome&) { done(); }),
         cause);
}

std::string Workbench::how_plan_is() const {
    if (!project_ || project_->plan.empty()) return "";
    if (life_.plan_runs()) return "its plan runs";
    return "its plan is over: " + ends_.last_result();
}

Figures Workbench::figures() const {
    Figures figures{.runs = runs_,
                    .deaths = run_.deaths(),
                    .plan_runs = run_.plan_runs(),
                    .seconds = clock(),
                    .speed = run_.measured_speed(),
                    .late_checks = run_.late_checks(),
                    .target = target_.counts(),
                    .clients = desk_.clients().connected(),
                    .ends = ends_.counts(),
                    .results = ends_.results(),
                    .missing_stops = ends_.missing()};
    if (const auto percent = run_.load()) figures.bus_load = *percent / 100;
    return figures;
}

}  // namespace vagus::serve
