// What a Thymio II tells about itself, and its native functions (docs/spec, sections 4.6 and 5.2).
#include <iterator>

#include "node/natives.hpp"
#include "sim/thymio2/thymio2.hpp"

namespace vagus::sim::thymio2 {
namespace {

constexpr node::LocalEvent kEvents[] = {
#define EVENT(enumerator, name, doc) {name, doc},
#include "sim/thymio2/events.def"
#undef EVENT
};

Devices& devices_of(node::Node& node) {
    return *static_cast<Devices*>(Machine::robot_of(node));
}

// Does nothing: there is no loudspeaker and no infrared link in the simulation.
template <int kParameters>
void ignore(node::Node& node) {
    for (int i = 0; i < kParameters; ++i) (void)vm::pop(node.vm);
}

// Too much is the most; less than nothing is the most, too: so does the original (4.6).
int16_t clamped(int16_t value) {
    return value > kLampMax || value < 0 ? kLampMax : value;
}

constexpr size_t count_of(Lamps group) {
    switch (group) {
        case Lamps::Top:
        case Lamps::BottomRight:
        case Lamps::BottomLeft:
            return 3;
        case Lamps::Circle:
        case Lamps::ProxH:
            return 8;
        case Lamps::Buttons:
            return 4;
        case Lamps::ProxV:
        case Lamps::Temperature:
            return 2;
        case Lamps::Rc:
        case Lamps::Sound:
            return 1;
        case Lamps::End:
            return 0;
    }
    return 0;
}

template <Lamps kGroup>
void set_lamps(node::Node& node) {
    constexpr size_t kCount = count_of(kGroup);
    uint16_t addresses[kCount];
    for (uint16_t& address : addresses) address = vm::pop(node.vm);
    for (size_t i = 0; i < kCount; ++i) {
        const int16_t* const value = vm::memory(node.vm, addresses[i], 1);
        if (value == nullptr) return;
        devices_of(node).lamps[static_cast<size_t>(kGroup) + i] = clamped(*value);
    }
}

void sd_open(node::Node& node) {
    const uint16_t number_at = vm::pop(node.vm);
    const uint16_t status_at = vm::pop(node.vm);
    const int16_t* const number = vm::memory(node.vm, number_at, 1);
    int16_t* const status = vm::memory(node.vm, status_at, 1);
    if (number == nullptr || status == nullptr) return;
    *status = devices_of(node).card.open(*number) ? 0 : -1;
}

void sd_write(node::Node& node) {
    const uint16_t data_at = vm::pop(node.vm);
    const uint16_t written_at = vm::pop(node.vm);
    const uint16_t size = vm::pop(node.vm);
    const int16_t* const words = vm::memory(node.vm, data_at, size);
    int16_t* const written = vm::memory(node.vm, written_at, 1);
    if (words == nullptr || written == nullptr) return;
    *written = devices_of(node).card.write({words, size});
}

void sd_read(node::Node& node) {
    const uint16_t data_at = vm::pop(node.vm);
    const uint16_t count_at = vm::pop(node.vm);
    const uint16_t size = vm::pop(node.vm);
    int16_t* const words = vm::memory(node.vm, data_at, size);
    int16_t* const count = vm::memory(node.vm, count_at, 1);
    if (words == nullptr || count == nullptr) return;
    *count = devices_of(node).card.read({words, size});
}

void sd_seek(node::Node& node) {
    const uint16_t position_at = vm::pop(node.vm);
    const uint16_t status_at = vm::pop(node.vm);
    const int16_t* const position = vm::memory(node.vm, position_at, 1);
    int16_t* const status = vm::memory(node.vm, status_at, 1);
    if (position == nullptr || status == nullptr) return;
    *status = devices_of(node).card.seek(static_cast<uint16_t>(*position)) ? 0 : -1;
}

// There are no recordings: every sound lasts 0 tenths of a second.
void sound_duration(node::Node& node) {
    (void)vm::pop(node.vm);
    const uint16_t duration_at = vm::pop(node.vm);
    int16_t* const duration = vm::memory(node.vm, duration_at, 1);
    if (duration != nullptr) *duration = 0;
}

// The parameters of each native in an array of its own, numbered by its line in the list.
#define JOINED(a, b) a##b
#define NAMED(a, b) JOINED(a, b)
#define P(name, words) \
    node::Parameter {  \
        words, name    \
    }
#define NATIVE(function, name, doc, ...) \
    constexpr node::Parameter NAMED(kParameters, __LINE__)[] = {__VA_ARGS__};
#include "sim/thymio2/natives.def"
#undef NATIVE

constexpr node::Native kNatives[] = {
#define NATIVE(function, name, doc, ...)      \
    {name, doc, NAMED(kParameters, __LINE__), \
     static_cast<uint16_t>(std::size(NAMED(kParameters, __LINE__))), function},
#include "sim/thymio2/natives.def"
#undef NATIVE
};
#undef P

}  // namespace

const node::Description kDescription = {"thymio-II",
                                        wire::kProtocolVersion,
                                        node::LocalEventSource::OwnId,
                                        static_cast<uint16_t>(std::size(kVariables)),
                                        kVariables,
                                        static_cast<uint16_t>(std::size(kEvents)),
                                        kEvents,
                                        {{node::kStandardNatives, node::kStandardNativeCount},
                                         {kNatives, static_cast<uint16_t>(std::size(kNatives))}},
                                        0};

}  // namespace vagus::sim::thymio2
