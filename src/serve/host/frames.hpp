// Frames of the bus as the bytes of packets.
#pragma once

#include <string>

#include "wire/frame.hpp"

namespace vagus::serve {

// False if the bytes are no whole frame.
inline bool decode_frame(const std::string& bytes, wire::Frame& frame) {
    wire::FrameReader reader;
    const auto* data = reinterpret_cast<const uint8_t*>(bytes.data());
    size_t used = 0;
    while (used < bytes.size()) {
        used += reader.feed(data + used, static_cast<uint16_t>(bytes.size() - used));
    }
    if (reader.complete()) frame = reader.frame();
    return reader.complete();
}

inline std::string encode_frame(const wire::Frame& frame) {
    std::string bytes(wire::kFrameMax, '\0');
    bytes.resize(wire::encode(frame, reinterpret_cast<uint8_t*>(bytes.data())));
    return bytes;
}

}  // namespace vagus::serve
