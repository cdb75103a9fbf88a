// Why things happened in a run that is run again: each frame, each run of a handler, each line of
// the trace with what it followed from. Collected while the run goes on; asked at its end, which is
// the instant that the question is about (why.hpp).
//
//     Causes causes(*rerun);                        // before rerun->run()
//     NullTape tape;
//     TRY(rerun->run(tape));
//     const Causes::Frame* frame = causes.frame(number);
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "record/replay.hpp"
#include "sim/witness.hpp"

namespace vagus::record {

// For a run of which only the causes are wanted.
class NullTape final : public Tape {
public:
    uint16_t declare(const Topic&) override { return 1; }
    void put(uint16_t, Time, std::string) override {}
    void put_later(uint16_t, Time, size_t, Word) override {}
};

class Causes final : public sim::Witness {
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
        uint32_t cause = 0;       // … and the frame that this code had heard last
        bool of_bus = false;      // of a node of a real bus, whose script nobody has seen run
    };
    // Something in the world that no script did.
    struct Happening {
        enum class Kind : uint8_t { Contact, Timeline, Person, Chaos };
        Time at{};
        Kind kind = Kind::Contact;
        uint32_t robot = 0;   // concerned; 0: none
        std::string what;     // the sentence
        std::string with;     // id of the object, or the button
        size_t entry = 0;     // of the timeline; of the faults of the world
        uint32_t before = 0;  // the happening that it followed from
    };
    struct Line {
        plan::TraceEvent event;
        std::string text;  // as in the trace
    };

    // Borrowed; before its run().
    explicit Causes(Rerun& rerun);
    ~Causes() override;

    const std::vector<Line>& lines() const { return lines_; }
    // Whether more was due as that line's event was raised, that it has ended (ties.hpp).
    bool tied(size_t line) const { return raised_.contains(line) && raised_.at(line); }
    // Whether no check has raised that line's event: somebody did, in the debugger.
    bool by_hand(size_t line) const { return !raised_.contains(line); }
    const std::vector<Happening>& happenings() const { return happenings_; }
    const Frame* frame(uint32_t number) const;
    const HandlerRun* run(uint32_t number) const;
    const Call* call(uint32_t number) const;
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
    Rerun& rerun() const { return rerun_; }

    // ---- sim::Witness ----
    void began_by_frame(const sim::WitnessedNode& node, uint16_t pc, uint32_t frame) override;
    void began_by_itself(const sim::WitnessedNode& node, uint16_t pc, uint8_t event) override;
    void wrote(const sim::WitnessedNode& node, uint16_t pc, uint16_t address,
               int16_t value) override;
    void called(const sim::WitnessedNode& node, uint16_t pc, uint16_t native) override;
    void sends(const sim::WitnessedNode& node, uint16_t pc) override;
    void sent(const sim::WitnessedNode& node, uint32_t frame) override;

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
    struct Emission {
        std::string event;
        std::string by;
        uint32_t cause = 0;
        size_t line = 0;
    };

    Time now() const;
    void learn(const PastBus& past);
    void begin_run(HandlerRun run);
    void frame_on_bus(const wire::Frame& frame, uint32_t number);
    void host_sets(const wire::Frame& frame);
    void look(Time at);
    void see(const plan::TraceEvent& event);
    void add(Happening happening);
    uint32_t last_happening(uint32_t robot, Happening::Kind kind, std::string_view with) const;

    Rerun& rerun_;
    std::vector<HandlerRun> runs_;
    std::vector<Call> calls_;
    std::map<uint32_t, Frame> frames_;
    std::map<NodeKey, OfNode> nodes_;
    std::vector<Happening> happenings_;
    std::vector<Line> lines_;
    std::map<size_t, bool> raised_;  // by checks: the line of the event, whether it was tied
    std::deque<Emission> emitted_;   // by the plan, not yet on the bus
};

}  // namespace vagus::record
