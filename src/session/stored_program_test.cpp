#include "session/stored_program.hpp"
#include "base/test_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace vagus::session {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

aesl::Target target_named(const std::string& name) {
    aesl::Target target;
    target.name = name;
    target.bytecode_size = 8;
    target.variables_size = 8;
    target.stack_size = 4;
    target.variables = {{"id", 1}, {"event.source", 1}, {"event.args", 2}};
    return target;
}

class StoredProgram : public testing::Test {
protected:
    static std::unique_ptr<SoftwareNode> node(const std::string& name = "keeper") {
        return std::move(SoftwareNode::make(target_named(name), {.id = 4}).value());
    }

    const test::Folder folder_;
    const std::string path_ = (folder_ / "node.flash").string();
};

TEST_F(StoredProgram, IsThereAfterARestart) {
    const auto before = node();
    ASSERT_TRUE(before->load(std::vector<uint16_t>{3, 0xffff, 3, 0x1009, 0x4004, 0}).ok());
    ASSERT_TRUE(store_program(*before, path_).ok());

    const auto after = node();
    const auto stored = load_stored_program(*after, path_);
    ASSERT_TRUE(stored.ok());
    EXPECT_EQ(stored.value(), Stored::Loaded);
    EXPECT_THAT(after->bytecode(), ElementsAre(3, 0xffff, 3, 0x1009, 0x4004, 0, 0, 0));
    after->start_program();
    after->run(100);
    EXPECT_EQ(after->variables()[4], 9);
}

TEST_F(StoredProgram, NoFileIsNoProgramYet) {
    const auto fresh = node();
    const auto stored = load_stored_program(*fresh, path_);
    ASSERT_TRUE(stored.ok());
    EXPECT_EQ(stored.value(), Stored::Absent);
}

TEST_F(StoredProgram, AnotherNodesFileIsRefused) {
    ASSERT_TRUE(store_program(*node("other"), path_).ok());
    const auto stored = load_stored_program(*node(), path_);
    ASSERT_FALSE(stored.ok());
    EXPECT_THAT(stored.error().what, HasSubstr("another node than \"keeper\""));
}

TEST_F(StoredProgram, DamagedFileIsRefusedAndNothingIsLoaded) {
    const auto before = node();
    ASSERT_TRUE(before->load(std::vector<uint16_t>{3, 0xffff, 3, 0x1009, 0x4004, 0}).ok());
    ASSERT_TRUE(store_program(*before, path_).ok());
    std::filesystem::resize_file(path_, std::filesystem::file_size(path_) - 1);
    const auto after = node();
    EXPECT_FALSE(load_stored_program(*after, path_).ok());
    EXPECT_THAT(after->bytecode(), testing::Each(0));
}

TEST_F(StoredProgram, EmptyMemoryCanBeSavedToo) {
    ASSERT_TRUE(store_program(*node(), path_).ok());
    const auto after = node();
    ASSERT_TRUE(after->load(std::vector<uint16_t>{3, 1, 1}).ok());
    EXPECT_EQ(load_stored_program(*after, path_).value(), Stored::Loaded);
    EXPECT_THAT(after->bytecode(), testing::Each(0));
}

TEST_F(StoredProgram, AFolderThatDoesNotExistIsAnError) {
    EXPECT_FALSE(store_program(*node(), (folder_ / "no" / "where").string()).ok());
}

}  // namespace
}  // namespace vagus::session
