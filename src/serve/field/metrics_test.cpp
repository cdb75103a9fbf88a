#include "serve/field/metrics.hpp"

#include <gmock/gmock.h>

namespace vagus::serve {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Metrics, EachFigureHasItsHelpItsTypeAndItsValue) {
    const Figures figures{.runs = 3,
                          .deaths = 1,
                          .plan_runs = true,
                          .seconds = 1.5,
                          .late_checks = 7,
                          .target = {.events = 12, .lost = 2, .nodes = 4, .running = 3},
                          .bus_load = 0.25,
                          .clients = 2,
                          .ends = {{"error", 2}, {"stop", 0}},
                          .results = {{"Error", 2}},
                          .missing_stops = 1};
    const std::string text = metrics_text(
        figures, {.version = "0.1.0", .ready = true, .late_worst = 0.002, .deployed = 5});
    EXPECT_THAT(text, HasSubstr("# HELP vagus_runs_total Runs that were started.\n"
                                "# TYPE vagus_runs_total counter\n"
                                "vagus_runs_total 3\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_info{version=\"0.1.0\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_nodes{state=\"running\"} 3\n"
                                "vagus_nodes{state=\"paused\"} 1\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_bus_load_ratio 0.25\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_lateness_seconds 0.002\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_deployed_version 5\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_clients 2\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_run_ends_total{why=\"error\"} 2\n"
                                "vagus_run_ends_total{why=\"stop\"} 0\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_plan_results_total{result=\"Error\"} 2\n"));
    EXPECT_THAT(text, HasSubstr("\nvagus_unstopped_nodes 1\n"));
    EXPECT_TRUE(text.ends_with("\n"));
}

TEST(Metrics, WhatIsNotMeasuredIsNotShown) {
    EXPECT_THAT(metrics_text({}, {}), Not(HasSubstr("bus_load")));
}

}  // namespace
}  // namespace vagus::serve
