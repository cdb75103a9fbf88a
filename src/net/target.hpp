// Where to listen or connect, as people write it. Pure text: nothing is looked up or opened here.
//
//     tcp:HOST:PORT   tcp:[IPV6]:PORT   ser:DEVICE[:BAUD]   can:INTERFACE
//
// and the strings of Aseba's tools (docs/spec/aseba-wire-and-vm.md, section 1.2), known by a `;` or
// `=` in them or by `tcpin:`
//
//     tcpin:33333   tcp:localhost;33333   tcp:host=h;port=33333;remapLocal=5;remapTarget=1
//     ser:device=/dev/ttyACM0;baud=115200   ser:name=Thymio-II   can:if=can0
//
// `tcpin:` without an address means 127.0.0.1 here: the protocol has no authentication.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "base/result.hpp"
#include "hub/hub.hpp"

namespace vagus::net {

constexpr size_t kTargetCharsMax = 1000;
constexpr uint16_t kTcpinDefaultPort = 5000;  // section 1.2
constexpr uint32_t kDefaultBaud = 115200;

struct TcpPlace {
    std::string host;  // a name or an address, IPv6 without brackets
    uint16_t port = 0;
    bool operator==(const TcpPlace&) const = default;
};

enum class FlowControl { None, Hardware };
enum class ModemLine { Leave, Set };

// Exactly one of device and name is not empty.
struct SerialPlace {
    std::string device;  // a path
    std::string name;    // part of a name in /dev/serial/by-id
    uint32_t baud = kDefaultBaud;
    FlowControl flow_control = FlowControl::None;
    ModemLine dtr = ModemLine::Set;
    bool operator==(const SerialPlace&) const = default;
};

struct CanPlace {
    std::string interface;
    bool operator==(const CanPlace&) const = default;
};

// What the text says to do. `tcp:` may be used for both, as the caller means it.
enum class Use { Any, Listen, Connect };

struct Target {
    std::variant<TcpPlace, SerialPlace, CanPlace> place;
    Use use = Use::Any;
    std::optional<hub::Remap> remap = std::nullopt;
    bool operator==(const Target&) const = default;
};

// The Error quotes the text, names the part that is wrong and shows how it is written.
Result<Target> parse_target(std::string_view text);

// The short form of the first list above, without a remap.
std::string to_string(const Target& target);

}  // namespace vagus::net
