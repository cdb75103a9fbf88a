#include "plan/icon.hpp"

#include <gtest/gtest.h>

#include <string>

namespace vagus::plan {
namespace {

// After the grammar of path data in SVG 1.1, section 8.3.9.
TEST(Icon, IsPathData) {
    for (const char* text :
         {"M4 5h16M4 10h16", "M12 2a10 10 0 1 0 0 20a10 10 0 0 0 0-20M12 6v6l4 3", "m1,2z",
          "M12 8v.1", "M.5.5h1", "M1 1 2 2 3 3", "M 1 1 C1,2,3,4,5,6 1 2 3 4 5 6 Z",
          "M0 0a1 1 0 011 2", " M1e1-2.5Q1 2 3 4T1 2S1 2 3 4"}) {
        EXPECT_TRUE(is_path_data(text)) << text;
    }
}

TEST(Icon, IsNothingElse) {
    for (const char* text :
         {"", " ", "L1 1", "M", "M1", "M1 1 2", "M1 1X", "M1 1h", "hello", "M1 1z1",
          "M0 0a1 1 0 2 1 1 1", "M1 1\"/><script>", "<svg/>", "icon.png", "M1..5 1", "M- 1"}) {
        EXPECT_FALSE(is_path_data(text)) << text;
    }
}

TEST(Icon, HasALimitOfItsLength) {
    std::string text = "M1 1";
    while (text.size() + 2 <= kIconBytesMax) text += "h1";
    EXPECT_TRUE(is_path_data(text));
    EXPECT_FALSE(is_path_data(text + "h1"));
}

}  // namespace
}  // namespace vagus::plan
