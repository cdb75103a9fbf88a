#include "net/target.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <limits>
#include <span>
#include <vector>

#include "wire/protocol.hpp"

namespace vagus::net {

namespace {

constexpr const char* kForms =
    "a target is tcp:HOST:PORT, tcp:[IPV6]:PORT, ser:DEVICE[:BAUD], can:INTERFACE or "
    "tcpin:PORT";

Error wrong(std::string_view text, const std::string& sentence) {
    return Error{Code::BadInput, "target '" + std::string(text) + "': " + sentence};
}

template <typename Number>
std::optional<Number> number_in(std::string_view digits) {
    Number value{};
    const char* end = digits.data() + digits.size();
    const auto [at, error] = std::from_chars(digits.data(), end, value);
    if (digits.empty() || error != std::errc{} || at != end) return std::nullopt;
    return value;
}

// ---- the short forms ----

Result<Target> short_tcp(std::string_view text, std::string_view rest) {
    const size_t colon = rest.rfind(':');
    const bool bracket = rest.starts_with('[');
    const size_t close = rest.find(']');
    if (bracket && close == std::string_view::npos) {
        return wrong(text, "the ']' of the IPv6 address is missing; write tcp:[::1]:33333");
    }
    if (colon == std::string_view::npos || (bracket && colon != close + 1)) {
        return wrong(text, "the port is missing; write tcp:" + std::string(rest) + ":33333");
    }
    const std::string_view host = bracket ? rest.substr(1, close - 1) : rest.substr(0, colon);
    if (host.empty()) return wrong(text, "the host is missing; write tcp:127.0.0.1:33333");
    if (!bracket && host.find(':') != std::string_view::npos) {
        return wrong(text, "an IPv6 address is written in brackets; write tcp:[::1]:33333");
    }
    const auto port = number_in<uint16_t>(rest.substr(colon + 1));
    if (!port) {
        return wrong(text, "the port '" + std::string(rest.substr(colon + 1)) +
                               "' is not a number from 0 to 65535");
    }
    return Target{.place = TcpPlace{std::string(host), *port}};
}

Result<Target> short_serial(std::string_view text, std::string_view rest) {
    const size_t colon = rest.rfind(':');
    SerialPlace place;
    place.device = rest.substr(0, colon);
    if (place.device.empty()) {
        return wrong(text, "the device is missing; write ser:/dev/ttyACM0");
    }
    if (colon != std::string_view::npos) {
        const auto baud = number_in<uint32_t>(rest.substr(colon + 1));
        if (!baud) {
            return wrong(text, "the baud rate '" + std::string(rest.substr(colon + 1)) +
                                   "' is not a number; write ser:/dev/ttyACM0:115200");
        }
        place.baud = *baud;
    }
    return Target{.place = place, .use = Use::Connect};
}

Result<Target> short_can(std::string_view text, std::string_view rest) {
    if (rest.empty()) return wrong(text, "the interface is missing; write can:can0");
    return Target{.place = CanPlace{std::string(rest)}, .use = Use::Connect};
}

// ---- the strings of Aseba's tools ----

struct Parameter {
    std::string_view key;
    std::string_view value;
};

// The parameters after the protocol, as `key=value` whatever way they were written.
class Parameters {
public:
    static Result<Parameters> read(std::string_view text, std::string_view rest,
                                   std::span<const std::string_view> positional) {
        Parameters found(text);
        bool named = false;
        for (size_t index = 0; !rest.empty(); ++index) {
            const size_t end = std::min(rest.find(';'), rest.size());
            const std::string_view part = rest.substr(0, end);
            rest.remove_prefix(std::min(end + 1, rest.size()));
            const size_t equals = part.find('=');
            named = named || equals != std::string_view::npos;
            if (named && equals == std::string_view::npos) {
                return wrong(text, "'" + std::string(part) +
                                       "' follows a key=value, so it needs a key of its own");
            }
            if (!named && index >= positional.size()) {
                return wrong(text, "'" + std::string(part) + "' is one parameter too many");
            }
            const std::string_view key = named ? part.substr(0, equals) : positional[index];
            if (found.find(key)) return wrong(text, "'" + std::string(key) + "' is given twice");
            found.all_.push_back({key, named ? part.substr(equals + 1) : part});
        }
        return found;
    }

    std::optional<std::string_view> find(std::string_view key) const {
        for (const Parameter& each : all_) {
            if (each.key == key) return each.value;
        }
        return std::nullopt;
    }

    std::string text(std::string_view key, std::string_view otherwise) const {
        return std::string(find(key).value_or(otherwise));
    }

    template <typename Number>
    Result<Number> number(std::string_view key, Number otherwise) const {
        const auto value = find(key);
        if (!value) return otherwise;
        const auto number = number_in<Number>(*value);
        if (number) return *number;
        return wrong(text_, std::string(key) + "=" + std::string(*value) +
                                " is not a number from 0 to " +
                                std::to_string(std::numeric_limits<Number>::max()));
    }

    // The value must be the one that Vagus can do.
    Status only(std::string_view key, std::string_view value, const std::string& why) const {
        const auto given = find(key);
        if (!given || *given == value) return Status::done();
        return wrong(text_, std::string(key) + "=" + std::string(*given) + ": " + why + "; leave " +
                                std::string(key) + " out");
    }

    // Every key must be in `known` or belong to the hub.
    Status check_keys(std::span<const std::string_view> known) const {
        for (const Parameter& each : all_) {
            if (each.key == "remapLocal" || each.key == "remapTarget") continue;
            if (std::find(known.begin(), known.end(), each.key) != known.end()) continue;
            std::string keys;
            for (const std::string_view key : known) keys += std::string(key) + ", ";
            return wrong(text_, "the key '" + std::string(each.key) + "' is unknown; known are " +
                                    keys + "remapLocal, remapTarget");
        }
        return Status::done();
    }

    // remapTarget is 1 unless given (section 1.5).
    Result<std::optional<hub::Remap>> remap() const {
        if (!find("remapLocal")) {
            if (!find("remapTarget")) return std::optional<hub::Remap>{};
            return wrong(text_, "remapTarget needs remapLocal, the id that others see");
        }
        hub::Remap remap{};
        remap.local = TRY(number<uint16_t>("remapLocal", 0));
        remap.target = TRY(number<uint16_t>("remapTarget", 1));
        return std::optional<hub::Remap>(remap);
    }

private:
    explicit Parameters(std::string_view text) : text_(text) {}

    std::string_view text_;
    std::vector<Parameter> all_;
};

constexpr std::array<std::string_view, 4> kTcpKeys{"host", "port", "connectionPort", "sock"};
constexpr std::array<std::string_view, 2> kTcpinKeys{"port", "address"};
constexpr std::array<std::string_view, 9> kSerialKeys{"device", "name", "port", "baud", "stop",
                                                      "parity", "fc",   "bits", "dtr"};
// What is at which place: the first is a device or a port number.
constexpr std::array<std::string_view, 6> kSerialPositions{"device", "baud", "stop",
                                                           "parity", "fc",   "bits"};
constexpr std::array<std::string_view, 1> kCanKeys{"if"};

Result<Target> long_tcp(std::string_view text, std::string_view rest) {
    const Parameters parameters = TRY(Parameters::read(text, rest, kTcpKeys));
    TRY(parameters.check_keys(kTcpKeys));
    TRY(parameters.only("connectionPort", "-1", "Vagus leaves the local port to the system"));
    TRY(parameters.only("sock", "-1", "Vagus opens its own sockets"));
    if (!parameters.find("port")) {
        return wrong(text, "the port is missing; write tcp:host=localhost;port=33333");
    }
    TcpPlace place;
    place.host = parameters.text("host", "localhost");
    if (place.host.empty()) return wrong(text, "the host is empty; write host=localhost");
    place.port = TRY(parameters.number<uint16_t>("port", 0));
    const auto remap = TRY(parameters.remap());
    return Target{.place = place, .use = Use::Connect, .remap = remap};
}

Result<Target> long_tcpin(std::string_view text, std::string_view rest) {
    const Parameters parameters = TRY(Parameters::read(text, rest, kTcpinKeys));
    TRY(parameters.check_keys(kTcpinKeys));
    TcpPlace place;
    place.host = parameters.text("address", "127.0.0.1");
    if (place.host.empty()) return wrong(text, "the address is empty; write address=127.0.0.1");
    place.port = TRY(parameters.number<uint16_t>("port", kTcpinDefaultPort));
    const auto remap = TRY(parameters.remap());
    return Target{.place = place, .use = Use::Listen, .remap = remap};
}

Status check_8n1(const Parameters& parameters) {
    const std::string why = "Aseba's serial lines are 8N1";
    TRY(parameters.only("stop", "1", why));
    TRY(parameters.only("parity", "none", why));
    TRY(parameters.only("bits", "8", why));
    return Status::done();
}

Result<Target> long_serial(std::string_view text, std::string_view rest) {
    const Parameters parameters = TRY(Parameters::read(text, rest, kSerialPositions));
    TRY(parameters.check_keys(kSerialKeys));
    TRY(check_8n1(parameters));
    SerialPlace place;
    place.device = parameters.text("device", "");
    const bool numbered = number_in<uint32_t>(place.device).has_value();
    if (place.device.empty()) place.name = parameters.text("name", "");
    if (numbered || (place.device.empty() && place.name.empty())) {
        return wrong(text,
                     "name the line: device=/dev/ttyACM0, or name= with a part of its name in "
                     "/dev/serial/by-id; port numbers change from start to start");
    }
    place.baud = TRY(parameters.number<uint32_t>("baud", kDefaultBaud));
    const std::string flow = parameters.text("fc", "none");
    if (flow != "none" && flow != "hard") return wrong(text, "fc is 'none' or 'hard'");
    place.flow_control = flow == "hard" ? FlowControl::Hardware : FlowControl::None;
    const std::string dtr = parameters.text("dtr", "true");
    if (dtr != "true" && dtr != "false") return wrong(text, "dtr is 'true' or 'false'");
    place.dtr = dtr == "true" ? ModemLine::Set : ModemLine::Leave;
    const auto remap = TRY(parameters.remap());
    return Target{.place = place, .use = Use::Connect, .remap = remap};
}

Result<Target> long_can(std::string_view text, std::string_view rest) {
    const Parameters parameters = TRY(Parameters::read(text, rest, kCanKeys));
    TRY(parameters.check_keys(kCanKeys));
    const CanPlace place{parameters.text("if", "can0")};
    if (place.interface.empty()) return wrong(text, "the interface is empty; write if=can0");
    const auto remap = TRY(parameters.remap());
    return Target{.place = place, .use = Use::Connect, .remap = remap};
}

struct Protocol {
    std::string_view name;
    Result<Target> (*read_short)(std::string_view text, std::string_view rest);
    Result<Target> (*read_long)(std::string_view text, std::string_view rest);
};
constexpr std::array<Protocol, 4> kProtocols{{
    {"tcp", short_tcp, long_tcp},
    {"tcpin", long_tcpin, long_tcpin},
    {"ser", short_serial, long_serial},
    {"can", short_can, long_can},
}};

}  // namespace

Result<Target> parse_target(std::string_view text) {
    if (text.size() > kTargetCharsMax) {
        return wrong(std::string(text.substr(0, 40)) + "…",
                     "it has more than " + std::to_string(kTargetCharsMax) + " characters");
    }
    const size_t colon = text.find(':');
    if (colon == std::string_view::npos) return wrong(text, std::string("no ':'; ") + kForms);
    const std::string_view rest = text.substr(colon + 1);
    for (const Protocol& protocol : kProtocols) {
        if (protocol.name != text.substr(0, colon)) continue;
        const bool is_long = rest.find_first_of(";=") != std::string_view::npos;
        return (is_long ? protocol.read_long : protocol.read_short)(text, rest);
    }
    return wrong(text,
                 "'" + std::string(text.substr(0, colon)) + "' is not a protocol here; " + kForms);
}

std::string to_string(const Target& target) {
    if (const auto* tcp = std::get_if<TcpPlace>(&target.place)) {
        const bool v6 = tcp->host.find(':') != std::string::npos;
        return "tcp:" + (v6 ? "[" + tcp->host + "]" : tcp->host) + ":" + std::to_string(tcp->port);
    }
    if (const auto* serial = std::get_if<SerialPlace>(&target.place)) {
        const std::string line = serial->name.empty() ? serial->device : "name=" + serial->name;
        if (serial->baud == kDefaultBaud) return "ser:" + line;
        return "ser:" + line + (serial->name.empty() ? ":" : ";baud=") +
               std::to_string(serial->baud);
    }
    return "can:" + std::get<CanPlace>(target.place).interface;
}

}  // namespace vagus::net
