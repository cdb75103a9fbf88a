// A process that works for a long time and says now and then how far it is: the one that runs
// tests, the one that looks for a turning point.
//
//     process.begin(TRY(start()));
//     process.ask(kTestsOrdered, order);
//     process.tick(now, [&](const Packet& packet) { hear(packet); });
//     if (const std::string how = process.gone(); !how.empty()) say("the process " + how);
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/time.hpp"
#include "serve/run/run.hpp"

namespace vagus::serve {

class TellingProcess {
public:
    void begin(std::unique_ptr<RunProcess> process);
    // Kills it.
    void end() { process_.reset(); }
    bool is_there() const { return process_ != nullptr; }

    // ---- while it is there ----
    void ask(char kind, const std::string& question) { process_->pipe().send(kind, question); }
    // Hands over what it has said since. `hear` may end() it.
    void tick(Time now, const std::function<void(const Packet&)>& hear);
    // Nothing more will come: "ended with status 1". Empty: it goes on.
    std::string gone();
    // The time since the last packet, as of the last tick.
    Duration silent() const { return now_ - heard_.value_or(now_); }

private:
    std::unique_ptr<RunProcess> process_;
    Time now_{};
    std::optional<Time> heard_;  // set by the first tick
};

}  // namespace vagus::serve
