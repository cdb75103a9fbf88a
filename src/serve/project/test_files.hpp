// A folder of one test with a project in it, and what a page does to its files.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "serve/project/files.hpp"

namespace vagus::serve {

struct FilesTest : testing::Test {
    void SetUp() override {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        root = std::filesystem::path(testing::TempDir()) /
               (std::string(test->test_suite_name()) + "-" + std::to_string(::getpid()) + "-" +
                test->name());
        std::filesystem::remove_all(root);
        std::filesystem::create_directories(root / "carbot");
        write("note.txt", "hello\n");
    }
    void TearDown() override { std::filesystem::remove_all(root); }
    void write(const std::string& path, std::string_view text) {
        std::ofstream(root / path) << text;
    }
    std::string on_disk(const std::string& path) {
        return read_file((root / path).string()).value();
    }
    uint32_t edit(Files& files, const std::string& doc, std::vector<TextChange> changes) {
        const auto edited = files.edit(doc, files.open(doc).value().version, changes, "me");
        EXPECT_TRUE(edited.ok()) << edited.error().what;
        return edited.ok() ? edited.value() : 0;
    }
    std::filesystem::path root;
};

}  // namespace vagus::serve
