#include "cli/plan/debug_lines.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cstdlib>
#include <string_view>

#include "net/end_signal.hpp"

namespace vagus::cli {
namespace {

constexpr int kAsExpected = 7;

// stdin is a pipe with this in it, which nobody closes. Gives its writing end.
int type(std::string_view text) {
    int ends[2];
    if (::pipe(ends) != 0) std::abort();
    ::dup2(ends[0], STDIN_FILENO);
    if (::write(ends[1], text.data(), text.size()) < 0) std::abort();
    return ends[1];
}

[[noreturn]] void leave(bool as_expected) {
    ::_exit(as_expected ? kAsExpected : 1);
}

// Each in a process of its own: signals belong to the whole of one. A signal that comes just before
// the wait for input comes here before it.
#define EXPECT_IN_A_PROCESS(statement) \
    EXPECT_EXIT(statement, testing::ExitedWithCode(kAsExpected), "")

void end_before_the_wait() {
    (void)type("");
    net::watch_for_end(net::EndBy::AnyButCtrlC);
    PromptLines lines({});
    ::raise(SIGTERM);
    leave(!lines.next("").has_value());
}

void interrupt_before_the_wait() {
    const int input = type("");
    PromptLines lines({});
    ::raise(SIGINT);
    bool good = lines.next("") == "" && lines.take_interrupt() && !lines.take_interrupt();
    if (::write(input, "where\n", 6) != 6) std::abort();
    good = good && lines.next("") == "where";
    leave(good);
}

void lines_and_a_last_one_without_its_end() {
    const int input = type("trace on\n\nrun");
    PromptLines lines({});
    bool good = lines.next("") == "trace on" && lines.next("") == "";
    ::close(input);
    good = good && lines.next("") == "run" && !lines.next("").has_value();
    leave(good);
}

void a_line_that_is_too_long() {
    int ends[2];
    if (::pipe(ends) != 0) std::abort();
    ::dup2(ends[0], STDIN_FILENO);
    if (::fork() == 0) {  // more than the pipe takes at once
        const std::string line(kPromptLineMax + 1, 'x');
        const bool written = ::write(ends[1], line.data(), line.size()) > 0;
        ::_exit(written && ::write(ends[1], "\nstep\n", 6) == 6 ? 0 : 1);
    }
    PromptLines lines({});
    const auto line = lines.next("");
    leave(line && line->size() == kPromptLineMax && lines.next("") == "step");
}

TEST(PromptLines, ASignalBeforeTheWaitEndsIt) {
    EXPECT_IN_A_PROCESS(end_before_the_wait());
}

TEST(PromptLines, CtrlCBeforeTheWaitIsAnEmptyLineAndIsTakenOnce) {
    EXPECT_IN_A_PROCESS(interrupt_before_the_wait());
}

TEST(PromptLines, GivesLineByLine) {
    EXPECT_IN_A_PROCESS(lines_and_a_last_one_without_its_end());
}

TEST(PromptLines, WhatALineHasBeyondTheLimitIsLeftOut) {
    EXPECT_IN_A_PROCESS(a_line_that_is_too_long());
}

}  // namespace
}  // namespace vagus::cli
