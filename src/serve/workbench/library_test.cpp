// What a person opens, and what is in the user's own folder.
#include "serve/workbench/library.hpp"
#include "base/test_folder.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "base/file.hpp"
#include "base/test_places.hpp"
#include "embed/loaded_plan.hpp"
#include "record/file_tape.hpp"
#include "serve/workbench/kept.hpp"
#include "serve/workbench/new_files.hpp"
#include "serve/workbench/opened.hpp"
#include "session/sim_session.hpp"
#include "session/toolboxes.hpp"

using namespace vagus;
using namespace vagus::serve;
namespace fs = std::filesystem;

namespace {

struct LibraryTest : testing::Test {
    Library library() const { return Library({data, test::examples()}); }
    static void write(const fs::path& file, std::string_view text) {
        fs::create_directories(file.parent_path());
        std::ofstream(file) << text;
    }
    const test::Folder data;
};

TEST_F(LibraryTest, ExamplesThatRunInTheSimulatorStandInTheirOrder) {
    const auto examples = library().examples();
    ASSERT_GE(examples.size(), 10u);
    EXPECT_EQ(examples[0]["id"], "follow-wall");
    EXPECT_EQ(examples[0]["name"], "Follow a wall");
    EXPECT_EQ(examples[0]["robot"], "Carbot");
    EXPECT_EQ(examples[1]["id"], "thymio");
    EXPECT_EQ(examples[1]["content"], "Script · 1 node");
    for (const auto& example : examples) EXPECT_NE(example["id"], "toolbox");  // no world
}

TEST_F(LibraryTest, AnExampleIsCopiedWithWhatItNames) {
    Library one = library();
    const auto copy = one.copy_of_example("follow-wall");
    ASSERT_TRUE(copy.ok()) << copy.error().what;
    EXPECT_EQ(copy.value(), (data / "projects/follow-wall/follow-wall").string());
    EXPECT_TRUE(fs::exists(data / "projects/follow-wall/carbot/carbot.aesl"));
    EXPECT_FALSE(fs::exists(data / "projects/follow-wall/thymio"));
    EXPECT_EQ(one.example_of(data / "projects/follow-wall"), "follow-wall");
    const auto opened = open_path(copy.value());
    ASSERT_TRUE(opened.ok()) << opened.error().what;
    EXPECT_EQ(opened.value().plan, "follow-wall/WallFollow.plan.json");
    EXPECT_EQ(opened.value().scripts, std::vector<std::string>{"carbot/carbot.aesl"});
    EXPECT_EQ(opened.value().root, data / "projects/follow-wall");
}

TEST_F(LibraryTest, ACopyIsTakenAgainUntilSomeoneHasWorkedInIt) {
    Library one = library();
    const std::string first = one.copy_of_example("thymio").value();
    EXPECT_EQ(one.copy_of_example("thymio").value(), first);
    write(fs::path(first) / "explore.aesl", "var mine\n");
    const std::string second = one.copy_of_example("thymio").value();
    EXPECT_EQ(second, (data / "projects/thymio-2/thymio").string());
    // What somebody worked in last goes on when asked for so.
    EXPECT_EQ(one.copy_of_example("thymio", true).value(), second);
    EXPECT_EQ(read_file(first + "/explore.aesl").value(), "var mine\n");
}

TEST_F(LibraryTest, WhatTheStudioKeepsBesideAnExampleIsNotCopied) {
    const fs::path examples = data / "examples";
    fs::copy(test::examples(), examples, fs::copy_options::recursive);
    write(examples / "thymio/.vagus/journal/explore.aesl", "typed");
    write(examples / "thymio/.vagus/versions/1/vagus.json", "{}");
    Library one({data, examples});
    const std::string copy = one.copy_of_example("thymio").value();
    EXPECT_TRUE(fs::exists(fs::path(copy) / "explore.aesl"));
    EXPECT_FALSE(fs::exists(fs::path(copy) / ".vagus"));
    EXPECT_EQ(one.copy_of_example("thymio").value(), copy) << "nobody has worked in it";
}

TEST_F(LibraryTest, AnExampleThatIsNotThereIsNamed) {
    for (const char* id : {"nothing", "../carbot", "", "/etc"}) {
        const auto copy = library().copy_of_example(id);
        ASSERT_FALSE(copy.ok()) << id;
        EXPECT_EQ(copy.error().code, Code::NotFound);
    }
}

TEST_F(LibraryTest, EveryNewProjectOpensAndItsWorldRuns) {
    for (const char* robot : {"thymio2", "carbot", "epuck"}) {
        for (const bool plan : {false, true}) {
            const std::string name = std::string("my-") + robot + (plan ? "-plan" : "");
            const auto made = library().make_project(name, robot, plan);
            ASSERT_TRUE(made.ok()) << made.error().what;
            const auto opened = open_path(made.value());
            ASSERT_TRUE(opened.ok()) << opened.error().what;
            EXPECT_EQ(opened.value().help, "") << name;  // else it says what is wrong
            auto session = session::open_sim(opened.value().real(opened.value().world), {});
            ASSERT_TRUE(session.ok()) << session.error().what;
            EXPECT_TRUE(session.value().settle());
            EXPECT_TRUE(session.value().mistakes().empty()) << name;
            EXPECT_TRUE(session.value().without_script().empty()) << name;
            EXPECT_TRUE(session.value().hints().empty()) << name;
            const bool drawn = plan || std::string_view(robot) == "carbot";
            EXPECT_EQ(!opened.value().plan.empty(), drawn);
            if (!drawn) continue;
            run::CodeLibrary code;
            const toolbox::Parts parts;
            ASSERT_TRUE(session::add_toolboxes(code, parts, {}).ok());
            const auto loaded =
                embed::LoadedPlan::from_file(opened.value().real(opened.value().plan), code);
            EXPECT_TRUE(loaded.ok()) << loaded.report();
            EXPECT_EQ(loaded.report(), "");
        }
    }
}

TEST_F(LibraryTest, ANameThatIsTakenOrNoNameIsRefused) {
    Library one = library();
    ASSERT_TRUE(one.make_project("mine", "thymio2", false).ok());
    const auto again = one.make_project("mine", "thymio2", false);
    ASSERT_FALSE(again.ok());
    EXPECT_NE(again.error().what.find("there is a project of that name"), std::string::npos);
    for (const char* name : {"", "..", "a/b", "a\nb", ".vagus"}) {
        EXPECT_FALSE(one.make_project(name, "thymio2", false).ok()) << name;
    }
}

TEST_F(LibraryTest, ARobotHasOneProject) {
    Library one = library();
    const std::string first = one.make_robot_project("tcp:127.0.0.1:33333").value();
    EXPECT_TRUE(one.is_robot_project(first));
    EXPECT_EQ(one.make_robot_project("tcp:127.0.0.1:33333").value(), first);
    const std::string other = one.make_robot_project("ser:/dev/ttyACM0").value();
    EXPECT_NE(other, first);
    EXPECT_EQ(open_path(other).value().target, "ser:/dev/ttyACM0");
}

TEST_F(LibraryTest, TheLatestOfWhatWasOpenedStandsFirstAndOnce) {
    Library one = library();
    for (int i = 0; i <= static_cast<int>(kRecentMax); ++i) {
        one.opened("/somewhere/" + std::to_string(i), "p", i);
    }
    one.opened("/somewhere/5", "p", 100);
    const auto recent = library().recent();  // read again from the disk
    ASSERT_EQ(recent.size(), kRecentMax);
    EXPECT_EQ(recent[0]["path"], "/somewhere/5");
    EXPECT_EQ(recent[1]["path"], "/somewhere/20");
    EXPECT_EQ(recent[0]["there"], false);
    one.forget("/somewhere/5");
    EXPECT_EQ(one.recent()[0]["path"], "/somewhere/20");
}

// ---- recordings from anywhere ----

struct RecordedProjectTest : LibraryTest {
    // Of a run that set a variable, with these files.
    std::string record(std::map<std::string, std::string> files) const {
        fs::create_directories(data / "sent");
        const std::string path = (data / "sent/run.mcap").string();
        record::RunFile of_paths;
        const record::PackedFiles packed{.root = "", .files = std::move(files)};
        auto tape = record::start_tape(path, of_paths, packed, record::Pace::Waits);
        EXPECT_TRUE(tape.ok());
        const record::RunFile run{.plan = "walls/A.plan.json", .set = {"far=30"}};
        const uint16_t about = tape.value()->declare({.name = std::string(record::kRunTopic)});
        tape.value()->put(about, Time{}, record::format_run(run));
        EXPECT_TRUE(tape.value()->end().ok());
        return path;
    }
};

TEST_F(RecordedProjectTest, HasTheFilesOfTheRun) {
    const std::string path =
        record({{"walls/A.plan.json", "{}"}, {"carbot/carbot.aesl", "<network/>"}});
    const auto made = library().project_of_recording(path);
    ASSERT_TRUE(made.ok()) << made.error().what;
    EXPECT_EQ(made.value().recording, "run.mcap");
    const auto opened = open_path(made.value().folder);
    ASSERT_TRUE(opened.ok()) << opened.error().what;
    EXPECT_EQ(opened.value().name, "run");
    EXPECT_EQ(opened.value().plan, "walls/A.plan.json");
    EXPECT_EQ(opened.value().scripts, std::vector<std::string>{"carbot/carbot.aesl"});
    using Set = std::vector<std::pair<std::string, std::string>>;
    EXPECT_EQ(opened.value().start_set, (Set{{"far", "30"}}));
    EXPECT_EQ(read_file(opened.value().real("carbot/carbot.aesl")).value(), "<network/>");
}

// The root of all examples has one that names nothing.
TEST_F(RecordedProjectTest, HasAProjectFileThatNamesThePlanBesideOneThatOnlyMarksTheRoot) {
    const std::string mark = R"({"format": "vagus-project/1", "name": "All"})";
    const auto made =
        library().project_of_recording(record({{"vagus.json", mark}, {"walls/A.plan.json", "{}"}}));
    ASSERT_TRUE(made.ok()) << made.error().what;
    EXPECT_EQ(open_path(made.value().folder).value().plan, "walls/A.plan.json");
    const std::string own = R"({"format": "vagus-project/1", "scripts": ["a.aesl"]})";
    const auto kept = library().project_of_recording(record({{"vagus.json", own}}));
    EXPECT_EQ(read_file(kept.value().folder + "/vagus.json").value(), own);
}

TEST_F(RecordedProjectTest, IsMadeOnceForEachRecording) {
    const std::string first =
        library().project_of_recording(record({{"a.aesl", "1"}})).value().folder;
    write(fs::path(first) / "a.aesl", "changed by hand");
    const std::string path = record({{"a.aesl", "1"}});
    EXPECT_EQ(library().project_of_recording(path).value().folder, first);
    EXPECT_EQ(read_file(first + "/a.aesl").value(), "changed by hand");
    const std::string other = record({{"a.aesl", "2"}});
    EXPECT_EQ(library().project_of_recording(other).value().folder, first + "-2");
}

TEST_F(RecordedProjectTest, NothingIsLeftOfOneThatCannotBeMade) {
    const std::string path = record({{"../../out.aesl", "1"}});
    const auto made = library().project_of_recording(path);
    ASSERT_FALSE(made.ok());
    EXPECT_NE(made.error().what.find("leads out of its folder"), std::string::npos);
    write(data / "sent/text.mcap", "no recording");
    EXPECT_FALSE(library().project_of_recording((data / "sent/text.mcap").string()).ok());
    EXPECT_TRUE(fs::is_empty(data / "projects"));
}

// ---- what a path opens ----

TEST_F(LibraryTest, AFileAloneIsAProjectWithoutOne) {
    write(data / "a/try.aesl", "var a\n");
    write(data / "a/other.txt", "x");
    const auto script = open_path((data / "a/try.aesl").string());
    ASSERT_TRUE(script.ok());
    EXPECT_EQ(script.value().root, data / "a");
    EXPECT_EQ(script.value().only, std::vector<std::string>{"try.aesl"});
    EXPECT_EQ(script.value().scripts, std::vector<std::string>{"try.aesl"});
    EXPECT_EQ(script.value().project_file, "");
}

TEST_F(LibraryTest, WhatCannotBeOpenedSaysWhatCan) {
    write(data / "b/note.txt", "x");
    for (const char* path : {"nowhere", "b", "b/note.txt"}) {
        const auto opened = open_path((data / path).string());
        ASSERT_FALSE(opened.ok()) << path;
        EXPECT_NE(opened.error().what.find("NAME.plan.json"), std::string::npos);
    }
}

// What was seen: the folder in which the server was started became the project.
TEST_F(LibraryTest, APipeOrAFolderInThePlaceOfAProjectFileIsNoProject) {
    fs::create_directories(data / "p/vagus.json");
    fs::create_directories(data / "q");
    ASSERT_EQ(::mkfifo((data / "q/vagus.json").c_str(), 0600), 0);
    ASSERT_EQ(::mkfifo((data / "q/a.plan.json").c_str(), 0600), 0);
    for (const char* path : {"p", "p/vagus.json", "q", "q/vagus.json", "q/a.plan.json"}) {
        const auto opened = open_path((data / path).string());
        ASSERT_FALSE(opened.ok()) << path;
        EXPECT_NE(opened.error().what.find(path), std::string::npos) << opened.error().what;
    }
}

TEST_F(LibraryTest, AProjectFileWithAMistakeOpensAndSaysSo) {
    write(data / "c/vagus.json", "{ \"format\": \"vagus-project/1\", \"plam\": \"x\" }");
    const auto opened = open_path((data / "c").string());
    ASSERT_TRUE(opened.ok());
    EXPECT_NE(opened.value().help.find("plam"), std::string::npos);
    EXPECT_EQ(opened.value().project_file, "vagus.json");
}

TEST_F(LibraryTest, FilesOfTheProjectAreDocumentsAndOthersKeepTheirPath) {
    write(data / "d/vagus.json", "{ \"format\": \"vagus-project/1\" }");
    write(data / "d/in/a.plan.json", "{}");
    const OpenedProject opened = open_path((data / "d").string()).value();
    EXPECT_EQ(opened.doc_of((data / "d/in/a.plan.json").string()), "in/a.plan.json");
    EXPECT_EQ(opened.doc_of((data / "d/in/../in/a.plan.json").string()), "in/a.plan.json");
    EXPECT_EQ(opened.doc_of("/etc/passwd"), "/etc/passwd");
}

// ---- what is kept ----

TEST_F(LibraryTest, WhatIsKeptIsReadAgainAndNullTakesItAway) {
    const std::string file = (data / "deep/kept.json").string();
    Kept kept(file);
    EXPECT_TRUE(kept.put("theme", "dark").ok());
    EXPECT_TRUE(kept.put("gone", 1).ok());
    EXPECT_TRUE(kept.put("gone", nullptr).ok());
    EXPECT_EQ(Kept(file).values(), (nlohmann::json{{"theme", "dark"}}));
    EXPECT_TRUE(Kept(file).get("gone").is_null());
}

TEST_F(LibraryTest, WhatIsNoJsonObjectCountsAsEmpty) {
    for (const char* text : {"", "{", "[1]", "nonsense", "{\"a\":1}x"}) {
        write(data / "kept.json", text);
        EXPECT_TRUE(Kept((data / "kept.json").string()).values().empty()) << text;
    }
}

TEST_F(LibraryTest, WhatNestsTooDeepWasNotWrittenByUs) {
    const auto nested = [](size_t deep) {
        return "{\"a\":" + std::string(deep - 1, '[') + std::string(deep - 1, ']') + "}";
    };
    const std::string file = (data / "kept.json").string();
    write(file, nested(kKeptDepthMax));
    EXPECT_FALSE(Kept(file).values().empty());
    write(file, nested(kKeptDepthMax + 1));
    EXPECT_TRUE(Kept(file).values().empty());
    write(file, nested(400'000));
    EXPECT_TRUE(Kept(file).values().empty());
}

TEST_F(LibraryTest, AnObjectOfAnotherKindIsAnEmptyOne) {
    for (const char* value : {"null", "1", "\"x\"", "[1]", "[]"}) {
        write(data / "kept.json", std::string("{\"window\":") + value + "}");
        EXPECT_EQ(Kept((data / "kept.json").string()).object("window"), nlohmann::json::object());
    }
}

TEST_F(LibraryTest, OddEntriesOfTheRecentOnesArePassedOver) {
    const std::string good = R"({"path":"/a","name":"a","when_wall":1})";
    for (const char* odd :
         {"null", "1", "[]", "{}", R"({"path":1,"name":"a","when_wall":1})",
          R"({"path":"/b","name":{},"when_wall":1})", R"({"path":"/b","name":"b"})",
          R"({"path":"/b","name":"b","when_wall":"now"})"}) {
        write(data / "recent.json", std::string("{\"recent\":[") + odd + "," + good + "]}");
        Library library({data, data / "examples"});
        EXPECT_EQ(library.recent().size(), 1u) << odd;
        library.opened("/c", "c", 2);
        library.forget("/a");
        ASSERT_EQ(library.recent().size(), 1u) << odd;
        EXPECT_EQ(library.recent()[0]["path"], "/c");
    }
    for (const char* list : {"null", "{}", "7", "\"x\"", "{\"a\":[]}"}) {
        write(data / "recent.json", std::string("{\"recent\":") + list + "}");
        Library library({data, data / "examples"});
        EXPECT_EQ(library.recent().size(), 0u) << list;
        library.opened("/c", "c", 2);
        EXPECT_EQ(library.recent().size(), 1u) << list;
    }
}

TEST_F(LibraryTest, MoreThanTheLimitIsNotKeptAndNothingIsLost) {
    Kept kept((data / "kept.json").string());
    EXPECT_TRUE(kept.put("small", 1).ok());
    const Status large = kept.put("large", std::string(kKeptBytesMax, 'x'));
    ASSERT_FALSE(large.ok());
    EXPECT_EQ(large.error().code, Code::Limit);
    EXPECT_NE(large.error().what.find("\"large\""), std::string::npos);
    EXPECT_EQ(kept.values(), (nlohmann::json{{"small", 1}}));
}

}  // namespace
