// For tests: a run without a process behind it; the test holds the other end of its pipe.
#pragma once

#include <gtest/gtest.h>
#include <sys/socket.h>

#include <memory>
#include <optional>

#include "serve/run/run.hpp"

namespace vagus::serve {

struct ScriptedRunner final : RunProcess {
    explicit ScriptedRunner(int descriptor) : own(descriptor) {}
    Pipe& pipe() override { return own; }
    std::optional<ChildEnd> ended() override { return std::nullopt; }
    void kill() override {}
    Pipe own;
};

// `end` is what the test reads and writes.
inline Result<std::unique_ptr<RunProcess>> start_scripted(std::optional<Pipe>& end) {
    int pair[2];
    EXPECT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, pair), 0);
    end.emplace(pair[1]);
    return std::unique_ptr<RunProcess>(std::make_unique<ScriptedRunner>(pair[0]));
}

}  // namespace vagus::serve
