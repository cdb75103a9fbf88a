#include "run/workers.hpp"

#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>

namespace vagus::run {
namespace {

// A door that stays shut until it is opened; shared with a thread that may outlive the test.
struct Door {
    std::mutex mutex;
    std::condition_variable changed;
    int passed = 0;
    bool open = false;

    void pass() {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this] { return open; });
        ++passed;
        changed.notify_all();
    }
    void unlock() {
        const std::lock_guard lock(mutex);
        open = true;
        changed.notify_all();
    }
    void wait_for_passed(int wanted) {
        std::unique_lock lock(mutex);
        changed.wait(lock, [this, wanted] { return passed >= wanted; });
    }
};

TEST(Workers, AJobThatBlocksHoldsUpNoOther) {
    auto shut = std::make_shared<Door>();
    auto open = std::make_shared<Door>();
    open->unlock();
    Workers workers;
    workers.start([shut] { shut->pass(); });
    workers.start([open] { open->pass(); });
    open->wait_for_passed(1);
    shut->unlock();
}

TEST(Workers, TheirEndWaitsForJobs) {
    auto door = std::make_shared<Door>();
    {
        Workers workers;
        workers.start([door] { door->pass(); });
        door->unlock();
    }
    EXPECT_EQ(door->passed, 1);
}

// Were it waited for, this test would hang.
TEST(Workers, AJobThatWasLeftIsNotWaitedFor) {
    auto door = std::make_shared<Door>();
    {
        Workers workers;
        const Workers::Job job = workers.start([door] { door->pass(); });
        workers.leave(job);
    }
    EXPECT_EQ(door->passed, 0);
    door->unlock();
    door->wait_for_passed(1);
}

// The thread may do another job by then, which is not meant.
TEST(Workers, LeavingAJobThatIsOverHasNoEffect) {
    auto first = std::make_shared<Door>();
    auto second = std::make_shared<Door>();
    first->unlock();
    {
        Workers workers;
        const Workers::Job job = workers.start([first] { first->pass(); });
        first->wait_for_passed(1);
        workers.start([second] { second->pass(); });
        second->unlock();
        second->wait_for_passed(1);
        workers.leave(job);
    }
    EXPECT_EQ(second->passed, 1);
}

}  // namespace
}  // namespace vagus::run
