// One run of a plan, in real or in virtual time: its caller chooses the clock, and all else
// is the same.
//
//     Execution run(graph, library, options, Clock::Real);
//     const Ended ended = run.run();            // from other threads: abort(), set(), hear()
#pragma once

#include <cstdint>
#include <memory>

#include "run/code.hpp"
#include "run/options.hpp"
#include "run/real_time.hpp"
#include "run/virtual_time.hpp"

namespace vagus::run {

enum class Clock : uint8_t { Real, Virtual };

class Execution {
public:
    // All three are borrowed for the life of the run.
    Execution(const plan::Graph& graph, const CodeLibrary& library, const RunOptions& options,
              Clock clock) {
        if (clock == Clock::Virtual) {
            virtual_ = std::make_unique<VirtualTime>(graph, library, options);
        } else {
            real_ = std::make_unique<RealTime>(graph, library, options);
        }
    }

    Ended run() { return virtual_ ? virtual_->run() : real_->run(); }

    // From any thread, also before run().
    void abort() { virtual_ ? virtual_->abort() : real_->abort(); }
    // Writes a variable of the outermost plan (P29). In real time from any thread; in virtual time
    // for on_trace and actors' code.
    void set(int slot, plan::Value value) {
        virtual_ ? virtual_->set(slot, std::move(value)) : real_->set(slot, std::move(value));
    }
    // From now on what is random in the code of actors is drawn from that seed: in virtual time,
    // for on_trace and actors' code. In real time it stays as it is.
    void reseed(uint64_t seed) {
        if (virtual_) virtual_->reseed(seed);
    }
    // That in real time; nullptr in virtual time, where nothing comes from outside.
    RealTime* real_time() { return real_.get(); }

private:
    std::unique_ptr<VirtualTime> virtual_;  // one of the two
    std::unique_ptr<RealTime> real_;
};

}  // namespace vagus::run
