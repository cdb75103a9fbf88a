// One file by HTTP or HTTPS: the version that a robot of a fleet is told to run.
//
//     const std::string bytes = TRY(fetch("https://desk.local:8443/TOKEN/version", "ca.crt", most));
//
// It blocks: for another thread than the loop's.
#pragma once

#include <chrono>
#include <string>

#include "base/result.hpp"

namespace vagus::serve {

constexpr auto kFetchWithin = std::chrono::seconds(60);  // from the connection to the last byte

// `authority`: PEM file of who is trusted, besides those of this computer; empty: nobody else.
// Without TLS only from this computer itself. The Error names the address and what came of it.
Result<std::string> fetch(const std::string& url, const std::string& authority, size_t bytes_max);

}  // namespace vagus::serve
