// For tests of recordings: fifteen seconds of the wall follower, and a robot that counts.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "base/test_places.hpp"
#include "embed/prepared_run.hpp"
#include "record/plan_recording.hpp"
#include "session/toolboxes.hpp"

namespace vagus::serve {

// A node that counts, and says so, every so many milliseconds; the room that its robot stands in.
inline std::string counting_script(int every_ms) {
    return R"(<!DOCTYPE aesl-source><network>
<event size="1" name="beat"/>
<node nodeId="1" name="thymio-II">
var count = 0
timer.period[0] = )" +
           std::to_string(every_ms) + R"(
onevent timer0
count = count + 1
emit beat count
</node></network>)";
}
inline std::string room_with(const std::string& script) {
    return R"({"format": "vagus-world/1", "name": "Room", "size": [2, 2], "robots":
                [{"name": "alice", "type": "thymio2", "at": [1, 1], "node": 1,
                  "script": ")" +
           script + R"("}]})";
}

// Gives the path.
inline std::string record_wall(const std::string& path, const std::string& walldist) {
    FilesRead files;  // before they are
    toolbox::Parts parts;
    run::CodeLibrary library;
    EXPECT_TRUE(session::add_toolboxes(library, parts, {}).ok());
    const std::string plan = test::examples("follow-wall/WallFollow.plan.json");
    const embed::LoadedPlan loaded = embed::LoadedPlan::from_file(plan, library);
    embed::RunWords words;
    words.world = test::examples("follow-wall/hall.world.json");
    words.set = {"walldist=" + walldist};
    words.clock = "virtual";
    words.max_time = "15";
    const auto run = embed::PreparedRun::prepare(loaded, words, parts);
    EXPECT_TRUE(run.ok());
    record::RunFile about;
    about.verb = "plan run";
    about.plan = plan;
    about.world = words.world;
    about.set = words.set;
    about.max_time = words.max_time;
    const auto tape =
        record::PlanRecording::begin(path, about, files.all(), *run.value(), record::Pace::Waits);
    EXPECT_TRUE(tape.ok());
    EXPECT_TRUE(run.value()->run().ok());
    EXPECT_TRUE(tape.value()->end().ok());
    return path;
}

}  // namespace vagus::serve
