#include "base/process_copy.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace vagus {
namespace {

// ---- what copies do in these tests ----

enum Word : uint32_t { kBegan = 1, kCopy, kAnswer, kWork };

// Hears nothing.
[[noreturn]] void work_for_ever() {
    while (own_number() > 0) {
    }
    end_copy();
}

// Tells who it is; each kCopy makes another one, kAnswer is answered by what is open.
[[noreturn]] void serve(CopyLink link) {
    (void)link.send({.word = kBegan, .number = own_number(), .handed = own_handle()});
    while (auto asked = link.receive()) {
        if (asked->word == kCopy && copy_again(asked->handed) == 0) {
            link = CopyLink(Descriptor());
            serve(CopyLink(std::move(asked->handed)));
        }
        if (asked->word == kCopy) continue;
        if (asked->word == kWork) work_for_ever();
        int open_ones = 0;
        for (int one = STDERR_FILENO + 1; one < 256; ++one) {
            if (fcntl(one, F_GETFD) >= 0) ++open_ones;
        }
        (void)link.send({.word = kAnswer, .number = open_ones, .text = asked->text});
    }
    end_copy();
}

struct Held {
    CopyLink link;
    CopyProcess process;
};

Held held(CopyLink link) {
    std::optional<CopyMessage> began = link.receive();
    EXPECT_TRUE(began && began->handed.is_open());
    return {std::move(link), CopyProcess(began->number, std::move(began->handed))};
}

Held first_copy(const Supervision& supervision) {
    auto ends = CopyLink::make();
    EXPECT_TRUE(ends.ok());
    auto& [mine, its] = ends.value();
    if (supervision.copy(its.descriptor()) == 0) {
        mine = CopyLink(Descriptor());
        serve(std::move(its));
    }
    return held(std::move(mine));
}

Held copy_of(const Held& copy) {
    auto ends = CopyLink::make();
    EXPECT_TRUE(ends.ok());
    auto& [mine, its] = ends.value();
    EXPECT_TRUE(copy.link.send({.word = kCopy, .handed = std::move(its).take()}));
    return held(std::move(mine));
}

// Waits for it: a test that waits here for ever has found one that is left behind.
bool has_ended(const Descriptor& process) {
    pollfd ends{process.number(), POLLIN, 0};
    while (poll(&ends, 1, -1) < 0) {
    }
    return (ends.revents & POLLIN) != 0;
}

// ---- the promises ----

TEST(ProcessCopy, HasNothingOpenButItsLink) {
    const Supervision supervision;
    const Descriptor other(open("/dev/null", O_RDONLY));
    const Held copy = first_copy(supervision);
    const Held second = copy_of(copy);
    for (const Held* one : {&copy, &second}) {
        ASSERT_TRUE(one->link.send({.word = kAnswer, .text = std::string(300000, 'x')}));
        const auto answer = one->link.receive();
        ASSERT_TRUE(answer);
        EXPECT_EQ(answer->number, 1);
        EXPECT_EQ(answer->text.size(), 300000u);
    }
}

TEST(ProcessCopy, LivesOnWhenTheOneThatItWasMadeByEnds) {
    const Supervision supervision;
    Held first = first_copy(supervision);
    Held second = copy_of(first);
    const Held third = copy_of(second);
    first.process.end();
    second.process.end();
    ASSERT_TRUE(third.link.send({.word = kAnswer, .text = "there?"}));
    const auto answer = third.link.receive();
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->text, "there?");
    EXPECT_FALSE(first.link.receive());
}

TEST(ProcessCopy, NoneIsLeftWhenTheFirstProcessIsKilled) {
    const Supervision adopts;  // what the killed one leaves behind, so that this test sees its end
    auto ends = CopyLink::make();
    ASSERT_TRUE(ends.ok());
    auto& [mine, its] = ends.value();
    const int64_t supervisor = copy_of_process();
    if (supervisor == 0) {
        const Supervision supervision;
        const Held first = first_copy(supervision);
        const Held second = copy_of(first);
        const Held third = copy_of(second);
        for (const Held* one : {&first, &second, &third}) {
            (void)its.send({.word = kBegan, .number = one->process.number()});
        }
        (void)second.link.send({.word = kWork});  // one of them does not look at its link
        (void)its.receive();                      // until it is killed
        end_copy();
    }
    its = CopyLink(Descriptor());
    std::vector<Descriptor> copies;
    for (int i = 0; i < 3; ++i) {
        const auto told = mine.receive();
        ASSERT_TRUE(told);
        copies.push_back(handle_of(told->number));
        ASSERT_TRUE(copies.back().is_open());
    }
    ASSERT_EQ(kill(static_cast<pid_t>(supervisor), SIGKILL), 0);
    for (const Descriptor& one : copies) EXPECT_TRUE(has_ended(one));
    while (waitpid(-1, nullptr, 0) > 0) {
    }
}

TEST(ProcessCopy, AMessageThatIsTooLargeIsNotSent) {
    const auto ends = CopyLink::make();
    ASSERT_TRUE(ends.ok());
    EXPECT_FALSE(ends.value().first.send({.text = std::string(kCopyTextMax + 1, 'x')}));
}

TEST(ProcessCopy, ThisTestHasOneThread) {
    EXPECT_EQ(threads_of_process(), 1u);
}

}  // namespace
}  // namespace vagus
