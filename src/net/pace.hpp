// Does a receiver keep up? Somebody who sends much at once is made to wait for receivers that do,
// and for no others (docs/decisions/0052-who-waits-for-whom.md). Pure arithmetic.
#pragma once

#include <cstddef>

#include "base/time.hpp"

namespace vagus::net {

// A read of at least so many bytes is much at once. Below, nobody ever waits.
constexpr size_t kBulkBytes = 4 * 1024;
// A receiver for which so many bytes wait is behind.
constexpr size_t kBehindBytes = 64 * 1024;
// A receiver that is behind keeps up as long as it takes so many bytes in every period.
constexpr size_t kPaceBytes = 16 * 1024;
constexpr Duration kPacePeriod = std::chrono::milliseconds(50);

class Pace {
public:
    void took(size_t bytes) { taken_ += bytes; }

    // Is this receiver, for which so many bytes wait now, worth waiting for?
    bool worth_waiting_for(Time now, size_t waiting) {
        if (waiting < kBehindBytes) {
            behind_ = false;
            return false;
        }
        if (!behind_) {
            behind_ = keeps_up_ = true;
            begin_period(now);
        } else if (now - period_began_ >= kPacePeriod) {
            keeps_up_ = taken_ >= kPaceBytes;
            begin_period(now);
        }
        return keeps_up_;
    }

private:
    void begin_period(Time now) {
        period_began_ = now;
        taken_ = 0;
    }

    bool behind_ = false;
    bool keeps_up_ = true;
    Time period_began_{};
    size_t taken_ = 0;
};

}  // namespace vagus::net
