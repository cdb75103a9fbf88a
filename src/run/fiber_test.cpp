// Turns in the order of the calls, and what must stay with its stack: exceptions, a megabyte.
#include "run/fiber.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

namespace vagus::run {
namespace {

using testing::ElementsAre;
using Lines = std::vector<std::string>;

class Calls final : public FiberCode {
public:
    explicit Calls(std::function<void()> body) : body_(std::move(body)) {}
    void run() override { body_(); }

private:
    std::function<void()> body_;
};

const char* frame_here() {
    return static_cast<const char*>(__builtin_frame_address(0));
}

TEST(Fiber, CodeAndExecutorTakeTurns) {
    Lines lines;
    Fiber fiber;
    Calls code([&] {
        lines.push_back("code 1");
        fiber.give_back();
        lines.push_back("code 2");
        fiber.give_back();
        lines.push_back("code 3");
    });
    EXPECT_TRUE(fiber.ended());
    fiber.start(code);
    lines.push_back("executor 1");
    fiber.go_on();
    lines.push_back("executor 2");
    EXPECT_FALSE(fiber.ended());
    fiber.go_on();
    lines.push_back("executor 3");
    EXPECT_TRUE(fiber.ended());
    EXPECT_THAT(
        lines, ElementsAre("code 1", "executor 1", "code 2", "executor 2", "code 3", "executor 3"));
}

TEST(Fiber, OneCodeFollowsTheOtherOnTheSameStack) {
    Fiber fiber;
    std::vector<const void*> places;
    Calls code([&] { places.push_back(frame_here()); });
    for (int i = 0; i < 3; ++i) fiber.start(code);
    EXPECT_THAT(places, ElementsAre(places[0], places[0], places[0]));
}

TEST(Fiber, OneThatNeverRanEnds) {
    Fiber fiber;
    EXPECT_TRUE(fiber.ended());
}

TEST(Fiber, TheCodeIsOnTheThreadOfTheExecutor) {
    std::thread::id of_code;
    Fiber fiber;
    Calls code([&of_code] { of_code = std::this_thread::get_id(); });
    fiber.start(code);
    EXPECT_EQ(of_code, std::this_thread::get_id());
}

// As runs of the studio: made by one thread, run by another, ended by the first.
TEST(Fiber, MayBeMadeAndEndedByOtherThreadsThanItsCodeRunsOn) {
    int turns = 0;
    Fiber fiber;
    Calls code([&] {
        ++turns;
        fiber.give_back();
        ++turns;
    });
    for (int i = 0; i < 2; ++i) {
        std::thread([&] {
            fiber.start(code);
            fiber.go_on();
        }).join();
    }
    EXPECT_EQ(turns, 4);
}

TEST(Fiber, AThousandWaitAtOnceEachWithItsOwn) {
    constexpr int kMany = 1000;
    std::vector<std::unique_ptr<Fiber>> fibers;
    std::vector<std::unique_ptr<Calls>> codes;
    std::vector<int> counts(kMany);
    for (int i = 0; i < kMany; ++i) {
        fibers.push_back(std::make_unique<Fiber>());
        codes.push_back(std::make_unique<Calls>([&counts, &fiber = *fibers.back(), i] {
            for (int mine = 0; mine < 3; ++mine) {
                counts[static_cast<size_t>(i)] = 10 * i + mine;
                fiber.give_back();
            }
        }));
        fibers.back()->start(*codes.back());
    }
    for (const auto& fiber : fibers) fiber->go_on();
    for (const auto& fiber : fibers) fiber->go_on();
    for (int i = 0; i < kMany; ++i) EXPECT_EQ(counts[static_cast<size_t>(i)], 10 * i + 2);
    for (const auto& fiber : fibers) fiber->go_on();
    for (const auto& fiber : fibers) EXPECT_TRUE(fiber->ended());
}

// ---- exceptions ----

// Throws `name`, gives back inside of the catch block, then throws on what it has caught there.
void wait_in_a_catch_block(Fiber& fiber, const std::string& name, Lines& lines) {
    try {
        try {
            throw name;
        } catch (const std::string&) {
            fiber.give_back();
            throw;
        }
    } catch (const std::string& caught) {
        lines.push_back(name + " has " + caught);
    }
}

// Left in the order in which they were entered: a thread alone leaves the last one first.
TEST(Fiber, WhatEachHasCaughtStaysItsOwn) {
    Lines lines;
    Fiber one, other;
    Calls first([&] { wait_in_a_catch_block(one, "one", lines); });
    Calls second([&] { wait_in_a_catch_block(other, "other", lines); });
    try {
        throw std::string("the executor's");
    } catch (const std::string&) {
        one.start(first);
        other.start(second);
        one.go_on();
        try {
            throw;
        } catch (const std::string& caught) {
            lines.push_back("executor has " + caught);
        }
        other.go_on();
    }
    EXPECT_EQ(std::current_exception(), nullptr);
    EXPECT_THAT(lines,
                ElementsAre("one has one", "executor has the executor's", "other has other"));
}

TEST(Fiber, AnExceptionOnItsWayIsNotTheExecutors) {
    struct Waits {
        Fiber& fiber;
        int& seen;
        ~Waits() {
            fiber.give_back();
            seen = std::uncaught_exceptions();
        }
    };
    int seen = -1;
    Fiber fiber;
    Calls code([&] {
        try {
            const Waits waits{fiber, seen};
            throw 1;
        } catch (int) {
        }
    });
    fiber.start(code);  // in the destructor, with the exception on its way
    EXPECT_EQ(std::uncaught_exceptions(), 0);
    EXPECT_EQ(std::current_exception(), nullptr);
    fiber.go_on();
    EXPECT_EQ(seen, 1);
    EXPECT_TRUE(fiber.ended());
}

TEST(FiberDeathTest, AnExceptionDoesNotLeaveTheCode) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_DEATH(
        {
            Fiber fiber;
            Calls code([] { throw 1; });
            try {
                fiber.start(code);
            } catch (int) {
            }
            std::exit(0);
        },
        "");
}

// ---- the stack ----

// Calls itself until so much of the stack is taken below `top`; gives the number of calls.
int go_deep(const char* top, size_t bytes) {
    std::array<volatile char, 1000> frame{};
    frame[bytes % frame.size()] = 1;
    if (static_cast<size_t>(top - frame_here()) >= bytes) return frame[bytes % frame.size()];
    return go_deep(top, bytes) + frame[bytes % frame.size()];
}

TEST(Fiber, ItsStackHolds900Kilobytes) {
    Fiber fiber;
    int calls = 0;
    Calls code([&calls] { calls = go_deep(frame_here(), 900'000); });
    fiber.start(code);
    EXPECT_GT(calls, 100);  // not one large frame, which might step over the guard
    EXPECT_TRUE(fiber.ended());
}

TEST(FiberDeathTest, ACallTooDeepEndsTheProgramAtTheGuard) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    EXPECT_DEATH(
        {
            Fiber fiber;
            Calls code([] { std::exit(go_deep(frame_here(), 4 * kFiberStackBytes) == 0 ? 1 : 0); });
            fiber.start(code);
        },
        "");
}

}  // namespace
}  // namespace vagus::run
