#include "serve/field/versions.hpp"
#include "base/test_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include "base/file.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;

class VersionsTest : public testing::Test {
protected:
    static Bundle bundle(const std::string& content) {
        return {.name = "Rover",
                .project = "rover",
                .files = {{"rover/vagus.json", content.size(), sha256_of(content)}}};
    }
    // Comes, and is in force.
    uint32_t deploy(const std::string& content) {
        EXPECT_TRUE(versions.begin().ok());
        EXPECT_TRUE(versions.add("rover/vagus.json", content).ok());
        const uint32_t number = versions.finish(bundle(content)).value();
        EXPECT_TRUE(versions.put_in_force(number).ok());
        versions.end_trial();
        versions.remove_old();
        return number;
    }
    std::string content(uint32_t version) const {
        const auto text = read_file((versions.folder(version) / "vagus.json").string());
        return text.ok() ? text.value() : "";
    }

    test::Folder project;
    Versions versions{project};
};

using Numbers = std::vector<uint32_t>;

TEST_F(VersionsTest, WithoutADeploymentTheFolderAsGivenIsInForce) {
    EXPECT_EQ(versions.current(), 0u);
    EXPECT_EQ(versions.all(), Numbers{});
    EXPECT_EQ(versions.folder(0), project);
    EXPECT_FALSE(versions.trial().has_value());
}

TEST_F(VersionsTest, TheLastFiveStay) {
    for (const char* text : {"1", "2", "3", "4", "5", "6", "7"}) deploy(text);
    EXPECT_EQ(versions.current(), 7u);
    EXPECT_EQ(versions.all(), (Numbers{3, 4, 5, 6, 7}));
    EXPECT_EQ(content(7), "7");
    EXPECT_EQ(content(3), "3");
    EXPECT_EQ(versions.before(7), 6u);
    EXPECT_EQ(versions.before(3), 0u) << "2 is gone, and 1; the folder as it was given never goes";
}

// 3 was taken back: what comes next came after 2, and 3 is not what it goes back to.
TEST_F(VersionsTest, BackIsWhatWasInForceBefore) {
    deploy("1");
    deploy("2");
    deploy("3");
    ASSERT_TRUE(versions.put_in_force(versions.before(3)).ok());
    EXPECT_EQ(versions.current(), 2u);
    EXPECT_EQ(deploy("4"), 4u);
    EXPECT_EQ(versions.before(4), 2u);
    EXPECT_EQ(versions.before(2), 1u);
    ASSERT_TRUE(versions.put_in_force(0).ok());
    EXPECT_EQ(versions.current(), 0u);
}

TEST_F(VersionsTest, WhatWasInterruptedOnItsWayIsGoneAtTheNextBoot) {
    deploy("1");
    ASSERT_TRUE(versions.begin().ok());
    ASSERT_TRUE(versions.add("rover/vagus.json", "half").ok());
    ASSERT_TRUE(versions.tidy_up().ok());
    EXPECT_FALSE(fs::exists(project / ".vagus/versions/incoming"));
    EXPECT_EQ(versions.current(), 1u);
}

// Two robots at one desk, served from one folder: each took the files of the other for its own.
TEST_F(VersionsTest, OneServerChangesTheVersionsOfAFolder) {
    ASSERT_TRUE(versions.begin().ok());
    ASSERT_TRUE(versions.add("rover/vagus.json", "1").ok());
    {
        Versions second(project);
        const std::string told = second.begin().error().what;
        EXPECT_EQ(told, project.string() +
                            ": another robot that is served from this folder keeps its versions "
                            "in it; give each robot a copy of the project");
        EXPECT_EQ(second.tidy_up().error().what, told);
        second.forget_incoming();
    }
    EXPECT_EQ(versions.finish(bundle("1")).value(), 1u);
}

TEST_F(VersionsTest, WhatHasItsNumberAndWasNeverInForceIsGoneAtTheNextBoot) {
    deploy("1");
    ASSERT_TRUE(versions.begin().ok());
    ASSERT_TRUE(versions.add("rover/vagus.json", "2").ok());
    ASSERT_EQ(versions.finish(bundle("2")).value(), 2u);
    ASSERT_TRUE(versions.tidy_up().ok());
    EXPECT_EQ(versions.all(), Numbers{1});
    EXPECT_FALSE(versions.trial().has_value());
}

TEST_F(VersionsTest, ATrialOfWhatIsInForceOutlivesTheBoot) {
    deploy("1");
    ASSERT_TRUE(versions.begin().ok());
    ASSERT_TRUE(versions.add("rover/vagus.json", "2").ok());
    ASSERT_TRUE(versions.finish(bundle("2")).ok());
    ASSERT_TRUE(versions.put_in_force(2).ok());
    ASSERT_TRUE(versions.tidy_up().ok());
    const auto trial = versions.trial();
    ASSERT_TRUE(trial.has_value());
    EXPECT_EQ(trial->version, 2u);
    EXPECT_EQ(trial->back, 1u);
    EXPECT_EQ(content(2), "2");
}

TEST_F(VersionsTest, WhatIsInForceIsNeverRemoved) {
    deploy("1");
    versions.remove(1);
    versions.remove(0);
    EXPECT_EQ(content(1), "1");
    EXPECT_TRUE(fs::exists(project));
}

TEST_F(VersionsTest, AListThatIsNoneIsNamed) {
    deploy("1");
    ASSERT_TRUE(write_file((project / ".vagus/versions/1/deployed.json").string(), "{}").ok());
    const auto read = versions.bundle(1);
    ASSERT_FALSE(read.ok());
    EXPECT_NE(read.error().what.find("deployed.json: expected a vagus-deployed/1; deploy"),
              std::string::npos);
    EXPECT_EQ(versions.before(1), 0u);
}

TEST(Bundle, PathsThatLeaveAndLimitsAreRefused) {
    const auto with = [](std::vector<BundleFile> files) {
        files.push_back({"vagus.json", 1, ""});
        return check_bundle({.name = "x", .project = "", .files = std::move(files)});
    };
    EXPECT_TRUE(with({}).ok());
    for (const char* path : {"../x", "/etc/passwd", "a/../../x", ".vagus/state.json", "a//b", ""}) {
        EXPECT_FALSE(with({{path, 1, ""}}).ok()) << path;
    }
    EXPECT_FALSE(with({{"vagus.json", 1, ""}}).ok()) << "twice";
    EXPECT_TRUE(with({{"a", kBundleFileBytesMax, ""}}).ok());
    EXPECT_FALSE(with({{"a", kBundleFileBytesMax + 1, ""}}).ok());
    const BundleFile large{"", kBundleFileBytesMax, ""};
    EXPECT_FALSE(with({{"a", large.size, ""},
                       {"b", large.size, ""},
                       {"c", large.size, ""},
                       {"d", large.size, ""}})
                     .ok())
        << "one byte too many together";
    std::vector<BundleFile> many;
    for (size_t i = 0; i < kBundleFilesMax; ++i) many.push_back({"f" + std::to_string(i), 0, ""});
    EXPECT_FALSE(with(many).ok()) << "one file too many";
    many.pop_back();
    EXPECT_TRUE(with(many).ok());
    EXPECT_FALSE(
        check_bundle({.name = "x", .project = "a", .files = {{"vagus.json", 1, ""}}}).ok());
}

// SHA-256 of "abc": FIPS 180-2, B.1.
TEST(Bundle, HashesAreThoseOfTheStandard) {
    EXPECT_EQ(sha256_of("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace vagus::serve
