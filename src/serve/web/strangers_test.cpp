#include "serve/web/strangers.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace vagus::serve {
namespace {

struct Fixture {
    std::vector<int> gone;
    Strangers strangers{{.all = 4, .of_address = 3}};
    Strangers::Place come(int who, const std::string& address) {
        return strangers.add(address, [this, who] { gone.push_back(who); });
    }
};

TEST(Strangers, TheFourthOfAnAddressTakesThePlaceOfTheMostSilent) {
    Fixture f;
    const auto first = f.come(1, "a");
    f.come(2, "a");
    f.come(3, "a");
    EXPECT_TRUE(f.gone.empty());
    f.strangers.heard(first);
    f.come(4, "a");
    EXPECT_EQ(f.gone, std::vector<int>{2});
    EXPECT_EQ(f.strangers.size(), 3u);
}

TEST(Strangers, WhoHoldsTheMostGivesWay) {
    Fixture f;
    f.come(1, "b");
    f.come(2, "a");
    f.come(3, "a");
    f.come(4, "a");
    f.come(5, "c");
    EXPECT_EQ(f.gone, std::vector<int>{2});
}

TEST(Strangers, WhoIsKnownOrGoneHoldsNoPlace) {
    Fixture f;
    f.strangers.remove(f.come(1, "a"));
    f.come(2, "a");
    f.come(3, "a");
    f.come(4, "a");
    EXPECT_TRUE(f.gone.empty());
}

TEST(Strangers, AnIPv6NetworkIsOneOwner) {
    EXPECT_EQ(owner_of("192.168.1.7"), "192.168.1.7");
    EXPECT_EQ(owner_of("2001:db8:1:2:3:4:5:6"), "2001:db8:1:2::/64");
    EXPECT_EQ(owner_of("2001:db8::1"), "2001:db8::/64");
    EXPECT_EQ(owner_of("::1"), "::/64");
}

}  // namespace
}  // namespace vagus::serve
