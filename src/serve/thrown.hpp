// The one place where an exception of work on what came from outside ends: a command, a message of
// a child process, a folder. What was wrong becomes a sentence, and the server goes on.
//
//     if (const auto thrown = thrown_by([&] { obey(call); })) call.fail("failed", *thrown);
#pragma once

#include <exception>
#include <optional>
#include <string>

namespace vagus::serve {

template <typename Work>
std::optional<std::string> thrown_by(const Work& work) {
    try {
        work();
        return std::nullopt;
    } catch (const std::exception& thrown) {
        return std::string(thrown.what());
    }
}

}  // namespace vagus::serve
