// The plans and worlds of the samples as a user opens them: without a finding, in the saved form.
#include <gmock/gmock.h>

#include <array>
#include <filesystem>

#include "base/file.hpp"
#include "plan/check.hpp"
#include "plan/file.hpp"
#include "plan/test_files.hpp"
#include "sim/world.hpp"
#include "toolbox/builtin.hpp"
#include "trial.hpp"

namespace vagus::samples {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 7> kFolders = {
    "find-object", "follow-object", "follow-wall", "infrared", "obstacle", "patterns", "rooms"};

std::vector<std::string> files_ending(std::string_view ending) {
    std::vector<std::string> files;
    for (const std::string_view folder : kFolders) {
        for (const auto& entry : fs::directory_iterator(example(std::string(folder)))) {
            if (entry.path().string().ends_with(ending)) files.push_back(entry.path());
        }
    }
    return files;
}

TEST(SavedForm, NoPlanHasAFindingAndAllAreInTheSavedForm) {
    const toolbox::Parts parts;
    run::CodeLibrary library;
    toolbox::add_builtin(library, parts);
    const std::vector<std::string> files = files_ending(".plan.json");
    EXPECT_GE(files.size(), kFolders.size());
    for (const std::string& file : files) {
        const plan::Checked checked = plan::check(file, plan::Disk(), library.templates());
        EXPECT_TRUE(checked.findings.empty()) << plan::format_findings_json(checked.findings);
        const auto text = read_file(file);
        ASSERT_TRUE(text.ok()) << text.error().what;
        const auto saved = plan::format_plan(text.value(), file);
        ASSERT_TRUE(saved.ok()) << saved.error().what;
        EXPECT_EQ(saved.value(), text.value()) << file;
    }
}

TEST(SavedForm, EveryActorHasHelp) {
    for (const std::string& file : files_ending(".plan.json")) {
        const auto text = read_file(file);
        ASSERT_TRUE(text.ok()) << text.error().what;
        const plan::PlanFile parsed = plan::parse_plan(text.value(), file);
        ASSERT_TRUE(parsed.readable) << file;
        EXPECT_FALSE(parsed.plan.help.empty()) << file;
        for (const plan::Actor& actor : parsed.plan.actors) {
            EXPECT_FALSE(actor.help.empty()) << file << ": " << actor.name;
        }
    }
}

TEST(SavedForm, EveryWorldHasHelpAndARobotWithAScript) {
    const std::vector<std::string> files = files_ending(".world.json");
    EXPECT_GE(files.size(), kFolders.size());
    for (const std::string& file : files) {
        const auto text = read_file(file);
        ASSERT_TRUE(text.ok()) << text.error().what;
        const auto world = sim::World::load(text.value(), file);
        ASSERT_TRUE(world.ok()) << world.error().what;
        EXPECT_FALSE(world.value().definition().help.empty()) << file;
        for (const auto& robot : world.value().definition().robots) {
            EXPECT_FALSE(robot.script.empty()) << file << ": " << robot.name;
        }
    }
}

}  // namespace
}  // namespace vagus::samples
