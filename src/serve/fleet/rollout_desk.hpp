// The roll-out that pages of a fleet give: another version of the project that is open, for robots
// in steps (fleet/rollout.hpp), and back again. Robots fetch it from here as long as this lives, or
// until the roll-out is stopped. What became of each is the topic rollout, and is kept in a file:
// who starts the studio again reads how far it came. One thread, told the time.
//
//     RolloutDesk rollouts(desk, {.version = [&] { return open_version(); }});
//     rollouts.begin({.fleet = "lab", .robots = {"r1", "r2"}, .steps = "1,100%"}, now, done);
//     for (const fleet::LinkEvent& event : link.take()) rollouts.hear(event, now);
//     rollouts.tick(now);
//     for (const fleet::Post& post : rollouts.take()) link.publish(post);
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "base/time.hpp"
#include "fleet/rollout.hpp"
#include "serve/json.hpp"
#include "serve/studio/desk.hpp"
#include "serve/web/shelf.hpp"
#include "serve/worker.hpp"

namespace vagus::serve {

using namespace std::chrono_literals;

constexpr Duration kRolloutShownEvery = 200ms;
constexpr Duration kRolloutKeptEvery = 1s;  // at most, while it runs; its end is kept at once
// Of what is wanted: who acknowledges it.
constexpr uint64_t kWantNumber = uint64_t{1} << 62;

struct PackedVersion {
    std::string bytes, sha256;
};
// The project that is open.
struct OpenVersion {
    std::string name;
    std::vector<std::string> unsaved = {};        // its files whose changes are not on disk
    std::function<Result<PackedVersion>()> pack;  // called on another thread; what is on disk
};

struct RolloutPlaces {
    ShelfOptions shelf = {};
    std::function<std::optional<OpenVersion>()> version = [] {
        return std::optional<OpenVersion>();
    };
    Worker::Post work = Worker::at_once;
    std::string file = {};  // where it is kept; empty: nowhere
};

class RolloutDesk {
public:
    struct Order {
        std::string fleet = {}, target = {};   // its name, its address
        bool broker_is_here = false;           // on this computer: so are robots
        std::vector<std::string> robots = {};  // in this order
        std::string steps = fleet::kStepsUnlessTold;
        std::vector<std::string> without = {};  // files whose unsaved changes are not part of it
        std::string by = {};
    };
    using Done = std::function<void(const Status& begun)>;

    // Declares the topic rollout.
    RolloutDesk(Desk& desk, RolloutPlaces places);

    // `done` is told when the first robot is, or why that cannot be.
    void begin(Order order, Time now, Done done);
    // Robots that have the version of the last one get the one before, all at once. `robots` and
    // `steps` of the order do not matter.
    Status roll_back(const Order& order, Time now);
    // No other robot gets it, and it is served no longer.
    Status stop(const std::string& by);
    // A fleet is opened: of the last roll-out there it is heard what becomes of its robots.
    void enter(const std::string& target);
    // It is closed: what is said there is heard no longer, either.
    void leave(const std::string& why);

    void hear(const fleet::LinkEvent& event, Time now);
    void tick(Time now);
    Time next_tick() const;
    std::vector<fleet::Post> take();
    bool runs() const { return state_ == "running"; }

private:
    void packed(const Order& order, const std::string& project,
                const vagus::Result<PackedVersion>& version, const Done& done);
    void start(fleet::Rollout::Options options, std::unique_ptr<Shelf> shelf);
    void halt(const std::string& why);
    void end(const char* state, const std::string& why);
    void changed();
    void keep();
    void read_kept();
    Json document() const;
    Json last_document() const;

    Desk& desk_;
    const RolloutPlaces places_;
    std::unique_ptr<Shelf> shelf_;
    std::optional<fleet::Rollout> rollout_;
    std::vector<fleet::Rollout::Line> lines_;  // also of one that a studio before this one left
    std::string state_ = "none";               // none, running, well, failed, left
    bool packing_ = false, back_ = false, told_unkept_ = false;
    std::string target_, version_, by_, why_;
    double begun_wall_ = 0;
    int64_t number_ = 0;  // of its wish
    Time now_{}, next_shown_{}, next_kept_{};
    bool to_show_ = false, to_keep_ = false;
};

}  // namespace vagus::serve
