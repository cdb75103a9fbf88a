#include "serve/workbench/door.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "base/file.hpp"
#include "base/test_folder.hpp"

namespace vagus::serve {
namespace {

TEST(Door, ANewTokenIsInItsFileAndToldWithTheAddress) {
    const test::Folder folder;
    std::filesystem::create_directories(folder / "pages");
    std::ofstream(folder / "pages/index.html") << "<!doctype html>";
    std::string told;
    DoorOptions options{.port = 0, .pages = (folder / "pages").string()};
    options.renewed = [&](const std::string& address) { told = address; };
    auto opened = Door::open(options, folder / "data", [] {});
    ASSERT_TRUE(opened.ok()) << opened.error().what;
    Door door = std::move(opened.value());
    const Desk::Outside outside = door.outside([](const std::string&) {});
    const auto token = outside.renew();
    ASSERT_TRUE(token.ok()) << token.error().what;
    EXPECT_NE(token.value(), door.token());
    EXPECT_EQ(read_file((folder / "data/token").string()).value(), token.value() + "\n");
    EXPECT_EQ(told, door.address() + "#token=" + token.value());
    EXPECT_EQ(door.access().grade(token.value()), Access::Grade::Drive);
    EXPECT_EQ(door.access().grade(door.token()), Access::Grade::Refused);
}

}  // namespace
}  // namespace vagus::serve
