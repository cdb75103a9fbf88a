// Ten metres ahead, watching the bumper: a plan that is still at it when a signal comes.
#include <templates/drive.hpp>

#include "embed/command_line.hpp"
#include "embed/plan_code.hpp"

namespace {

vagus::embed::Plan make_Drive() {
    using vagus::embed::Plan;
    using vagus::templates::drive::CheckTouchSensor, vagus::templates::drive::Forward;

    Forward ahead("ahead", {.distance = "1000"});
    CheckTouchSensor touch("touch");

    Plan plan("Drive", {"drive"});
    plan.start_with(ahead);
    plan.after(ahead, Forward::ForwardSuccessful, Plan::kTerminate);
    plan.during(ahead, touch, CheckTouchSensor::TouchSensorPressed, Plan::kTerminate);
    return plan;
}

}  // namespace

int main(int argc, char** argv) {
    return vagus::embed::run_main(&make_Drive, argc, argv);
}
