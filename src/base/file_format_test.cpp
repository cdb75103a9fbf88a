#include "base/file_format.hpp"

#include <gtest/gtest.h>

namespace vagus {
namespace {

std::string error_of(std::string_view text, FileFormat wanted) {
    const auto read = parse_format(text, "f", wanted);
    return read.ok() ? "no error" : read.error().what;
}

TEST(FileFormat, IsKnownByItsText) {
    EXPECT_EQ(format_of("{\"format\": \"vagus-plan/1\"}"), FileFormat::Plan);
    EXPECT_EQ(format_of("\n{\"name\": 1, \"format\": \"vagus-toolbox/1\"}"), FileFormat::Toolbox);
    EXPECT_EQ(format_of("{\"bytecodeSize\": 1, \"stackSize\": 2}"), FileFormat::Node);
    EXPECT_EQ(format_of("<!DOCTYPE aesl-source>\n<network>"), FileFormat::Script);
    EXPECT_EQ(format_of("\xef\xbb\xbf<network>"), FileFormat::Script);
    EXPECT_EQ(format_of("{\"format\": \"other/1\"}"), std::nullopt);
    EXPECT_EQ(format_of("[1]"), std::nullopt);
    EXPECT_EQ(format_of("onevent tick\n"), std::nullopt);
}

TEST(FileFormat, AnotherFormatIsCalledThat) {
    EXPECT_EQ(error_of("{\n \"format\": \"vagus-plan/1\" }", FileFormat::World),
              "f:2:12: this is a plan file (vagus-plan/1); a world file (vagus-world/1) was "
              "expected");
    EXPECT_EQ(error_of("<network/>", FileFormat::World),
              "f:1:1: this is a script (.aesl); a world file (vagus-world/1) was expected");
    EXPECT_EQ(error_of("{\"bytecodeSize\": 1, \"stackSize\": 2}", FileFormat::Plan),
              "f:1:1: this is a node file; a plan file (vagus-plan/1) was expected");
    EXPECT_EQ(error_of("{\"format\": \"vagus-world/1\"}", FileFormat::Node),
              "f:1:12: this is a world file (vagus-world/1); a node file was expected");
    EXPECT_EQ(other_format("{\"format\": \"vagus-world/1\"}", FileFormat::Script),
              "this is a world file (vagus-world/1); a script (.aesl) was expected");
    EXPECT_EQ(error_of("{\"format\": \"vagus-world/1\"}", FileFormat::World), "no error");
}

}  // namespace
}  // namespace vagus
