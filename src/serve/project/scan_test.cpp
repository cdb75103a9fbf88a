#include "serve/project/scan.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "serve/project/files.hpp"
#include "serve/workbench/bundle.hpp"

namespace vagus::serve {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

struct ScanTest : testing::Test {
    void SetUp() override {
        fs::create_directories(root / "inner");
        write("a.txt");
        write("inner/b.txt");
        write("z.txt");
    }
    void write(const std::string& path) const { std::ofstream(root / path) << "text"; }
    static std::vector<std::string> paths(const FolderScan& scan) {
        std::vector<std::string> found;
        for (const ScanEntry& entry : scan.entries) found.push_back(entry.path);
        return found;
    }
    static std::vector<std::string> faults(const FolderScan& scan) {
        std::vector<std::string> found;
        for (const ScanFault& fault : scan.passed_over) found.push_back(fault.path);
        return found;
    }
    // As the disk is, but one folder may not be read: this test may run as root.
    static ReadFolder locked(const std::string& name) {
        return [name](const fs::path& folder, std::error_code& failed) {
            if (folder.filename() != name) return entries_of(folder, failed);
            failed = std::make_error_code(std::errc::permission_denied);
            return std::vector<FolderEntry>{};
        };
    }

    test::Folder root;
};

TEST_F(ScanTest, ALinkThatLoopsIsNamedAndTheRestListed) {
    fs::create_symlink("loop", root / "loop");
    fs::create_symlink("ping", root / "inner/pong");
    fs::create_symlink("pong", root / "inner/ping");
    const FolderScan scan = scan_folder(root);
    EXPECT_THAT(paths(scan), UnorderedElementsAre("a.txt", "inner", "inner/b.txt", "z.txt"));
    EXPECT_THAT(faults(scan), UnorderedElementsAre("loop", "inner/ping", "inner/pong"));
    EXPECT_THAT(scan.passed_over[0].why, HasSubstr("leads to itself"));
}

TEST_F(ScanTest, ALinkToAFolderIsListedAndNotEntered) {
    fs::create_directory_symlink(root, root / "again");
    fs::create_symlink("nowhere", root / "gone");
    const FolderScan scan = scan_folder(root);
    EXPECT_THAT(paths(scan),
                UnorderedElementsAre("a.txt", "again", "inner", "inner/b.txt", "z.txt"));
    EXPECT_THAT(faults(scan), ElementsAre("gone"));
}

TEST_F(ScanTest, AFolderThatMayNotBeReadDoesNotCutTheListShort) {
    const FolderScan scan = scan_folder(root, locked("inner"));
    EXPECT_THAT(paths(scan), UnorderedElementsAre("a.txt", "inner", "z.txt"));
    ASSERT_THAT(faults(scan), ElementsAre("inner"));
    EXPECT_THAT(scan.passed_over[0].why, HasSubstr("chmod"));
}

// Without the rights of root, in a process of its own; anybody else has none anyway.
TEST_F(ScanTest, AFolderThatMayNotBeEnteredOnTheDisk) {
    fs::permissions(root, fs::perms::all);
    fs::permissions(root / "inner", fs::perms::none);
    EXPECT_EXIT(
        {
            if (::geteuid() == 0 && ::setresuid(65534, 65534, 65534) != 0) std::exit(1);
            const FolderScan scan = scan_folder(root);
            const bool good = scan.passed_over.size() == 1 && scan.entries.size() == 3 &&
                              scan.passed_over[0].path == "inner";
            std::exit(good ? 0 : 1);
        },
        testing::ExitedWithCode(0), "");
    fs::permissions(root / "inner", fs::perms::all);
}

TEST_F(ScanTest, PipesAreNamedAndNotOpened) {
    ASSERT_EQ(::mkfifo((root / "p.aesl").c_str(), 0600), 0);
    const FolderScan scan = scan_folder(root);
    EXPECT_THAT(faults(scan), ElementsAre("p.aesl"));
    Files files(root);
    EXPECT_FALSE(files.open("p.aesl").ok());
    EXPECT_FALSE(files.text("p.aesl").ok());
}

TEST_F(ScanTest, OneFileMoreThanTheLimitIsMore) {
    for (size_t i = 4; i < kFilesMax; ++i) write("f" + std::to_string(i));
    EXPECT_FALSE(scan_folder(root).more);
    write("one more");
    EXPECT_TRUE(scan_folder(root).more);
    EXPECT_EQ(scan_folder(root).entries.size(), kFilesMax);
}

TEST_F(ScanTest, OneFolderDeeperThanTheLimitIsMore) {
    fs::path deep = root;
    for (size_t i = 0; i <= kFolderDepthMax; ++i) deep /= "d";
    fs::create_directories(deep.parent_path());
    EXPECT_FALSE(scan_folder(root).more);
    fs::create_directories(deep);
    EXPECT_TRUE(scan_folder(root).more);
}

TEST_F(ScanTest, WhatIsPassedOverIsToldOnce) {
    fs::create_symlink("loop", root / "loop");
    fs::create_symlink("nowhere", root / "link");
    Files files(root);
    bool more = false;
    EXPECT_EQ(files.list(more).size(), 4u);
    const std::string told = *files.take_trouble() + *files.take_trouble();
    EXPECT_THAT(told, HasSubstr("loop: passed over"));
    EXPECT_THAT(told, HasSubstr("link: passed over"));
    (void)files.list(more);
    EXPECT_EQ(files.take_trouble(), std::nullopt);
    fs::remove(root / "loop");
    (void)files.list(more);
    EXPECT_EQ(files.take_trouble(), std::nullopt);
    fs::create_symlink("loop", root / "loop");
    (void)files.list(more);
    EXPECT_NE(files.take_trouble(), std::nullopt);
}

// What was seen: deploy left them out without a word, a folder with all that was in it.
TEST_F(ScanTest, OddNamesAreNamedAndThoseWithADotLeftOut) {
    fs::create_directories(root / "parts #2/inner");
    fs::create_directories(root / ".git");
    write("parts #2/a.aesl");
    write("why?.txt");
    write(" a.txt");
    write("caf\xe9.txt");
    write(std::string(129, 'x'));
    write(".hidden");
    const FolderScan scan = scan_folder(root);
    EXPECT_THAT(paths(scan), UnorderedElementsAre("a.txt", "inner", "inner/b.txt", "z.txt"));
    EXPECT_THAT(faults(scan), UnorderedElementsAre("parts #2", "why?.txt", " a.txt", "caf?.txt",
                                                   std::string(129, 'x')));
    for (const ScanFault& fault : scan.passed_over) EXPECT_THAT(fault.why, HasSubstr("rename it"));
}

TEST_F(ScanTest, AProjectWithAnOddNameIsNotSent) {
    std::ofstream(root / "vagus.json") << R"({"format":"vagus-project/1","name":"p"})";
    ASSERT_TRUE(collect_bundle(root.string()).ok());
    fs::create_directories(root / "parts #2");
    const auto refused = collect_bundle(root.string());
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().what, HasSubstr("parts #2: a name has an odd character"));
}

// A project inside another one may name files beside it.
TEST_F(ScanTest, AFileOfAnOddNameThatIsNamedIsNotLeftOut) {
    std::ofstream(root / "vagus.json") << R"({"format":"vagus-project/1","name":"p"})";
    std::ofstream(root / "inner/vagus.json")
        << R"({"format":"vagus-project/1","name":"q","scripts":["../odd#.aesl"]})";
    ASSERT_TRUE(collect_bundle((root / "inner").string()).ok());
    write("odd#.aesl");
    const auto refused = collect_bundle((root / "inner").string());
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().what, HasSubstr("names odd#.aesl: a name has an odd character"));
}

// As in examples/alarm: its robots run the project that the world is in.
TEST_F(ScanTest, AWorldMayNameTheFolderThatItIsIn) {
    std::ofstream(root / "vagus.json") << R"({"format":"vagus-project/1","name":"p"})";
    std::ofstream(root / "w.world.json")
        << R"({"format":"vagus-world/1","size":[2,2],)"
        << R"("robots":[{"name":"t","type":"thymio2","at":[1,1],"project":"."}]})";
    const auto collected = collect_bundle(root.string());
    ASSERT_TRUE(collected.ok()) << collected.error().what;
    EXPECT_THAT(collected.value().bundle.files,
                testing::Contains(testing::Field(&BundleFile::path, "w.world.json")));
}

TEST_F(ScanTest, NoPartOfAProjectIsSent) {
    std::ofstream(root / "vagus.json") << R"({"format":"vagus-project/1","name":"p"})";
    ASSERT_TRUE(collect_bundle(root.string()).ok());
    fs::create_symlink("loop", root / "loop");
    const auto refused = collect_bundle(root.string());
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().what, HasSubstr("loop: a link that leads to itself; delete it"));
}

}  // namespace
}  // namespace vagus::serve
