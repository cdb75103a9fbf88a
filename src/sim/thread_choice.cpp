#include "sim/thread_choice.hpp"

#include <algorithm>

namespace vagus::sim {

void ThreadChoice::took(Duration simulated, Duration real) {
    simulated_ += simulated;
    real_ += real;
    if (simulated_ < kThreadTrial) return;
    end_piece(static_cast<double>(real_.count()) / static_cast<double>(simulated_.count()));
    simulated_ = real_ = {};
}

void ThreadChoice::end_piece(double cost) {
    double& known = one_ ? alone_ : together_;
    if (trials_ < 2 * kThreadTrials) {
        // The best of the first pieces: what disturbs one of them only makes it slower.
        known = known == 0 ? cost : std::min(known, cost);
        if (++trials_ < 2 * kThreadTrials) {
            one_ = !one_;
        } else {
            choose();
        }
        return;
    }
    known = cost;
    const bool was_trial = one_ != chosen_one_;
    if (was_trial) return choose();
    if (++since_trial_ < kThreadTrialEvery) return;
    one_ = !one_;  // the other, for one piece
}

void ThreadChoice::choose() {
    chosen_one_ = together_ >= kThreadGain * alone_;
    one_ = chosen_one_;
    since_trial_ = 0;
}

}  // namespace vagus::sim
