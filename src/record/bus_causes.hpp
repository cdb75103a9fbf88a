// What followed from what on one bus of a run that is run again, and in the plan beside it: each
// frame, each run of a handler, each line of the trace. Told what happens while the run goes on
// (causes.hpp); asked at its end.
//
//     const BusCauses::Frame* frame = bus.frame(number);
//     if (frame != nullptr) show(bus.run(frame->deed.run)->pc);
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "embed/robots_watcher.hpp"
#include "record/happenings.hpp"
#include "record/replay.hpp"
#include "sim/witness.hpp"

namespace vagus::record {

class BusCauses {
public:
    static constexpr Time kNotYet = Time::min();
    // Numbers count from 1; 0 is none.
    struct HandlerRun {
        Time at{};
        sim::WitnessedNode node;
        uint16_t pc = 0;
        uint32_t frame = 0;  // that started it …
        int event = -1;      // … or the local event, from 0
        // What the node had felt, by then: a happening in the world.
        uint32_t happening = 0;
        uint32_t call = 0;  // of the native that was called last on the node
    };
    // What a node wrote, called or sent: in which run, at which instruction.
    struct Deed {
        Time at = kNotYet;
        uint32_t run = 0;  // 0: the script began, and no event had come yet
        uint16_t pc = 0;
        int16_t value = 0;  // of a write
        bool host = false;  // a host set it
    };
    struct Call {
        Deed deed;
        sim::WitnessedNode node;
        uint16_t native = 0;
    };
    struct Frame {
        Time at{};
        std::string event;  // its name; empty: no user event
        std::vector<int16_t> arguments;
        uint16_t source = 0;
        sim::WitnessedNode node;  // robot 0: a host, or of_bus
        Deed deed;                // of a node
        std::string by;           // of the plan: the element whose code emitted it …
        size_t line = 0;          // … how many lines the trace had then …
        uint32_t cause = 0;   // … and what this code had heard last; or what the fleet brought
        bool of_bus = false;  // of a node of a real bus, whose script nobody has seen run
    };
    struct Line {
        plan::TraceEvent event;
        std::string text;  // as in the trace
    };
    // What the fleet has brought to the robot.
    struct Message {
        Time at{};
        embed::FleetEvent event;
        uint32_t frame = 0;  // of the sender's bus, by which it went out; 0: not known
    };

    // What its plan was told of the fleet.
    struct News {
        Time at{};
        std::vector<session::FleetNews> items;
    };
    // What its plan asked the keeper of the fleet.
    struct Asked {
        Time at{};
        keeper::Request request;
        size_t line = 0;  // how many lines the trace had then
    };

    // Both borrowed; before the run. A bus without a session is that of a plan alone.
    BusCauses(const RunBus& bus, const Happenings& happenings);
    BusCauses(const BusCauses&) = delete;
    BusCauses& operator=(const BusCauses&) = delete;

    const RunBus& bus() const { return bus_; }
    const std::vector<Line>& lines() const { return lines_; }
    // Whether more was due as that line's event was raised, that it has ended (ties.hpp).
    bool tied(size_t line) const { return raised_.contains(line) && raised_.at(line); }
    // Whether no check has raised that line's event: somebody did, in the debugger.
    bool by_hand(size_t line) const { return !raised_.contains(line); }
    // When the robot stopped by itself, and the happening that it was.
    const std::optional<std::pair<Time, uint32_t>>& stopped() const { return stopped_; }
    const Frame* frame(uint32_t number) const;
    const HandlerRun* run(uint32_t number) const;
    const Call* call(uint32_t number) const;
    const Message* message(uint32_t number) const;
    const News* news(uint32_t number) const;
    // When what has that number came: a frame, a message or news.
    std::optional<Time> heard_at(uint32_t number) const;
    const Asked* asked(uint64_t question) const;
    // The last frame with a user event of that name; 0: none.
    uint32_t last_event(std::string_view name) const;
    // The same before that frame, and of another sender: no node hears what it sends itself.
    uint32_t last_event_heard(std::string_view name, uint32_t before) const;
    std::vector<std::string> events_seen() const;  // their names
    // The last write to any of `count` words from `address` on.
    std::optional<Deed> last_write(const sim::WitnessedNode& node, uint16_t address,
                                   uint16_t count) const;
    // The last call of a native whose name begins so, on any node of the robot.
    uint32_t last_call(uint32_t robot, std::string_view prefix) const;

    // ---- what is told ----
    void began_by_frame(const sim::WitnessedNode& node, uint16_t pc, uint32_t frame);
    void began_by_itself(const sim::WitnessedNode& node, uint16_t pc, uint8_t event);
    void wrote(const sim::WitnessedNode& node, uint16_t pc, uint16_t address, int16_t value);
    void called(const sim::WitnessedNode& node, uint16_t pc, uint16_t native);
    void sends(const sim::WitnessedNode& node, uint16_t pc);
    void sent(const sim::WitnessedNode& node, uint32_t frame);
    void line(const plan::TraceEvent& event);
    void raising(const run::Raising& raising);  // before its line
    void plan_sent(const run::BusEvent& event);
    void fleet_brought(const embed::FleetEvent& event);
    void fleet_told(const embed::FleetTold& told) { news_[told.number] = {now(), told.news}; }
    void plan_asked(const embed::KeeperAsked& asked) {
        asked_[asked.question] = {now(), asked.request, lines_.size()};
    }
    void stops_alone(uint32_t happening) { stopped_ = {now(), happening}; }
    // Of a real bus: what was on it.
    void learn(const PastBus& past);

private:
    using NodeKey = uint64_t;
    static NodeKey key_of(const sim::WitnessedNode& node) {
        return (uint64_t{node.robot} << 16) | node.id;
    }
    struct OfNode {
        uint32_t run = 0;  // the handler that runs, or ran last
        uint32_t call = 0;
        std::vector<Deed> writes;  // by address: the last
        std::deque<Deed> sending;  // frames that have no number yet
    };
    // By the plan, or what the fleet brought (`by` is empty then).
    struct Emission {
        std::string event;
        std::string by;
        uint32_t cause = 0;
        size_t line = 0;
    };

    Time now() const;
    void begin_run(HandlerRun run);
    void frame_on_bus(const wire::Frame& frame, uint32_t number);
    void host_sets(const wire::Frame& frame);

    RunBus bus_;
    const Happenings& happenings_;
    std::vector<HandlerRun> runs_;
    std::vector<Call> calls_;
    std::map<uint32_t, Frame> frames_;
    std::map<uint32_t, Message> messages_;
    std::map<uint32_t, News> news_;
    std::map<uint64_t, Asked> asked_;  // by question
    std::map<NodeKey, OfNode> nodes_;
    std::vector<Line> lines_;
    std::map<size_t, bool> raised_;  // by checks: the line of the event, whether it was tied
    std::deque<Emission> emitted_;   // not yet on the bus
    std::optional<std::pair<Time, uint32_t>> stopped_;
};

}  // namespace vagus::record
