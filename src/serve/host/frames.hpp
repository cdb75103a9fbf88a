// Frames of the bus, and pictures of a camera, as the bytes of packets.
#pragma once

#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

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

// Bytes that are of a robot: the length of its name (16 bit), its name, then they.
inline std::string with_name(std::string_view name, std::string_view bytes) {
    const auto size = static_cast<uint16_t>(name.size());
    std::string packed(sizeof size, '\0');
    std::memcpy(packed.data(), &size, sizeof size);
    return packed.append(name).append(bytes);
}

// The name and the bytes; nothing if they were cut.
inline std::optional<std::pair<std::string, std::string>> take_name(std::string_view packed) {
    uint16_t size = 0;
    if (packed.size() < sizeof size) return std::nullopt;
    std::memcpy(&size, packed.data(), sizeof size);
    packed.remove_prefix(sizeof size);
    if (packed.size() < size) return std::nullopt;
    return std::pair(std::string(packed.substr(0, size)), std::string(packed.substr(size)));
}

}  // namespace vagus::serve
