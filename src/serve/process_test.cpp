#include "serve/process.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <csignal>

namespace vagus::serve {
namespace {

using testing::HasSubstr;

std::pair<Pipe, Pipe> pair_of_pipes() {
    int ends[2];
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    return {Pipe(ends[0]), Pipe(ends[1])};
}

// Until the child has ended, or said something.
void wait_for(Child& child, std::vector<Packet>& heard) {
    while (!child.ended() && heard.empty()) {
        child.pipe().wait(1000);
        for (Packet& packet : child.pipe().receive()) heard.push_back(std::move(packet));
    }
}

TEST(Pipe, PacketsArriveWholeAndInOrder) {
    auto [here, there] = pair_of_pipes();
    const std::string large(300'000, 'x');
    ASSERT_TRUE(here.send('J', "one"));
    ASSERT_TRUE(here.send('F', ""));
    ASSERT_TRUE(here.send('B', large));
    std::vector<Packet> got;
    while (got.size() < 3) {
        here.flush();
        for (Packet& packet : there.receive()) got.push_back(std::move(packet));
    }
    EXPECT_EQ(got[0].kind, 'J');
    EXPECT_EQ(got[0].bytes, "one");
    EXPECT_EQ(got[1].bytes, "");
    EXPECT_EQ(got[2].bytes, large);
}

TEST(Pipe, AnOtherEndThatReadsNothingDoesNotFillTheMemory) {
    auto [here, there] = pair_of_pipes();
    const std::string piece(1u << 20, 'x');
    int sent = 0;
    while (sent < 1000 && here.send('B', piece)) ++sent;
    EXPECT_LT(sent, 70);
    EXPECT_FALSE(here.closed());
}

TEST(Pipe, NonsenseAndTheEndClose) {
    int ends[2];
    ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
    Pipe pipe(ends[0]);
    ASSERT_EQ(::send(ends[1], "\xff\xff\xff\xffJ", 5, 0), 5);
    EXPECT_TRUE(pipe.receive().empty());
    EXPECT_TRUE(pipe.closed());
    EXPECT_FALSE(pipe.send('J', "x"));
    ::close(ends[1]);
}

TEST(Child, SpeaksOverItsDescriptorAndEnds) {
    auto child = Child::start(
        {"/bin/sh", {"-c", "printf '\\002\\000\\000\\000Jhi' >&3; read line <&3; exit 7"}});
    ASSERT_TRUE(child.ok());
    std::vector<Packet> heard;
    wait_for(child.value(), heard);
    ASSERT_EQ(heard.size(), 1u);
    EXPECT_EQ(heard[0].bytes, "hi");
    EXPECT_FALSE(child.value().ended());
    child.value().pipe().send('J', "\n");
    heard.clear();
    wait_for(child.value(), heard);
    EXPECT_EQ(child.value().ended()->what, "exited with status 7");
    EXPECT_FALSE(child.value().ended()->good);
}

TEST(Child, ACrashIsToldByItsSignal) {
    auto child = Child::start({"/bin/sh", {"-c", "kill -SEGV $$"}});
    std::vector<Packet> heard;
    wait_for(child.value(), heard);
    EXPECT_EQ(child.value().ended()->signal, 11);
    EXPECT_THAT(child.value().ended()->what, HasSubstr("Segmentation fault"));
}

TEST(Child, OneThatHangsCanBeKilled) {
    auto child =
        Child::start({"/bin/sh", {"-c", "trap '' TERM INT; while :; do read x <&3; done"}});
    EXPECT_FALSE(child.value().ended());
    child.value().kill();
    std::vector<Packet> heard;
    wait_for(child.value(), heard);
    EXPECT_EQ(child.value().ended()->signal, 9);
}

// A connection that a run holds, too, would stay open when the studio closes it.
TEST(Child, HasNothingOpenButItsDescriptor) {
    constexpr int kOpen = 50;
    ASSERT_EQ(dup2(STDIN_FILENO, kOpen), kOpen);  // without the mark that closes it
    auto child =
        Child::start({"/bin/sh", {"-c", "[ -e /proc/$$/fd/3 ] && [ ! -e /proc/$$/fd/50 ]"}});
    std::vector<Packet> heard;
    wait_for(child.value(), heard);
    EXPECT_EQ(child.value().ended()->what, "exited with status 0");
    auto printing =
        Printing::start({"sh", "-c", "[ -e /proc/$$/fd/50 ] && echo open || echo closed"});
    ASSERT_TRUE(printing.ok());
    while (!printing.value().read()) {
    }
    EXPECT_EQ(printing.value().text(), "closed\n");
    ::close(kOpen);
}

// The parent of the studio may ignore SIGCHLD: the system then keeps no end, and one that is never
// told would be waited for.
TEST(Child, AnEndThatTheSystemDoesNotKeepIsToldAllTheSame) {
    const auto before = signal(SIGCHLD, SIG_IGN);
    auto child = Child::start({"/bin/sh", {"-c", "exit 0"}});
    std::vector<Packet> heard;
    wait_for(child.value(), heard);
    EXPECT_EQ(child.value().ended()->what, "ended; the system does not tell how");
    EXPECT_FALSE(child.value().ended()->good);
    signal(SIGCHLD, before);
}

TEST(Child, AProgramThatIsNotThereEndsAtOnce) {
    auto child = Child::start({"/nonexistent/program", {}});
    std::vector<Packet> heard;
    wait_for(child.value(), heard);
    EXPECT_EQ(child.value().ended()->what, "exited with status 127");
}

TEST(Random, TokensDiffer) {
    EXPECT_EQ(random_bytes(16).size(), 16u);
    EXPECT_NE(random_bytes(16), random_bytes(16));
}

}  // namespace
}  // namespace vagus::serve
