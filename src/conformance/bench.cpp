#include "conformance/bench.hpp"

#include <algorithm>

#include "wire/reports.hpp"

namespace vagus::conformance {
namespace {

using wire::MessageType;

constexpr size_t kVariablesAtOnce = wire::kBytecodeWordsMax;  // behind the same two words

uint16_t described_words(const aesl::Target& target) {
    size_t words = 0;
    for (const aesl::NamedVariable& variable : target.variables) words += variable.size;
    return static_cast<uint16_t>(words);
}

wire::Frame frame_of(uint16_t type, const Words& payload) {
    wire::Frame frame{};
    frame.type = type;
    for (const uint16_t word : payload) wire::add_argument(frame, static_cast<int16_t>(word));
    return frame;
}

bool is(const wire::Frame& frame, MessageType type) {
    return frame.type == number(type);
}

std::string within(Duration wait) {
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(wait).count();
    return " within " + std::to_string(seconds) + " s";
}

// Where the program begins after a reset; none without a handler for it.
std::optional<uint16_t> init_of(const Words& program) {
    for (size_t i = 1; i + 1 < program.size() && i < program[0]; i += 2)
        if (program[i] == isa::kInitEvent && program[i + 1] != 0) return program[i + 1];
    return std::nullopt;
}

}  // namespace

Bench::Bench(Line& line, uint16_t id, aesl::Target target)
    : line_(line),
      id_(id),
      target_(std::move(target)),
      bytecode_used_(target_.bytecode_size),
      variables_used_(target_.variables_size) {}

// ---- what the node says it is ----

uint16_t Bench::room_size() const {
    return static_cast<uint16_t>(target_.variables_size - described_words(target_));
}

Result<uint16_t> Bench::room(uint16_t words) const {
    const uint16_t first = described_words(target_);
    if (room_size() >= words) {
        variables_used_ = std::max(variables_used_, static_cast<uint16_t>(first + words));
        return first;
    }
    return lacking(std::to_string(words) + " free variables", "has " + std::to_string(room_size()));
}

Result<uint16_t> Bench::address_of(const std::string& name) const {
    uint16_t at = 0;
    for (const aesl::NamedVariable& variable : target_.variables) {
        if (variable.name == name) return at;
        at = static_cast<uint16_t>(at + variable.size);
    }
    return lacking("a variable " + name, "does not describe it");
}

Result<uint16_t> Bench::native(const std::string& name) const {
    const auto found = std::ranges::find(target_.natives, name, &aesl::NativeFunction::name);
    if (found == target_.natives.end()) return lacking(name, "does not have it");
    return static_cast<uint16_t>(found - target_.natives.begin());
}

// ---- speaking ----

Status Bench::send(const wire::Frame& frame) {
    return line_.send(frame);
}

Status Bench::send(uint16_t type, const Words& payload) {
    return line_.send(frame_of(type, payload));
}

Status Bench::command(MessageType type, const Words& rest) {
    Words payload{id_};
    payload.insert(payload.end(), rest.begin(), rest.end());
    return send(number(type), payload);
}

Status Bench::event(uint16_t event, const Values& arguments, uint16_t source) {
    wire::Frame frame = frame_of(event, Words(arguments.begin(), arguments.end()));
    frame.source = source;
    return line_.send(frame);
}

Status Bench::set(uint16_t start, const Values& values) {
    Words rest{start};
    rest.insert(rest.end(), values.begin(), values.end());
    const size_t end = std::min<size_t>(start + values.size(), target_.variables_size);
    variables_used_ = std::max(variables_used_, static_cast<uint16_t>(end));
    return command(MessageType::SetVariables, rest);
}

// ---- hearing ----

// Sorts one frame, if one comes.
Status Bench::pump(Time deadline) {
    const std::optional<wire::Frame> frame = TRY(line_.receive(deadline));
    if (!frame) return Status::done();
    if (wire::is_command(frame->type) && frame->first_word() == id_) foreign_++;
    if (frame->source != id_) return Status::done();
    if (is(*frame, MessageType::Disconnected))
        return Error{Code::Unavailable, "the node left the bus"};
    if (is(*frame, MessageType::NodePresent) && !hears_presence_) return Status::done();
    std::deque<wire::Frame>& heard = wire::is_user_event(frame->type) ? events_ : messages_;
    if (heard.size() >= kHeardMax) {
        return finding("the node floods the bus: over " + std::to_string(kHeardMax) +
                       " frames that nobody asked for, the last " + text_of(*frame));
    }
    heard.push_back(*frame);
    return Status::done();
}

Result<wire::Frame> Bench::hear(const std::string& expected) {
    const Time deadline = now() + kAnswerWithin;
    while (messages_.empty() && now() < deadline) TRY(pump(deadline));
    if (messages_.empty())
        return finding("expected " + expected + ", found nothing" + within(kAnswerWithin));
    const wire::Frame frame = messages_.front();
    messages_.pop_front();
    return frame;
}

Result<std::optional<wire::Frame>> Bench::listen(Time deadline) {
    while (messages_.empty() && now() < deadline) TRY(pump(deadline));
    if (messages_.empty()) return std::optional<wire::Frame>{};
    const wire::Frame frame = messages_.front();
    messages_.pop_front();
    return std::optional<wire::Frame>(frame);
}

Status Bench::is_message(const wire::Frame& frame, MessageType type, const Words& words) const {
    const wire::Frame wanted = frame_of(number(type), words);
    const bool same = frame.type == wanted.type && frame.size == wanted.size &&
                      std::equal(frame.payload, frame.payload + frame.size, wanted.payload);
    if (same) return Status::done();
    return finding("expected " + text_of(wanted) + ", found " + text_of(frame));
}

Status Bench::is_state(State found, State expected) const {
    if (found == expected) return Status::done();
    return finding("expected pc " + std::to_string(expected.pc) + ", " +
                   text_of_flags(expected.flags) + "; found pc " + std::to_string(found.pc) + ", " +
                   text_of_flags(found.flags));
}

Status Bench::expect(MessageType type, const Words& words) {
    hears_presence_ = type == MessageType::NodePresent;
    const Result<wire::Frame> frame = hear(text_of(frame_of(number(type), words)));
    hears_presence_ = false;
    return is_message(TRY(frame), type, words);
}

Status Bench::expect_state(State state) {
    return expect(MessageType::ExecutionStateChanged, {state.pc, state.flags});
}

Status Bench::ask_state(State state) {
    TRY(command(MessageType::GetExecutionState));
    return expect_state(state);
}

Status Bench::expect_error() {
    const wire::Frame frame = TRY(hear("NodeSpecificError"));
    if (is(frame, MessageType::NodeSpecificError)) return Status::done();
    return finding("expected NodeSpecificError, found " + text_of(frame));
}

Status Bench::expect_event(uint16_t event, const Values& arguments) {
    const wire::Frame wanted = frame_of(event, Words(arguments.begin(), arguments.end()));
    const Time deadline = now() + kAnswerWithin;
    while (events_.empty() && now() < deadline) TRY(pump(deadline));
    if (events_.empty()) {
        return finding("expected " + text_of(wanted) + ", found nothing" + within(kAnswerWithin));
    }
    const wire::Frame frame = events_.front();
    events_.pop_front();
    if (text_of(frame) == text_of(wanted) && frame.size == wanted.size) return Status::done();
    return finding("expected " + text_of(wanted) + ", found " + text_of(frame));
}

// The answer to a question that no other has asked shows that all before it has been answered.
Status Bench::ask_fence() {
    fence_ = static_cast<uint16_t>((fence_ + 1) % std::max<int>(1, target_.variables_size));
    return command(MessageType::GetVariables, {fence_, 1});
}

bool Bench::is_fence(const wire::Frame& frame) const {
    return is(frame, MessageType::Variables) && frame.first_word() == fence_;
}

// Twice: an event that a message has passed is on its way by the second answer.
Status Bench::expect_silence() {
    for (int i = 0; i < 2; i++) {
        TRY(ask_fence());
        const wire::Frame frame = TRY(hear("Variables"));
        if (!is_fence(frame)) return finding("expected no answer, found " + text_of(frame));
    }
    if (events_.empty()) return Status::done();
    return finding("expected no event, found " + text_of(events_.front()));
}

Status Bench::expect_silence_again() {
    for (int i = 0; i < kQuestionsAgain; i++) {
        TRY(ask_fence());
        const std::optional<wire::Frame> frame = TRY(listen(now() + kAnswerAgainWithin));
        if (!frame) continue;
        if (!is(*frame, MessageType::Variables))
            return finding("expected no answer, found " + text_of(*frame));
        TRY(forget());
        return expect_silence();
    }
    return finding("the node does not answer any more");
}

// Answers to earlier questions may still come, up to that to one more.
Status Bench::forget() {
    TRY(ask_fence());
    const Time deadline = now() + kAnswerWithin;
    while (now() < deadline) {
        const std::optional<wire::Frame> frame = TRY(listen(deadline));
        if (frame && is_fence(*frame)) return Status::done();
    }
    return Error{Code::Timeout, "the node does not answer GetVariables any more"};
}

Result<Values> Bench::get(uint16_t start, uint16_t count) {
    TRY(command(MessageType::GetVariables, {start, count}));
    Values values;
    while (values.size() < count) {
        const wire::Frame frame = TRY(hear("Variables"));
        wire::Variables part;
        if (wire::decode_message(frame, part) != wire::Error::None)
            return finding("expected Variables, found " + text_of(frame));
        if (part.start != start + values.size() || part.values.count == 0)
            return finding("expected Variables from address " +
                           std::to_string(start + values.size()) + ", found " + text_of(frame));
        values.insert(values.end(), part.values.values, part.values.values + part.values.count);
    }
    if (values.size() == count) return values;
    return finding("asked for " + std::to_string(count) + " variables, got " +
                   std::to_string(values.size()));
}

Status Bench::expect_values(uint16_t start, const Values& expected) {
    const Values found = TRY(get(start, static_cast<uint16_t>(expected.size())));
    if (found == expected) return Status::done();
    return finding("expected " + text_of(expected) + ", found " + text_of(found));
}

// ---- programs ----

Status Bench::load(const Words& program) {
    if (program.size() > target_.bytecode_size) {
        return lacking(std::to_string(program.size()) + " words of bytecode",
                       "has " + std::to_string(target_.bytecode_size));
    }
    bytecode_used_ = std::max(bytecode_used_, static_cast<uint16_t>(program.size()));
    const std::optional<uint16_t> init = init_of(program);
    for (size_t start = 0; start < program.size(); start += wire::kBytecodeWordsMax) {
        const size_t count = std::min<size_t>(wire::kBytecodeWordsMax, program.size() - start);
        Words rest{static_cast<uint16_t>(start)};
        rest.insert(rest.end(), program.begin() + static_cast<ptrdiff_t>(start),
                    program.begin() + static_cast<ptrdiff_t>(start + count));
        TRY(command(MessageType::SetBytecode, rest));
        std::vector<wire::Frame> before;
        const State state = TRY(next_state(before));
        if (!before.empty())
            return finding("expected the state after SetBytecode, found " +
                           text_of(before.front()));
        const uint16_t flags = init ? 3 : 2;
        if (state.flags != flags || (init && state.pc != *init))
            return finding("after SetBytecode expected " +
                           (init ? "pc " + std::to_string(*init) + ", " : std::string()) +
                           text_of_flags(flags) + ", found pc " + std::to_string(state.pc) + ", " +
                           text_of_flags(state.flags));
    }
    return Status::done();
}

Result<State> Bench::next_state(std::vector<wire::Frame>& before) {
    while (before.size() < kHeardMax) {
        const wire::Frame frame = TRY(hear("ExecutionStateChanged"));
        wire::ExecutionStateChanged state;
        if (wire::decode_message(frame, state) == wire::Error::None)
            return State{state.pc, state.flags};
        before.push_back(frame);
    }
    return finding("the node sends " + text_of(before.back()) + " again and again");
}

Result<Ending> Bench::wait_for_end() {
    Ending ending;
    const Time deadline = now() + kProgramWithin;
    while (now() < deadline) {
        TRY(command(MessageType::GetExecutionState));
        ending.state = TRY(next_state(ending.messages));
        const uint16_t both = wire::kFlagActive | wire::kFlagStep;
        if ((ending.state.flags & both) != wire::kFlagActive) return ending;
    }
    return finding("the program did not end" + within(kProgramWithin) + "; it is at " +
                   std::to_string(ending.state.pc));
}

Status Bench::start(const Words& program) {
    TRY(load(program));
    TRY(command(MessageType::Run));
    std::vector<wire::Frame> before;
    const State state = TRY(next_state(before));
    if (!before.empty())
        return finding("expected the state after Run, found " + text_of(before.front()));
    const uint16_t flags = init_of(program) ? 1 : 0;
    if (state.flags == flags) return Status::done();
    return finding("after Run expected " + text_of_flags(flags) + ", found " +
                   text_of_flags(state.flags));
}

Result<Ending> Bench::run(const Words& program) {
    TRY(start(program));
    return wait_for_end();
}

Status Bench::run_to_end(const Words& program) {
    const Ending ending = TRY(run(program));
    if (!ending.messages.empty())
        return finding("expected the program to end in silence, found " +
                       text_of(ending.messages.front()));
    if (ending.state.flags == 0) return Status::done();
    return finding("expected the program to end, found the node " +
                   text_of_flags(ending.state.flags));
}

// So that no check finds what it is about to write. What a node describes may be its motors, and
// is left alone.
Status Bench::clear_memory() {
    for (size_t start = 1; start < bytecode_used_; start += wire::kBytecodeWordsMax) {
        Words rest(1 + std::min<size_t>(wire::kBytecodeWordsMax, bytecode_used_ - start), 0);
        rest[0] = static_cast<uint16_t>(start);
        TRY(command(MessageType::SetBytecode, rest));
        // A board that answers while the next frame comes may lose bytes of it.
        TRY(forget());
    }
    for (size_t start = described_words(target_); start < variables_used_;
         start += kVariablesAtOnce) {
        Words rest(1 + std::min<size_t>(kVariablesAtOnce, variables_used_ - start), 0);
        rest[0] = static_cast<uint16_t>(start);
        TRY(command(MessageType::SetVariables, rest));
    }
    bytecode_used_ = 1;
    variables_used_ = 0;
    return Status::done();
}

Status Bench::clear() {
    TRY(command(MessageType::SetBytecode, {0, 0}));
    TRY(clear_memory());
    TRY(command(MessageType::BreakpointClearAll));
    TRY(command(MessageType::Run));
    messages_.clear();
    TRY(forget());
    messages_.clear();
    events_.clear();
    return Status::done();
}

}  // namespace vagus::conformance
