// Any frames on a CAN bus: the queue stays within its limit, every frame is accounted for, and no
// packet larger than a packet may be comes out. Then the same bytes as one packet: cut and put
// together it is itself.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "wire/can.hpp"

namespace {

using namespace vagus::wire;

constexpr uint16_t kCapacity = 90;  // a little more than the largest packet
constexpr size_t kBytesAFrame = 11;

CanFrame frame_at(const uint8_t* bytes) {
    CanFrame frame{};
    // Mostly identifiers of this protocol, few sources: else packets would hardly ever be whole.
    frame.identifier = static_cast<uint16_t>(((bytes[0] & 0xf) << 8) | (bytes[1] & 3));
    frame.size = static_cast<uint8_t>(bytes[2] % 10);
    std::memcpy(frame.bytes, bytes + 3, kCanBytesMax);
    return frame;
}

void check_bus(const uint8_t* bytes, size_t size) {
    CanReassembler<kCapacity> incoming;
    size_t put = 0;
    size_t taken_bytes = 0;
    for (; size >= kBytesAFrame; bytes += kBytesAFrame, size -= kBytesAFrame) {
        if (incoming.put(frame_at(bytes)) != CanPut::Ignored) ++put;
        if (incoming.waiting() >= kCapacity) std::abort();
        if ((bytes[0] & 0x80) == 0) continue;  // let the queue fill up now and then
        Frame packet{};
        while (incoming.take(packet)) {
            if (packet.size > kPayloadMax || packet.source > kCanSourceMax) std::abort();
            taken_bytes += 2u + packet.size;
        }
    }
    if (incoming.lost() + incoming.waiting() > put) std::abort();
    if (taken_bytes > put * kCanBytesMax) std::abort();
}

void check_packet(const uint8_t* bytes, size_t size) {
    if (size < 3) return;
    Frame packet{};
    packet.source = bytes[0];
    packet.type = static_cast<uint16_t>(bytes[1] | (bytes[2] << 8));
    packet.size = static_cast<uint16_t>(size - 3 < kPayloadMax ? size - 3 : kPayloadMax);
    std::memcpy(packet.payload, bytes + 3, packet.size);
    CanFrame parts[kCanFramesMax];
    const uint8_t count = can_fragment(packet, parts);
    CanReassembler<kCanFramesMax + 1> incoming;
    for (uint8_t i = 0; i < count; ++i) {
        if (incoming.put(parts[i]) != CanPut::Stored) std::abort();
    }
    Frame back{};
    if (!incoming.take(back) || incoming.waiting() != 0) std::abort();
    if (back.source != packet.source || back.type != packet.type) std::abort();
    if (back.size != packet.size) std::abort();
    if (std::memcmp(back.payload, packet.payload, packet.size) != 0) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    check_bus(bytes, size);
    check_packet(bytes, size);
    return 0;
}
