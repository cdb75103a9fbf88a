#include "base/shared_value.hpp"

#include <gtest/gtest.h>

#include <string>

namespace vagus {
namespace {

TEST(SharedValue, CopiesAreTheSameOne) {
    const SharedValue<std::string> one = std::string("text");
    const SharedValue<std::string> other = one;
    EXPECT_TRUE(one.shares(other));
    EXPECT_EQ(&*one, &*other);
    EXPECT_EQ(other->size(), 4u);
    const std::string& read = other;
    EXPECT_EQ(read, "text");
}

TEST(SharedValue, EqualOnesThatWereMadeApartAreNot) {
    const SharedValue<std::string> one = std::string("text"), other = std::string("text");
    EXPECT_FALSE(one.shares(other));
    EXPECT_EQ(*one, *other);
}

TEST(SharedValue, WithoutAValueItReadsAsAnEmptyOne) {
    SharedValue<std::string> none;
    EXPECT_FALSE(none.has_value());
    EXPECT_EQ(*none, "");
    none = std::string("text");
    EXPECT_TRUE(none);
    none.reset();
    EXPECT_TRUE(none->empty());
}

}  // namespace
}  // namespace vagus
