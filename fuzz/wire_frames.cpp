// Any bytes as a stream of frames, in any pieces: the same frames come out as from the whole, none
// is larger than a frame may be, and what a message type accepts is written back to the same bytes.
// The first byte says how long the pieces are.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "wire/messages.hpp"

namespace {

using namespace vagus::wire;

std::vector<Frame> frames_in(const uint8_t* bytes, size_t size, size_t piece) {
    FrameReader reader;
    std::vector<Frame> frames;
    for (size_t at = 0; at < size;) {
        const size_t left = size - at;
        const uint16_t used =
            reader.feed(bytes + at, static_cast<uint16_t>(left < piece ? left : piece));
        if (used == 0) std::abort();
        at += used;
        if (reader.complete()) frames.push_back(reader.frame());
    }
    return frames;
}

bool same(const Frame& a, const Frame& b) {
    return a.source == b.source && a.type == b.type && a.size == b.size &&
           std::memcmp(a.payload, b.payload, a.size) == 0;
}

// What was accepted and is written again is accepted again, and then stays the same. (The first
// writing may differ: it fills up short faults and drops half words.)
template <typename Message>
void check_message(const Frame& frame) {
    Message message{};
    if (decode_message(frame, message) != Error::None) return;
    Frame once{}, twice{};
    if (encode_message(message, frame.source, once) != Error::None) std::abort();
    Message again{};
    if (decode_message(once, again) != Error::None) std::abort();
    if (encode_message(again, frame.source, twice) != Error::None) std::abort();
    if (!same(once, twice)) std::abort();
    if (once.size == frame.size && !same(once, frame)) std::abort();
}

void check_frame(const Frame& frame) {
    if (frame.size > kPayloadMax) std::abort();
#define MESSAGE(name, type, sender) check_message<name>(frame);
#include "wire/messages.def"
#undef MESSAGE
    const char* name = message_name(frame.type);
    if (is_user_event(frame.type) && name != nullptr) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    if (size == 0) return 0;
    const std::vector<Frame> whole = frames_in(bytes + 1, size - 1, 0xffff);
    const std::vector<Frame> pieces = frames_in(bytes + 1, size - 1, 1 + size_t{bytes[0]});
    if (whole.size() != pieces.size()) std::abort();
    for (size_t i = 0; i < whole.size(); ++i) {
        if (!same(whole[i], pieces[i])) std::abort();
        check_frame(whole[i]);
    }
    return 0;
}
