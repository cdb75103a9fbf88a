// What messages between the server and the process of a run are made of, beside numbers and texts.
//
// A message and its parts are plain structs. Each lists its fields once, in `layout`; writing,
// reading and the tests walk that list, so they cannot drift apart:
//
//     struct SetPace {
//         bool paused = true;
//         double speed = 1;
//         static constexpr std::string_view kName = "pace";
//         static void layout(auto& each, auto& it) {
//             each("paused", it.paused);
//             each("speed", it.speed);
//         }
//         bool operator==(const SetPace&) const = default;
//     };
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "wire/frame.hpp"

namespace vagus::serve::talk {

// Not text: what flows to pages as it is, and records of the history.
struct Bytes {
    std::string bytes;
    bool operator==(const Bytes&) const = default;
};

// An object of JSON that goes to pages as it is. The server looks at nothing inside.
struct Document {
    nlohmann::json json = nlohmann::json::object();
    bool operator==(const Document&) const = default;
};

// The same, a list.
struct DocumentList {
    nlohmann::json json = nlohmann::json::array();
    bool operator==(const DocumentList&) const = default;
};

// A frame of the bus, whole.
struct BusFrame {
    wire::Frame frame{};
    bool operator==(const BusFrame& other) const;
};

struct Point {
    double x = 0, y = 0;  // metres
    static void layout(auto& each, auto& it) {
        each("x", it.x);
        each("y", it.y);
    }
    bool operator==(const Point&) const = default;
};

struct Pose {
    double x = 0, y = 0, angle = 0;
    static void layout(auto& each, auto& it) {
        each("x", it.x);
        each("y", it.y);
        each("angle", it.angle);
    }
    bool operator==(const Pose&) const = default;
};

struct Colour {
    double r = 0, g = 0, b = 0;  // 0 to 1
    static void layout(auto& each, auto& it) {
        each("r", it.r);
        each("g", it.g);
        each("b", it.b);
    }
    bool operator==(const Colour&) const = default;
};

// The words of an enumeration, in its order: as they travel.
template <typename Enum>
struct Words;

template <typename Enum>
constexpr std::string_view word_of(Enum value) {
    return Words<Enum>::kAll[static_cast<size_t>(value)];
}

}  // namespace vagus::serve::talk
