// Any sequence of links that come, go, send, read a little or never read: what leaves a link is
// always a row of whole frames, every frame is accounted for, and no queue passes its limit.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <map>

#include "hub/hub.hpp"

namespace {

using namespace vagus;

constexpr size_t kLinksAtOnce = 8;
// Stop, and what follows it, has room in a full queue.
constexpr size_t kWaitingMax = hub::kQueueBytesMax + hub::kUrgentBytesMax;

// The input, taken in small numbers; zeros at its end.
class Choices {
public:
    Choices(const uint8_t* bytes, size_t size) : at_(bytes), left_(size) {}
    bool done() const { return left_ == 0; }
    uint8_t byte() {
        if (left_ == 0) return 0;
        --left_;
        return *at_++;
    }
    uint16_t word() { return static_cast<uint16_t>(byte() | (byte() << 8)); }

private:
    const uint8_t* at_;
    size_t left_;
};

struct Reading {
    wire::FrameReader reader;
    uint64_t frames = 0;
};

class World {
public:
    void step(Choices& choices) {
        switch (choices.byte() % 6) {
            case 0:
                add(choices);
                break;
            case 1:
                if (!readings_.empty()) remove(pick(choices));
                break;
            case 2:
            case 3:
                if (!readings_.empty()) send(pick(choices), choices);
                break;
            case 4:
                if (!readings_.empty()) flood(pick(choices), choices);
                break;
            case 5:
                if (!readings_.empty()) read(pick(choices), choices.word());
                break;
        }
    }
    void check() const {
        for (const auto& [link, reading] : readings_) {
            if (hub_.waiting(link) > kWaitingMax) std::abort();
            if (reading.reader.dropped() != 0) std::abort();
        }
    }
    void read_all() {
        for (auto& [link, reading] : readings_) {
            while (hub_.waiting(link) > 0) read(link, hub_.waiting(link));
            const hub::LinkStats stats = hub_.stats(link);
            const uint64_t gone = stats.dropped.events + stats.dropped.messages;
            if (reading.frames + gone != stats.frames_queued) std::abort();
        }
    }

private:
    hub::LinkId pick(Choices& choices) const {
        auto at = readings_.begin();
        std::advance(at, choices.byte() % readings_.size());
        return at->first;
    }
    void add(Choices& choices) {
        if (readings_.size() >= kLinksAtOnce) return;
        const uint8_t kind = choices.byte();
        hub::LinkOptions options{.name = "link", .echo = (kind & 1) != 0};
        if ((kind & 2) != 0) options.remap = hub::Remap{choices.byte(), choices.byte()};
        readings_.try_emplace(hub_.add(options).value());
    }
    void remove(hub::LinkId link) {
        hub_.remove(link);
        readings_.erase(link);
    }
    wire::Frame frame(Choices& choices) {
        wire::Frame frame{};
        frame.source = choices.byte();
        frame.type = choices.word();
        frame.size = static_cast<uint16_t>(choices.word() % (wire::kPayloadMax + 1));
        frame.payload[0] = choices.byte();
        return frame;
    }
    void send(hub::LinkId link, Choices& choices) { hub_.receive(link, frame(choices)); }
    void flood(hub::LinkId link, Choices& choices) {
        const wire::Frame same = frame(choices);
        for (int i = choices.byte(); i > 0; --i) hub_.receive(link, same);
    }
    void read(hub::LinkId link, size_t most) {
        Reading& reading = readings_.at(link);
        const auto bytes = hub_.output(link);
        const size_t size = std::min(bytes.size(), most);
        for (size_t at = 0; at < size;) {
            const size_t piece = std::min<size_t>(size - at, 0xffff);
            at += reading.reader.feed(bytes.data() + at, static_cast<uint16_t>(piece));
            if (reading.reader.complete()) ++reading.frames;
        }
        hub_.sent(link, size);
    }

    hub::Hub hub_;
    std::map<hub::LinkId, Reading> readings_;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
    Choices choices(bytes, size);
    World world;
    while (!choices.done()) {
        world.step(choices);
        world.check();
    }
    world.read_all();
    return 0;
}
