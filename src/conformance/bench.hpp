// The node that is examined, with the verbs that checks are written in: send, expect, load, run to
// the end. Every wait has an end, a question that can be asked to hear that nothing else came.
//
//     Status check(Bench& bench) {
//         const uint16_t at = TRY(bench.room(1));
//         const Instructions code = Instructions().push(5).store(at).stop();
//         TRY(bench.run_to_end(program_of(code)));
//         return bench.expect_values(at, {5});
//     }
//
// Messages and user events of the node are kept apart: within each of the two the order counts, and
// a node may let its messages pass its events. What other nodes say is not heard here.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "aesl/target.hpp"
#include "conformance/finding.hpp"
#include "conformance/instructions.hpp"
#include "conformance/line.hpp"
#include "wire/messages.hpp"

namespace vagus::conformance {

constexpr uint16_t number(wire::MessageType type) {
    return static_cast<uint16_t>(type);
}

// An answer that takes longer does not come. Emulated nodes on a busy machine are slow.
constexpr Duration kAnswerWithin = std::chrono::seconds(5);
// A program of a check that runs longer hangs: the longest has 20,000 instructions.
constexpr Duration kProgramWithin = std::chrono::seconds(10);
// Behind bytes that no node of its kind sends, a line that may lose bytes must find the next frame
// again: so often is asked, so long is waited for each answer.
constexpr int kQuestionsAgain = 5;
constexpr Duration kAnswerAgainWithin = std::chrono::seconds(1);
// Frames that wait to be looked at. A node that floods the bus is a finding.
constexpr size_t kHeardMax = 4096;

// Numbers of user events that projects hardly reach: other nodes of the bus hear ours.
constexpr uint16_t kPing = 4094;
constexpr uint16_t kPong = 4095;

// The variable in which a node counts events that it could not send.
constexpr const char* kDropped = "_dropped";

struct State {
    uint16_t pc = 0;
    uint16_t flags = 0;
    friend bool operator==(const State&, const State&) = default;
};

// How a program ended: the last state, and the messages before it, faults above all.
struct Ending {
    State state;
    std::vector<wire::Frame> messages;
};

class Bench {
public:
    // The line must live longer.
    Bench(Line& line, uint16_t id, aesl::Target target);

    // ---- what the node says it is ----
    uint16_t id() const { return id_; }
    const aesl::Target& target() const { return target_; }
    // Another id on the bus, on which nobody answers.
    uint16_t nobody() const { return nobody_; }
    void set_nobody(uint16_t id) { nobody_ = id; }
    // The first of so many variables that belong to nobody; lacking() if there are fewer.
    Result<uint16_t> room(uint16_t words) const;
    uint16_t room_size() const;
    // Where the variable of that name lies; lacking() if the node does not describe it.
    Result<uint16_t> address_of(const std::string& name) const;
    // The id of a native; lacking() if the node does not have it.
    Result<uint16_t> native(const std::string& name) const;

    // ---- speaking ----
    Status send(const wire::Frame& frame);
    Status send(uint16_t type, const Words& payload);
    // With the node as destination.
    Status command(wire::MessageType type, const Words& rest = {});
    Status event(uint16_t number, const Values& arguments, uint16_t source = wire::kHostId);
    Status set(uint16_t start, const Values& values);

    // ---- hearing ----
    // The next message of the node; a finding that names `expected` if none comes.
    Result<wire::Frame> hear(const std::string& expected);
    // It is this one, with these words.
    Status expect(wire::MessageType type, const Words& words);
    Status expect_state(State state);
    // As above, after asking for it: nothing else came before.
    Status ask_state(State state);
    // A NodeSpecificError, whatever its text.
    Status expect_error();
    // What was heard is as it should be.
    Status is_message(const wire::Frame& frame, wire::MessageType type, const Words& words) const;
    Status is_state(State found, State expected) const;
    Status expect_event(uint16_t number, const Values& arguments);
    // Nothing came, messages or events: seen by the answers to two questions.
    Status expect_silence();
    // As expect_silence(), after a frame that a line takes for noise if it may lose bytes, together
    // with the frames behind it: asks until there is an answer.
    Status expect_silence_again();
    Result<Values> get(uint16_t start, uint16_t count);
    Status expect_values(uint16_t start, const Values& expected);
    // The frame that came, if one does, by then.
    Result<std::optional<wire::Frame>> listen(Time deadline);
    Time now() const { return line_.now(); }

    // ---- programs ----
    // In as many SetBytecode as needed, each of which must be answered as section 2.7 says.
    Status load(const Words& program);
    // Loads and runs; Run must be answered before anything else. Without a handler of init the node
    // then waits for events.
    Status start(const Words& program);
    // Starts, and waits until nothing is executed any more.
    Result<Ending> run(const Words& program);
    // Asks until the node executes nothing, or is paused.
    Result<Ending> wait_for_end();
    // As run(); anything but a quiet end is a finding.
    Status run_to_end(const Words& program);
    // No program, no breakpoints, waiting for events; zero in all memory that was written or asked
    // for since the last time, the first time in all that belongs to nobody; nothing left of what
    // was heard. Fails if the node does not answer.
    Status clear();

    // Commands of another host to this node: the answers to its questions may spoil ours.
    size_t foreign() const { return foreign_; }

private:
    Status pump(Time deadline);
    Status clear_memory();
    Status ask_fence();
    Status forget();
    bool is_fence(const wire::Frame& frame) const;
    Result<State> next_state(std::vector<wire::Frame>& before);

    Line& line_;
    const uint16_t id_;
    const aesl::Target target_;
    uint16_t nobody_ = 0;
    std::deque<wire::Frame> messages_;
    std::deque<wire::Frame> events_;
    uint16_t fence_ = 0;           // the address in the last question that was asked to be sure
    bool hears_presence_ = false;  // NodePresent answers others, too
    size_t foreign_ = 0;
    // Up to where memory may be other than zero.
    uint16_t bytecode_used_ = 0;
    mutable uint16_t variables_used_ = 0;
};

}  // namespace vagus::conformance
