// Programs of the system that a broker needs: openssl, mosquitto_passwd, mosquitto. They are looked
// for in PATH and in /usr/sbin, where Debian has mosquitto; one with a / is taken as it is.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"

namespace vagus::cli {

// Quiet unless it fails: then the Error has its last words.
Status run_to_end(const std::vector<std::string>& words);

// A program that runs beside this one and ends with it, whatever ends this one.
class Companion {
public:
    static Result<Companion> start(const std::vector<std::string>& words);
    ~Companion();
    Companion(Companion&& other) noexcept;
    Companion& operator=(Companion&& other) noexcept;

    // If it has ended by itself, how: "exited with status 1"; each end is told once.
    std::optional<std::string> ended();
    // It is told to end, and has ended when this returns.
    void end();

private:
    explicit Companion(int process) : process_(process) {}
    int process_ = -1;
};

}  // namespace vagus::cli
