// Expected bytes are the captured dumps of docs/spec/aseba-wire-and-vm.md, section 2.10.
#include "wire/messages.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace vagus::wire {
namespace {

std::vector<uint8_t> bytes_of(const Frame& frame) {
    std::vector<uint8_t> bytes(kFrameMax);
    bytes.resize(encode(frame, bytes.data()));
    return bytes;
}

template <typename Message>
std::vector<uint8_t> encoded(const Message& message, uint16_t source) {
    Frame frame;
    EXPECT_EQ(encode_message(message, source, frame), Error::None);
    return bytes_of(frame);
}

Frame frame_of(std::vector<uint8_t> bytes) {
    FrameReader reader;
    EXPECT_EQ(reader.feed(bytes.data(), static_cast<uint16_t>(bytes.size())), bytes.size());
    EXPECT_TRUE(reader.complete());
    return reader.frame();
}

using Hex = std::vector<uint8_t>;

TEST(Messages, EncodesTheHandshakeOfDump1) {
    ListNodes list{};
    list.version = 5;
    EXPECT_EQ(encoded(list, 0), (Hex{0x02, 0, 0, 0, 0x11, 0xa0, 5, 0}));
    NodePresent present{};
    present.version = 5;
    EXPECT_EQ(encoded(present, 1), (Hex{0x02, 0, 1, 0, 0x0c, 0x90, 5, 0}));
    GetNodeDescription ask{};
    ask.dest = 1;
    ask.version = 5;
    EXPECT_EQ(encoded(ask, 0), (Hex{0x04, 0, 0, 0, 0x10, 0xa0, 1, 0, 5, 0}));
}

TEST(Messages, DecodesTheDescriptionOfDump1) {
    const Frame frame =
        frame_of({0x18, 0, 1, 0,    0, 0x90, 9, 't',  'h', 'y',  'm', 'i',  'o', '-',  'I',
                  'I',  5, 0, 0xfe, 5, 0x20, 0, 0x4a, 2,   0x1e, 0,   0x11, 0,   0x34, 0});
    Description description;
    ASSERT_EQ(decode_message(frame, description), Error::None);
    EXPECT_EQ(std::string(description.name.bytes, description.name.size), "thymio-II");
    EXPECT_EQ(description.bytecode_size, 1534);
    EXPECT_EQ(description.stack_size, 32);
    EXPECT_EQ(description.variables_size, 586);
    EXPECT_EQ(description.variable_count, 30);
    EXPECT_EQ(description.local_event_count, 17);
    EXPECT_EQ(description.native_count, 52);
}

TEST(Messages, AcceptsTheShortFaultOfDequesOfDump8) {
    ArrayAccessOutOfBounds fault;
    ASSERT_EQ(decode_message(frame_of({2, 0, 1, 0, 6, 0x90, 7, 0}), fault), Error::None);
    EXPECT_EQ(fault.pc, 7);
    EXPECT_EQ(fault.size, 0);
}

TEST(Messages, NamesWhatIsWrongWithAPayload) {
    ExecutionStateChanged state;
    EXPECT_EQ(decode_message(frame_of({3, 0, 1, 0, 0x0a, 0x90, 5, 0, 3}), state), Error::Truncated);
    EXPECT_EQ(decode_message(frame_of({5, 0, 1, 0, 0x0a, 0x90, 5, 0, 3, 0, 9}), state),
              Error::TrailingBytes);
    EXPECT_EQ(decode_message(frame_of({0, 0, 1, 0, 3, 0xa0}), state), Error::WrongType);
}

TEST(Messages, RefusesOneParameterTooMany) {
    Frame frame{};
    frame.type = 0x9003;
    frame.payload[2] = static_cast<uint8_t>(kParametersMax + 1);
    frame.size = static_cast<uint16_t>(4 + 3 * (kParametersMax + 1));
    NativeFunctionDescription native;
    EXPECT_EQ(decode_message(frame, native), Error::TooLong);
}

TEST(Messages, RefusesOneWordTooMany) {
    SetVariables set{};
    set.values.count = kSetVariablesWordsMax;
    Frame frame;
    EXPECT_EQ(encode_message(set, 0, frame), Error::None);
    EXPECT_EQ(frame.size, kPayloadMax);
    set.values.count = kSetVariablesWordsMax + 1;
    EXPECT_EQ(encode_message(set, 0, frame), Error::TooLong);
}

TEST(Messages, KnowTheirNames) {
    EXPECT_STREQ(message_name(0xa001), "SetBytecode");
    EXPECT_EQ(message_name(0x0003), nullptr);
    EXPECT_EQ(message_name(0xffff), nullptr);
}

TEST(FrameReader, GivesTheSameFramesWhateverThePieces) {
    const Hex stream{4, 0, 1, 0, 4, 0, 5, 0, 0, 0, 0, 0, 3, 0, 0, 0, 2, 0, 0, 0, 0x11, 0xa0, 5, 0};
    for (size_t piece = 1; piece <= stream.size(); ++piece) {
        FrameReader reader;
        std::vector<uint16_t> types;
        for (size_t at = 0; at < stream.size();) {
            const size_t size = std::min(piece, stream.size() - at);
            at += reader.feed(stream.data() + at, static_cast<uint16_t>(size));
            if (reader.complete()) types.push_back(reader.frame().type);
        }
        EXPECT_EQ(types, (std::vector<uint16_t>{4, 0, 0xa011})) << "pieces of " << piece;
    }
}

TEST(FrameReader, ThrowsAwayAFrameOneByteTooLongAndStaysAligned) {
    Hex stream{0x05, 0x02, 1, 0, 2, 0};  // 517 bytes announced
    stream.resize(stream.size() + kPayloadMax + 1, 0xee);
    stream.insert(stream.end(), {2, 0, 7, 0, 9, 0, 1, 0});
    FrameReader reader;
    int frames = 0;
    for (size_t at = 0; at < stream.size();) {
        at += reader.feed(stream.data() + at,
                          static_cast<uint16_t>(std::min<size_t>(100, stream.size() - at)));
        if (!reader.complete()) continue;
        ++frames;
        EXPECT_EQ(reader.frame().source, 7);
    }
    EXPECT_EQ(frames, 1);
    EXPECT_EQ(reader.dropped(), 1u);
}

}  // namespace
}  // namespace vagus::wire
