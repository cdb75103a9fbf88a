#include "serve/worker.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <semaphore>
#include <stdexcept>
#include <string>

namespace vagus::serve {
namespace {

using namespace std::chrono_literals;

TEST(Worker, WorkIsDoneElsewhereAndWhatComesOfItHereInOrder) {
    std::counting_semaphore<> news{0};
    Worker worker([&] { news.release(); });
    const auto here = std::this_thread::get_id();
    std::string order;
    for (const char letter : {'a', 'b', 'c'}) {
        worked<Result<char>>(
            worker.poster(),
            [letter, here]() -> Result<char> {
                if (std::this_thread::get_id() == here) return '!';
                return letter;
            },
            [&](const Result<char>& got) { order += got.value(); });
    }
    EXPECT_EQ(order, "");
    for (int i = 0; i < 3; ++i) {
        ASSERT_TRUE(news.try_acquire_for(20s));
    }
    worker.tick();
    EXPECT_EQ(order, "abc");
    worker.tick();
    EXPECT_EQ(order, "abc");
}

TEST(Worker, WhatIsThrownIsAnError) {
    std::string what;
    worked<Status>(
        Worker::at_once, []() -> Status { throw std::runtime_error("the disk is gone"); },
        [&](const Status& status) { what = status.error().what; });
    EXPECT_EQ(what, "the disk is gone");
}

// The piece under way ends, the others are dropped: nothing is called behind the end.
TEST(Worker, ItsEndWaitsForThePieceUnderWayOnly) {
    std::counting_semaphore<> begun{0}, go_on{0};
    int done = 0;
    {
        Worker worker([] {});
        worker.post([&]() -> Worker::Then {
            begun.release();
            go_on.acquire();
            ++done;
            return [&] { ADD_FAILURE() << "nobody ticks any more"; };
        });
        ASSERT_TRUE(begun.try_acquire_for(20s));
        go_on.release();
    }
    EXPECT_EQ(done, 1);
}

}  // namespace
}  // namespace vagus::serve
