// Why things happened in a run that is run again: on each of its buses, with the plan beside it
// (bus_causes.hpp), and in its world (happenings.hpp). Collected while the run goes on; asked at
// its end, which is the instant that the question is about (why.hpp).
//
//     Causes causes(*rerun);                        // before rerun->run()
//     NullTape tape;
//     TRY(rerun->run(tape));
//     const BusCauses::Frame* frame = causes.bus(0).frame(number);
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "record/bus_causes.hpp"
#include "record/happenings.hpp"
#include "record/keeper_log.hpp"
#include "record/replay.hpp"
#include "sim/witness.hpp"

namespace vagus::record {

// For a run of which only the causes are wanted.
class NullTape final : public Tape {
public:
    uint16_t declare(const Topic&) override { return 1; }
    void put(uint16_t, Time, std::string_view) override {}
    void put_later(uint16_t, Time, size_t, Word) override {}
};

class Causes final : private sim::Witness, private embed::RobotsWatcher {
public:
    // Borrowed; before its run().
    explicit Causes(Rerun& rerun);
    ~Causes() override;

    // The first is the common bus, or the only one; then those of robots with projects of their
    // own.
    size_t buses() const { return buses_.size(); }
    const BusCauses& bus(size_t index) const { return *buses_[index]; }
    // Whether there are several.
    bool is_fleet() const { return buses_.size() > 1; }
    // That of the robot with that name; nothing: it is on the common one, or there is none.
    std::optional<size_t> bus_of(std::string_view robot) const;
    const Happenings& happenings() const { return happenings_; }
    // Of the fleet of the robot with that bus; nullptr: its keeper has decided nothing.
    const KeeperLog* keeper_of(size_t bus) const;
    Rerun& rerun() const { return rerun_; }

private:
    BusCauses& of(const sim::WitnessedNode& node) { return *by_robot_[node.robot]; }
    BusCauses& of_robot(size_t robot) { return *buses_[robot + 1]; }

    // ---- sim::Witness ----
    void began_by_frame(const sim::WitnessedNode& node, uint16_t pc, uint32_t frame) override {
        of(node).began_by_frame(node, pc, frame);
    }
    void began_by_itself(const sim::WitnessedNode& node, uint16_t pc, uint8_t event) override {
        of(node).began_by_itself(node, pc, event);
    }
    void wrote(const sim::WitnessedNode& node, uint16_t pc, uint16_t address,
               int16_t value) override {
        of(node).wrote(node, pc, address, value);
    }
    void called(const sim::WitnessedNode& node, uint16_t pc, uint16_t native) override {
        of(node).called(node, pc, native);
    }
    void sends(const sim::WitnessedNode& node, uint16_t pc) override { of(node).sends(node, pc); }
    void sent(const sim::WitnessedNode& node, uint32_t frame) override {
        of(node).sent(node, frame);
    }
    // ---- embed::RobotsWatcher ----
    void line(size_t robot, const plan::TraceEvent& event) override { of_robot(robot).line(event); }
    bool passes_over(size_t robot, const run::Raising& raising) override {
        of_robot(robot).raising(raising);
        return false;
    }
    void sent(size_t robot, const run::BusEvent& event) override {
        of_robot(robot).plan_sent(event);
    }
    void of_fleet(size_t robot, const embed::FromFleet& what) override;
    void stopped(size_t robot, const std::string& why) override;

    Rerun& rerun_;
    Happenings happenings_;
    std::vector<std::unique_ptr<BusCauses>> buses_;
    std::vector<BusCauses*> by_robot_;          // by number of the robot
    std::map<std::string, KeeperLog> keepers_;  // by fleet
};

}  // namespace vagus::record
