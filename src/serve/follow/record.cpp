#include "serve/follow/record.hpp"

#include <cmath>
#include <cstring>
#include <utility>

#include "serve/bytes.hpp"
#include "serve/follow/sights.hpp"

namespace vagus::serve {

namespace {

// The size of a record counts what follows it.
using Size = uint32_t;

// Takes values from the front of bytes; `ok` turns false at what is not there.
struct Taker {
    std::string_view bytes;
    bool ok = true;

    std::string_view some(size_t size) {
        if (bytes.size() < size) ok = false;
        if (!ok) return {};
        const std::string_view taken = bytes.substr(0, size);
        bytes.remove_prefix(size);
        return taken;
    }
    template <typename T>
    T one() {
        T value{};
        const std::string_view taken = some(sizeof value);
        if (ok) std::memcpy(&value, taken.data(), sizeof value);
        return value;
    }
};

bool take_sight(Taker& from, RecordItem& item, size_t each) {
    item.robot = from.one<uint16_t>();
    item.bytes = from.some(from.one<uint16_t>() * each);
    return from.ok;
}

void append_sight(std::string& to, uint16_t robot, std::string_view bytes, size_t each) {
    append(to, robot);
    append(to, static_cast<uint16_t>(bytes.size() / each));
    to.append(bytes);
}

bool take_item(Taker& from, RecordItem& item) {
    item.kind = static_cast<RecordItem::Kind>(from.one<uint8_t>());
    switch (item.kind) {
        case RecordItem::Kind::Words:
        case RecordItem::Kind::Forgotten:
            item.node = from.one<uint16_t>();
            item.address = from.one<uint16_t>();
            item.count = from.one<uint16_t>();
            if (item.kind == RecordItem::Kind::Words) item.values = from.some(item.count * 2u);
            return from.ok && uint32_t{item.address} + item.count <= 0x10000;
        case RecordItem::Kind::Pose:
            item.key = from.one<uint32_t>();
            item.x = from.one<float>();
            item.y = from.one<float>();
            item.angle = from.one<float>();
            return from.ok;
        case RecordItem::Kind::Looks:
            return take_sight(from, item, kLookBytes);
        case RecordItem::Kind::Lamps:
            return take_sight(from, item, kLampBytes);
    }
    return false;
}

}  // namespace

int16_t RecordItem::value(size_t index) const {
    int16_t word = 0;
    std::memcpy(&word, values.data() + index * sizeof word, sizeof word);
    return word;
}

void RecordWriter::begin(double t) {
    end();
    open_ = true;
    items_ = false;
    began_ = bytes_.size();
    append(bytes_, Size{0});
    append(bytes_, t);
}

// Writes the size of the record that is open, or takes one back that says nothing.
void RecordWriter::end() {
    if (!open_) return;
    open_ = false;
    if (!items_) return bytes_.resize(began_);
    const auto size = static_cast<Size>(bytes_.size() - began_ - sizeof(Size));
    std::memcpy(bytes_.data() + began_, &size, sizeof size);
}

void RecordWriter::words(uint16_t node, uint16_t address, std::span<const int16_t> values) {
    items_ = true;
    append(bytes_, RecordItem::Kind::Words);
    append(bytes_, node);
    append(bytes_, address);
    append(bytes_, static_cast<uint16_t>(values.size()));
    for (const int16_t value : values) append(bytes_, value);
}

void RecordWriter::forget(uint16_t node, uint16_t address, uint16_t count) {
    items_ = true;
    append(bytes_, RecordItem::Kind::Forgotten);
    append(bytes_, node);
    append(bytes_, address);
    append(bytes_, count);
}

void RecordWriter::pose(uint32_t key, float x, float y, float angle) {
    items_ = true;
    append(bytes_, RecordItem::Kind::Pose);
    append(bytes_, key);
    append(bytes_, x);
    append(bytes_, y);
    append(bytes_, angle);
}

void RecordWriter::looks(uint16_t robot, std::string_view bytes) {
    items_ = true;
    append(bytes_, RecordItem::Kind::Looks);
    append_sight(bytes_, robot, bytes, kLookBytes);
}

void RecordWriter::lamps(uint16_t robot, std::string_view bytes) {
    items_ = true;
    append(bytes_, RecordItem::Kind::Lamps);
    append_sight(bytes_, robot, bytes, kLampBytes);
}

std::string RecordWriter::take() {
    end();
    return std::exchange(bytes_, {});
}

bool each_record(std::string_view bytes, const RecordSeen& seen) {
    Taker from{bytes};
    while (!from.bytes.empty()) {
        const std::string_view whole = from.bytes;
        const auto size = from.one<Size>();
        Taker record{from.some(size)};
        const auto t = record.one<double>();
        if (!from.ok || !record.ok || !std::isfinite(t)) return false;
        seen.record(t, whole.substr(0, sizeof(Size) + size));
        while (!record.bytes.empty()) {
            RecordItem item;
            item.t = t;
            if (!take_item(record, item)) return false;
            seen.item(item);
        }
    }
    return true;
}

}  // namespace vagus::serve
