#include "serve/history/tape.hpp"

#include <algorithm>
#include <cmath>

#include "serve/follow/sights.hpp"

namespace vagus::serve {

// ---- one instant ----

void TapeState::apply(const RecordItem& item) {
    switch (item.kind) {
        case RecordItem::Kind::Pose:
            if (!things_.contains(item.key) && things_.size() >= kTapeThingsMax) return;
            things_[item.key] = {item.x, item.y, item.angle};
            return;
        case RecordItem::Kind::Looks:
        case RecordItem::Kind::Lamps:
            return apply_sight(item);
        case RecordItem::Kind::Words:
        case RecordItem::Kind::Forgotten:
            return apply_words(item);
    }
}

void TapeState::apply_sight(const RecordItem& item) {
    if (!sights_.contains(item.robot) && sights_.size() >= kSightRobotsMax) return;
    Sights& sights = sights_[item.robot];
    (item.kind == RecordItem::Kind::Looks ? sights.looks : sights.lamps) = item.bytes;
}

void TapeState::apply_words(const RecordItem& item) {
    if (!nodes_.contains(item.node) && nodes_.size() >= kRecordedNodesMax) return;
    Words& words = nodes_[item.node];
    const size_t end = size_t{item.address} + item.count;
    if (words.values.size() < end) {
        words.values.resize(end);
        words.known.resize(end);
    }
    const bool known = item.kind == RecordItem::Kind::Words;
    for (size_t i = 0; i < item.count; ++i) {
        words.known[item.address + i] = known;
        if (known) words.values[item.address + i] = item.value(i);
    }
}

std::string TapeState::rays() const {
    std::string looks, lamps;
    for (const auto& [robot, sights] : sights_) {
        looks += sights.looks;
        lamps += sights.lamps;
    }
    return rays_payload(looks, lamps);
}

std::optional<int16_t> TapeState::word(uint16_t node, uint16_t address) const {
    const auto found = nodes_.find(node);
    if (found == nodes_.end() || address >= found->second.values.size()) return std::nullopt;
    if (!found->second.known[address]) return std::nullopt;
    return found->second.values[address];
}

size_t TapeState::bytes() const {
    size_t sum = things_.size() * (sizeof(uint32_t) + sizeof(Standing));
    for (const auto& [node, words] : nodes_) sum += sizeof(Words) + words.values.size() * 2;
    for (const auto& [robot, sights] : sights_) {
        sum += sizeof(Sights) + sights.looks.size() + sights.lamps.size();
    }
    return sum;
}

void TapeState::write_since(const TapeState& before, RecordWriter& writer) const {
    for (const auto& [node, words] : nodes_) write_words(node, words, before, writer);
    for (const auto& [key, standing] : things_) {
        const auto then = before.things_.find(key);
        if (then != before.things_.end() && then->second == standing) continue;
        writer.pose(key, standing.x, standing.y, standing.angle);
    }
    static const Sights kNone;
    for (const auto& [robot, sights] : sights_) {
        const auto found = before.sights_.find(robot);
        const Sights& then = found == before.sights_.end() ? kNone : found->second;
        if (then.looks != sights.looks) writer.looks(robot, sights.looks);
        if (then.lamps != sights.lamps) writer.lamps(robot, sights.lamps);
    }
}

// Neighbours that differ, and are known or not alike, go together.
void TapeState::write_words(uint16_t node, const Words& words, const TapeState& before,
                            RecordWriter& writer) const {
    const auto differs = [&](size_t i) {
        const auto address = static_cast<uint16_t>(i);
        return word(node, address) != before.word(node, address);
    };
    for (size_t i = 0; i < words.values.size(); ++i) {
        if (!differs(i)) continue;
        size_t end = i + 1;
        while (end < words.values.size() && end - i < 0xffff && differs(end) &&
               words.known[end] == words.known[i]) {
            ++end;
        }
        const auto first = static_cast<uint16_t>(i);
        if (words.known[i]) {
            writer.words(node, first, {&words.values[i], end - i});
        } else {
            writer.forget(node, first, static_cast<uint16_t>(end - i));
        }
        i = end - 1;
    }
}

// ---- keeping ----

bool Tape::record(std::string_view bytes) {
    if (!each_record(bytes, {})) return false;
    each_record(bytes, {[&](double t, std::string_view one) { keep(t, one); },
                        [&](const RecordItem& item) { now_.apply(item); }});
    bound();
    return true;
}

void Tape::keep(double t, std::string_view record) {
    const bool full = !blocks_.empty() && (t - blocks_.back().from >= kTapeBlockSeconds ||
                                           blocks_.back().bytes.size() >= kTapeBlockBytes);
    if (blocks_.empty() || full) begin_block(t);
    Block& block = blocks_.back();
    block.bytes += record;
    bytes_ += record.size();
    to_ = std::max(to_, t);
    block.to = to_;
}

void Tape::begin_block(double t) {
    Block block;
    block.from = block.to = blocks_.empty() ? t : std::max(t, to_);
    block.begins = now_;
    bytes_ += block.size();
    blocks_.push_back(std::move(block));
}

void Tape::cut(double t) {
    if (t > to_) return;
    to_ = 0;
    while (!blocks_.empty() && blocks_.back().from > t) {
        now_ = blocks_.back().begins;
        bytes_ -= blocks_.back().size();
        blocks_.pop_back();
    }
    if (blocks_.empty()) return;
    Block& block = blocks_.back();
    bytes_ -= block.size();
    now_ = block.begins;
    std::string kept;
    each_record(block.bytes, {[&](double at, std::string_view one) {
                                  if (at > t) return;
                                  kept += one;
                                  to_ = at;
                              },
                              [&](const RecordItem& item) {
                                  if (item.t <= t) now_.apply(item);
                              }});
    block.bytes = std::move(kept);
    block.to = to_;
    bytes_ += block.size();
}

// ---- bounds ----

void Tape::bound() {
    for (Block& block : blocks_) {
        if (block.to >= to_ - kTapeFineSeconds) break;
        if (!block.coarse) thin(block);
    }
    while (bytes_ > kTapeBytes) {
        Block* fine = oldest_fine();
        if (!fine) break;
        thin(*fine);
    }
    while (blocks_.size() > 1 && (bytes_ > kTapeBytes || blocks_.front().to < to_ - kTapeSeconds)) {
        bytes_ -= blocks_.front().size();
        blocks_.pop_front();
    }
}

// The newest one is still being written.
Tape::Block* Tape::oldest_fine() {
    for (size_t i = 0; i + 1 < blocks_.size(); ++i) {
        if (!blocks_[i].coarse) return &blocks_[i];
    }
    return nullptr;
}

// What happened within a step is told at its end.
void Tape::thin(Block& block) {
    bytes_ -= block.size();
    RecordWriter writer;
    TapeState told = block.begins;
    TapeState now = block.begins;
    double last = block.from;
    const auto step_of = [](double t) { return std::floor(t / kTapeCoarseStep); };
    const auto tell = [&] {
        writer.begin(last);
        now.write_since(told, writer);
        told = now;
    };
    each_record(block.bytes, {[&](double t, std::string_view) {
                                  if (step_of(t) > step_of(last)) tell();
                                  last = t;
                              },
                              [&](const RecordItem& item) { now.apply(item); }});
    tell();
    block.bytes = writer.take();
    block.bytes.shrink_to_fit();
    block.coarse = true;
    bytes_ += block.size();
}

double Tape::fine_from() const {
    for (const Block& block : blocks_) {
        if (!block.coarse) return block.from;
    }
    return to_;
}

// ---- looking ----

// The last that began until then.
const Tape::Block* Tape::block_at(double t) const {
    const auto after =
        std::upper_bound(blocks_.begin(), blocks_.end(), t,
                         [](double instant, const Block& block) { return instant < block.from; });
    return after == blocks_.begin() ? nullptr : &*std::prev(after);
}

TapeState Tape::at(double t) const {
    const Block* block = block_at(t);
    if (!block) return {};
    TapeState state = block->begins;
    each_record(block->bytes, {[](double, std::string_view) {},
                               [&](const RecordItem& item) {
                                   if (item.t <= t) state.apply(item);
                               }});
    return state;
}

std::map<uint32_t, std::deque<Tape::WayPoint>> Tape::ways(double from, double to) const {
    std::map<uint32_t, std::deque<WayPoint>> ways;
    const auto go = [&](uint32_t key, const WayPoint& point) {
        if ((key & kRobotKey) == 0) return;
        std::deque<WayPoint>& way = ways[key & ~kRobotKey];
        if (!way.empty()) {
            const WayPoint& last = way.back();
            if (std::hypot(point.x - last.x, point.y - last.y) < kWayStep) return;
        }
        way.push_back(point);
        const size_t most = std::min(kWayPointsMax, kWaysPointsMax / ways.size());
        while (way.size() > std::max<size_t>(most, 1)) way.pop_front();
    };
    const TapeState begins = at(from);
    for (const auto& [key, standing] : begins.things()) go(key, {from, standing.x, standing.y});
    for (const Block& block : blocks_) {
        if (block.to < from || block.from > to) continue;
        each_record(block.bytes, {[](double, std::string_view) {},
                                  [&](const RecordItem& item) {
                                      if (item.kind != RecordItem::Kind::Pose) return;
                                      if (item.t <= from || item.t > to) return;
                                      go(item.key, {item.t, item.x, item.y});
                                  }});
    }
    return ways;
}

std::vector<Tape::Column> Tape::columns(uint16_t node, uint16_t address,
                                        const Window& window) const {
    std::vector<Column> columns(window.columns);
    const double width = (window.to - window.from) / static_cast<double>(window.columns);
    if (!(width > 0)) return columns;
    std::optional<int16_t> value = at(window.from).word(node, address);
    size_t filled = 0;  // columns before this one are complete
    const auto see = [&](Column& column) {
        if (!value) return;
        column.low = std::min(column.low.value_or(*value), *value);
        column.high = std::max(column.high.value_or(*value), *value);
    };
    // The value holds from where it was seen to that column, both included.
    const auto hold_until = [&](double t) {
        const double place = std::floor((t - window.from) / width);
        const auto last =
            static_cast<size_t>(std::clamp(place, 0.0, static_cast<double>(window.columns - 1)));
        for (; filled < last; ++filled) see(columns[filled]);
        see(columns[filled]);
    };
    for (auto block = blocks_.begin(); block != blocks_.end(); ++block) {
        if (block->to < window.from || block->from > window.to) continue;
        if (block->from > window.from) {
            hold_until(block->from);
            value = block->begins.word(node, address);
        }
        each_record(block->bytes,
                    {[](double, std::string_view) {},
                     [&](const RecordItem& item) {
                         const bool word = item.kind == RecordItem::Kind::Words ||
                                           item.kind == RecordItem::Kind::Forgotten;
                         const bool other = !word || item.node != node || address < item.address ||
                                            address >= item.address + item.count ||
                                            item.t <= window.from || item.t > window.to;
                         if (other) return;
                         hold_until(item.t);
                         value = item.kind == RecordItem::Kind::Words
                                     ? std::optional(item.value(size_t{address} - item.address))
                                     : std::nullopt;
                         hold_until(item.t);
                     }});
    }
    if (to_ >= window.from) hold_until(std::min(window.to, to_));
    return columns;
}

}  // namespace vagus::serve
