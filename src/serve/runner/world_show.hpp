// What the server is told of a world, without being asked: frames of its bus, records for the
// history, what is where, what sensors and cameras see.
//
//     WorldShow show(teller);
//     show.begin();
//     show.tell_frames(session, link);     // at each instant
//     show.record(session);
//     show.tell_scene(session);            // now and then
#pragma once

#include <set>
#include <string>

#include "serve/runner/recorder.hpp"
#include "serve/runner/teller.hpp"
#include "session/sim_session.hpp"

namespace vagus::serve {

class WorldShow {
public:
    // Borrowed.
    explicit WorldShow(Teller& teller) : teller_(teller) {}

    // Another world.
    void begin() { recorder_.begin(); }
    // What costs time is made only while somebody looks.
    void want(const talk::Show& show) { wanted_ = show; }

    void tell_frames(session::SimSession& session, hub::LinkId link);
    // Writes down what changed; much of it is told at once.
    void record(const session::SimSession& session);
    // What is written down. A server that takes nothing misses it, not the run.
    void tell_records();
    void tell_poses(const session::SimSession& session);
    // If it is another one than was told.
    void tell_scene(const session::SimSession& session);
    void tell_pictures(const session::SimSession& session);

private:
    Teller& teller_;
    Recorder recorder_;
    talk::Show wanted_;
    talk::Scene scene_;  // as it was told
};

}  // namespace vagus::serve
