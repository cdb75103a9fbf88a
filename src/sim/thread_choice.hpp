// Whether one thread or all of them step a world, found out by how long each takes: on a machine
// that others use, several threads may be slower than one (docs/decisions/0209). It is told the
// times and reads no clock.
//
//     ThreadChoice choice;
//     world.use_one_thread(choice.one());
//     …                                               // a piece of the run
//     choice.took(simulated, real);                   // and on with choice.one()
#pragma once

#include "base/time.hpp"

namespace vagus::sim {

// So much simulated time is a piece that is judged.
constexpr Duration kThreadTrial = std::chrono::milliseconds(50);
// So many pieces of each kind are compared at first, in turn.
constexpr int kThreadTrials = 3;
// Then one piece of the kind that lost is tried after so many of the other: were it twice as slow,
// that would cost 2 %.
constexpr int kThreadTrialEvery = 50;
// Several threads must be so much better than one to be chosen: they take processors from others.
constexpr double kThreadGain = 0.95;

class ThreadChoice {
public:
    // The next piece is for one thread.
    bool one() const { return one_; }
    // `simulated` passed in `real` time.
    void took(Duration simulated, Duration real);

private:
    void end_piece(double cost);
    void choose();

    bool one_ = true;
    Duration simulated_{}, real_{};    // of the piece so far
    double alone_ = 0, together_ = 0;  // real time for a simulated one, the latest best
    int trials_ = 0;                   // pieces of the first comparison
    int since_trial_ = 0;              // pieces of the kind that was chosen
    bool chosen_one_ = true;
};

}  // namespace vagus::sim
