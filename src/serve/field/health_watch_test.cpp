#include "serve/field/health_watch.hpp"

#include <gtest/gtest.h>

#include <map>

#include "fleet/limits.hpp"

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;
using plan::Value;

class HealthWatchTest : public testing::Test {
protected:
    Result<Value> read(const plan::WordFormula::Name& name) const {
        const auto found = values.find(name.shown);
        if (found == values.end()) return Error{Code::NotFound, "no plan runs"};
        return found->second;
    }
    // Until that time, in steps of the look.
    void pass_until(Time end) {
        for (; now < end; now += fleet::kConditionEvery) watch.tick(now);
        watch.tick(now);
    }

    std::map<std::string, Value> values;
    Time now{};
    HealthWatch watch{{"battery > 20", 5s}, [this](const auto& name) { return read(name); }};
};

TEST_F(HealthWatchTest, OneThatHoldsFromTheBeginningIsWellWhenItsTimeIsOver) {
    values.emplace("battery", int64_t{25});
    pass_until(4900ms);
    EXPECT_FALSE(watch.is_well());
    EXPECT_EQ(watch.why(), "its condition battery > 20 is true, but not yet for 5 s: battery = 25");
    pass_until(5s);
    EXPECT_TRUE(watch.is_well());
    EXPECT_EQ(watch.why(), "its condition battery > 20 was true for 5 s: battery = 25");
    values.at("battery") = Value(int64_t{1});
    pass_until(6s);
    EXPECT_TRUE(watch.is_well()) << "it has been well";
}

TEST_F(HealthWatchTest, OneThatBecomesTrueLateIsWellFiveSecondsLater) {
    values.emplace("battery", int64_t{20});
    pass_until(3900ms);
    EXPECT_EQ(watch.why(), "its condition battery > 20 is not true: battery = 20");
    values.at("battery") = Value(int64_t{21});
    pass_until(8900ms);  // true since 4.0 s: the look at 3.9 s was before
    EXPECT_FALSE(watch.is_well());
    pass_until(9s);
    EXPECT_TRUE(watch.is_well());
}

TEST_F(HealthWatchTest, OneThatBecomesFalseAgainBeginsOnceMore) {
    values.emplace("battery", int64_t{25});
    pass_until(4900ms);
    values.at("battery") = Value(int64_t{12});
    pass_until(5s);
    EXPECT_FALSE(watch.is_well());
    values.at("battery") = Value(int64_t{25});
    pass_until(10s);  // true since 5.1 s
    EXPECT_FALSE(watch.is_well());
    pass_until(10100ms);
    EXPECT_TRUE(watch.is_well());
}

TEST_F(HealthWatchTest, OneThatNeverHoldsIsNeverWell) {
    values.emplace("battery", 19.5);
    pass_until(60s);
    EXPECT_FALSE(watch.is_well());
    EXPECT_EQ(watch.why(), "its condition battery > 20 is not true: battery = 19.5");
    EXPECT_EQ(watch.next_tick(), 60s + fleet::kConditionEvery);
}

TEST_F(HealthWatchTest, WhatNobodyKnowsIsNotTrue) {
    pass_until(5s);
    EXPECT_EQ(watch.why(), "its condition battery > 20 is not true: no plan runs");
    values.emplace("battery", std::string("full"));
    pass_until(6s);
    EXPECT_FALSE(watch.is_well());
    EXPECT_NE(watch.why().find("battery = \"full\""), std::string::npos) << watch.why();
}

TEST_F(HealthWatchTest, ItsSentenceFitsIntoALine) {
    values.emplace("battery", std::string(2 * fleet::kLineBytesMax, 'x'));
    pass_until(1s);
    EXPECT_EQ(watch.why().size(), fleet::kLineBytesMax);
}

TEST(HealthWatch, WordsOfNodesAndNoTimeAtAll) {
    HealthWatch watch({"ready and node('drive', 'token[2]') > 0", 0s}, [](const auto& name) {
        return name.of == plan::WordFormula::Name::Of::Word
                   ? Result<Value>(Value(int64_t{name.element}))
                   : Result<Value>(Value(true));
    });
    watch.tick(7s);
    EXPECT_TRUE(watch.is_well());
    EXPECT_EQ(watch.why(),
              "its condition ready and node('drive', 'token[2]') > 0 was true for 0 s: ready = "
              "true, node('drive', 'token[2]') = 2");
}

}  // namespace
}  // namespace vagus::serve
