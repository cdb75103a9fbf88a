// What the server is told of a world, without being asked: frames of its bus, what happens there
// and records for the history, what is where, what sensors and cameras see.
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

// Of cameras, whether somebody looks or not: a picture is computed for the history alone.
constexpr Duration kPictureEvery = std::chrono::seconds(1);
constexpr size_t kPictureRobotsMax = 4;  // of further ones none are kept
constexpr size_t kHappenedAtOnce = 500;  // so many wait at most to be told

class WorldShow {
public:
    // Borrowed.
    explicit WorldShow(Teller& teller) : teller_(teller) {}

    // Another world, or one that is to be told as a whole again.
    void begin();
    // Until begin() the history is told from here what happens on the bus, beginning with the nodes
    // that are there: of a run that is run again, for which no server hears the bus. Borrowed, for
    // as long as it runs.
    void follow(session::SimSession& session);
    // Another host has loaded that node.
    void loaded(const session::SimSession& session, uint16_t node);
    // What costs time is made only while somebody looks.
    void want(const talk::Show& show) { wanted_ = show; }

    void tell_frames(session::SimSession& session, hub::LinkId link);
    // Writes down what changed; much of it is told at once.
    void record(const session::SimSession& session);
    // What is written down, and what happened. A server that takes nothing misses records, not the
    // run.
    void tell_past();
    void tell_poses(const session::SimSession& session);
    // If it is another one than was told.
    void tell_scene(const session::SimSession& session);
    void tell_pictures(const session::SimSession& session);

private:
    void tell_records();
    void keep_pictures(const session::SimSession& session);
    void hear(const session::SimSession& session, const debug::Event& event);
    void happen(const session::SimSession& session, Happened happened);

    Teller& teller_;
    Recorder recorder_;
    bool follows_ = false;
    talk::HappenedNow happened_;  // not told yet
    talk::Show wanted_;
    talk::Scene scene_;  // as it was told
    Time next_picture_{};
};

}  // namespace vagus::serve
