// Arbitrary frames, times and requests at a Network: no crash, no growth beyond the limits, every
// request ends, and what it sends can be read by a node.
//
// Input: steps of a kind byte and what it needs. Bits 0 to 2 of the kind: 0 to 4 a frame (source
// byte, type as an index into all messages or a user event, size byte, payload), 5 time passes,
// 6 a request to a node, 7 list_nodes.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <set>

#include "debug/network.hpp"
#include "wire/messages.hpp"

namespace {

using namespace vagus;

constexpr uint16_t kTypes[] = {
#define MESSAGE(name, type, sender) type,
#include "wire/messages.def"
#undef MESSAGE
};
constexpr size_t kTypeCount = sizeof kTypes / sizeof kTypes[0];

class Bytes {
public:
    Bytes(const uint8_t* bytes, size_t size) : at_(bytes), end_(bytes + size) {}
    bool more() const { return at_ < end_; }
    uint8_t next() { return more() ? *at_++ : uint8_t{0}; }

private:
    const uint8_t* at_;
    const uint8_t* end_;
};

wire::Frame frame_of(Bytes& bytes) {
    wire::Frame frame{};
    frame.source = static_cast<uint16_t>(bytes.next() % 8);
    const uint8_t kind = bytes.next();
    frame.type = kind < kTypeCount ? kTypes[kind] : kind;
    frame.size = bytes.next();
    if (frame.size > 250) frame.size = static_cast<uint16_t>(frame.size + 260);
    for (uint16_t i = 0; i < frame.size; i++) frame.payload[i] = bytes.next();
    return frame;
}

aesl::Program program_of(Bytes& bytes) {
    aesl::Program program;
    const size_t words = 1 + bytes.next() * size_t{8};
    for (size_t i = 0; i < words; i++) {
        program.bytecode.push_back(i < 16 ? bytes.next() : 0);
        program.lines.push_back(static_cast<uint16_t>(1 + i / 2));
    }
    program.variables = {{"a", 0, 1}, {"b", 1, 40}};
    return program;
}

class Run {
public:
    void step(Bytes& bytes) {
        const uint8_t kind = bytes.next();
        switch (kind & 7) {
            case 5:
                pass(std::chrono::milliseconds(bytes.next() * 10));
                break;
            case 6:
                ask(bytes);
                break;
            case 7:
                network_.list_nodes();
                break;
            default:
                network_.receive(now_, frame_of(bytes));
                break;
        }
        if (kind >= 0x80) take();
    }
    // Time until everything asked must have ended.
    void end() {
        for (int second = 0; second < 400 && !open_.empty(); second++) {
            pass(std::chrono::seconds(1));
            take();
        }
        if (!open_.empty()) std::abort();
    }

private:
    void pass(Time duration) {
        now_ += duration;
        network_.tick(now_);
        if (network_.next_tick() <= now_) std::abort();  // the caller would spin
    }
    void ask(Bytes& bytes) {
        const debug::NodeId id = static_cast<debug::NodeId>(bytes.next() % 8);
        const uint8_t what = bytes.next();
        const auto range = network_.variable(id, what & 1 ? "a" : "b[1:39]");
        switch (what % 13) {
            case 0:
                return note(network_.load(id, program_of(bytes)));
            case 1:
                return note(network_.run(id));
            case 2:
                return note(network_.pause(id));
            case 3:
                return note(network_.step(id));
            case 4:
                return note(network_.stop(id));
            case 5:
                return note(network_.reset(id));
            case 6:
                return note(network_.save(id));
            case 7:
                return note(network_.query(id));
            case 8:
                (void)network_.adopt(id, program_of(bytes)).ok();
                return;
            case 9:
                return note(network_.set_breakpoint(id, bytes.next(), what & 16 ? "a > b[2]" : ""));
            case 10:
                (void)network_.clear_breakpoint(id, bytes.next()).ok();
                return;
            case 11:
                if (range.ok()) note(network_.get(id, range.value()));
                return;
            default:
                if (range.ok()) (void)network_.watch(id, range.value()).ok();
                return;
        }
    }
    void note(const Result<debug::RequestId>& request) {
        if (request.ok()) open_.insert(request.value().value);
    }
    void take() {
        for (const wire::Frame& frame : network_.take_frames()) {
            if (frame.size > wire::kPayloadMax || frame.source != wire::kHostId) std::abort();
            if (wire::is_command(frame.type) && frame.first_word() == wire::kHostId) std::abort();
        }
        for (const debug::Event& event : network_.take_events()) {
            const auto* done = std::get_if<debug::RequestDone>(&event.what);
            if (done != nullptr && open_.erase(done->request.value) != 1) std::abort();
        }
        if (network_.nodes().size() > debug::kNodesMax) std::abort();
    }

    debug::Network network_;
    Time now_{};
    std::set<uint32_t> open_;  // requests that have not ended
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* input, size_t size) {
    Bytes bytes(input, size);
    Run run;
    while (bytes.more()) run.step(bytes);
    run.end();
    return 0;
}
