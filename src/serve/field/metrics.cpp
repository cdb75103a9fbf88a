#include "serve/field/metrics.hpp"

#include <fmt/format.h>

namespace vagus::serve {

namespace {

class Text {
public:
    void family(const char* name, const char* type, const char* help) {
        text_ += fmt::format("# HELP {0} {1}\n# TYPE {0} {2}\n", name, help, type);
    }
    template <typename Number>
    void sample(const std::string& name, Number value) {
        text_ += fmt::format("{} {}\n", name, value);
    }
    // Of one number.
    template <typename Number>
    void one(const char* name, const char* type, const char* help, Number value) {
        family(name, type, help);
        sample(name, value);
    }
    std::string take() { return std::move(text_); }

private:
    std::string text_;
};

void add_runs(Text& text, const Figures& figures) {
    text.one("vagus_runs_total", "counter", "Runs that were started.", figures.runs);
    text.one("vagus_run_deaths_total", "counter", "Processes of runs that died.", figures.deaths);
    text.family("vagus_run_ends_total", "counter", "Ends of runs by why they came.");
    for (const auto& [why, count] : figures.ends) {
        text.sample(fmt::format("vagus_run_ends_total{{why=\"{}\"}}", why), count);
    }
    text.family("vagus_plan_results_total", "counter", "Plans that have ended, by their results.");
    for (const auto& [result, count] : figures.results) {
        text.sample(fmt::format("vagus_plan_results_total{{result=\"{}\"}}", result), count);
    }
    text.one("vagus_unstopped_nodes", "gauge",
             "Nodes that were not read back as stopped when the last run ended.",
             figures.missing_stops);
    text.one("vagus_plan_running", "gauge", "1 while a plan runs.", figures.plan_runs ? 1 : 0);
    text.one("vagus_run_seconds", "gauge", "Clock of the run.", figures.seconds);
    text.one("vagus_run_speed_ratio", "gauge",
             "Speed of a simulation against the wall clock, measured.", figures.speed);
    text.one("vagus_late_checks_total", "counter",
             "Checks of supervisors that began late, in this run.", figures.late_checks);
}

void add_bus(Text& text, const Figures& figures) {
    const TargetCounts& target = figures.target;
    text.one("vagus_events_total", "counter", "Events of nodes, since the target was connected.",
             target.events);
    text.one("vagus_lost_frames_total", "counter",
             "Frames that were dropped, since the target was connected.", target.lost);
    text.family("vagus_nodes", "gauge", "Nodes that are there, by what they do.");
    text.sample("vagus_nodes{state=\"running\"}", target.running);
    text.sample("vagus_nodes{state=\"paused\"}", target.nodes - target.running);
    if (!figures.bus_load) return;
    text.one("vagus_bus_load_ratio", "gauge", "Load of the bus in the last second, 0 to 1.",
             *figures.bus_load);
}

void add_service(Text& text, const ServiceFigures& service) {
    text.one("vagus_ready", "gauge", "1 when everything runs that should.", service.ready ? 1 : 0);
    text.one("vagus_missing_nodes", "gauge", "Nodes that are waited for.", service.missing);
    text.one("vagus_lateness_seconds", "gauge",
             "By how much the server itself came late, at worst in the last second.",
             service.late_worst);
    text.one("vagus_deployed_version", "gauge",
             "Version of the project that is served; 0: the folder as it was given.",
             service.deployed);
    text.family("vagus_deployments_total", "counter", "Deployments by what came of them.");
    text.sample("vagus_deployments_total{result=\"started\"}", service.deployments);
    text.sample("vagus_deployments_total{result=\"refused\"}", service.refused);
    text.sample("vagus_deployments_total{result=\"rolled_back\"}", service.rolled_back);
}

}  // namespace

std::string metrics_text(const Figures& figures, const ServiceFigures& service) {
    Text text;
    text.family("vagus_info", "gauge", "The program.");
    text.sample(fmt::format("vagus_info{{version=\"{}\"}}", service.version), 1);
    add_service(text, service);
    add_runs(text, figures);
    add_bus(text, figures);
    text.one("vagus_clients", "gauge", "Pages and programs that are connected.", figures.clients);
    return text.take();
}

}  // namespace vagus::serve
