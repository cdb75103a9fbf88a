// Frames of the bus as bytes.
#pragma once

#include <string>

#include "wire/frame.hpp"

namespace vagus::serve {

// False if the bytes are not one whole frame.
inline bool decode_frame(const std::string& bytes, wire::Frame& frame) {
    if (bytes.empty() || bytes.size() > wire::kFrameMax) return false;
    wire::FrameReader reader;
    const auto size = static_cast<uint16_t>(bytes.size());
    const uint16_t used = reader.feed(reinterpret_cast<const uint8_t*>(bytes.data()), size);
    if (used != size || !reader.complete()) return false;
    frame = reader.frame();
    return true;
}

inline std::string encode_frame(const wire::Frame& frame) {
    std::string bytes(wire::kFrameMax, '\0');
    bytes.resize(wire::encode(frame, reinterpret_cast<uint8_t*>(bytes.data())));
    return bytes;
}

}  // namespace vagus::serve
