// A node that is sent arbitrary frames, and runs whatever program they make: it stays inside its
// memories, and all that it says can be understood. The input is a stream of frames as on TCP; the
// source of a frame from 0xfff0 on is also a local event.
#include <cstdint>
#include <cstdlib>
#include <memory>

#include "node/frame_maker.hpp"
#include "node/natives.hpp"
#include "node/node.hpp"
#include "wire/messages.hpp"

namespace {

using namespace vagus;

constexpr uint16_t kId = 1;
constexpr uint16_t kBytecode = 300, kVariables = 200, kStack = 16;
constexpr uint16_t kInstructionsAFrame = 500;
constexpr uint16_t kLocalEventSources = 0xfff0;

[[noreturn]] void fail() {
    std::abort();
}

template <typename Message>
void expect_readable(const wire::Frame& frame) {
    if (frame.type != static_cast<uint16_t>(Message::kType)) return;
    Message message;
    if (wire::decode_message(frame, message) != wire::Error::None) fail();
}

void check_sent(const wire::Frame& frame) {
    if (frame.source != kId || frame.size > wire::kPayloadMax) fail();
    if (wire::is_user_event(frame.type)) {
        if (frame.size % 2 != 0 || frame.type >= 0x1000) fail();
        return;
    }
    expect_readable<wire::Description>(frame);
    expect_readable<wire::NamedVariableDescription>(frame);
    expect_readable<wire::LocalEventDescription>(frame);
    expect_readable<wire::NativeFunctionDescription>(frame);
    expect_readable<wire::Variables>(frame);
    expect_readable<wire::ArrayAccessOutOfBounds>(frame);
    expect_readable<wire::DivisionByZero>(frame);
    expect_readable<wire::EventExecutionKilled>(frame);
    expect_readable<wire::NodeSpecificError>(frame);
    expect_readable<wire::ExecutionStateChanged>(frame);
    expect_readable<wire::BreakpointSetResult>(frame);
    expect_readable<wire::NodePresent>(frame);
    const bool reply = frame.type >= 0x9000 && frame.type <= 0x900c;
    if (!reply) fail();
}

node::FrameMaker maker;

constexpr node::Board kBoard = {[](node::Node& node, uint16_t type) { maker.begin(node, type); },
                                [](node::Node&, uint8_t byte) { maker.put(byte); },
                                [](node::Node&) { check_sent(maker.frame()); },
                                [](node::Node&, vm::Notice) {}, wire::kVariablesReplyWordsMax};

const node::Variable kVariableList[] = {
    {1, "id"}, {1, "event.source"}, {32, "event.args"}, {2, "_program"}};
const node::LocalEvent kEventList[] = {{"timer", "doc"}, {"prox", ""}};
const node::Description kDescription = {"fuzzed",
                                        5,
                                        node::LocalEventSource::OwnId,
                                        4,
                                        kVariableList,
                                        2,
                                        kEventList,
                                        {{node::kStandardNatives, node::kStandardNativeCount}, {}},
                                        34};

// Each memory on its own, so that the sanitizers see a step beyond any of them.
struct Memories {
    std::unique_ptr<uint16_t[]> bytecode = std::make_unique<uint16_t[]>(kBytecode);
    std::unique_ptr<int16_t[]> variables = std::make_unique<int16_t[]>(kVariables);
    std::unique_ptr<int16_t[]> stack = std::make_unique<int16_t[]>(kStack);
    std::unique_ptr<uint16_t[]> breakpoints = std::make_unique<uint16_t[]>(vm::kBreakpointsMax);
};

void happen(node::Node& node, const wire::Frame& frame) {
    node::receive(node, frame);
    if (frame.source >= kLocalEventSources) {
        node::local_event(node, static_cast<uint16_t>(frame.source - kLocalEventSources));
    }
    node::run(node, kInstructionsAFrame);
    if (node.vm.depth > kStack || node.vm.breakpoint_count > vm::kBreakpointsMax) fail();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    Memories memories;
    node::Node node;
    const vm::Config config = {kId,
                               kBytecode,
                               kVariables,
                               kStack,
                               32,
                               memories.bytecode.get(),
                               memories.variables.get(),
                               memories.stack.get(),
                               memories.breakpoints.get(),
                               &node::kMachineHost,
                               &node};
    node::init(node, config, kDescription, kBoard, nullptr);
    wire::FrameReader reader;
    while (size > 0) {
        const uint16_t piece = size > UINT16_MAX ? UINT16_MAX : static_cast<uint16_t>(size);
        const uint16_t used = reader.feed(data, piece);
        data += used;
        size -= used;
        if (reader.complete()) happen(node, reader.frame());
    }
    return 0;
}
