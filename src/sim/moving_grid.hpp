// The broad phase for what moves: points in cells, each moved on its own and rarely, instead of a
// grid that is built again after each step. It is told where a point is listed; a search for it
// adds how far it may have got since.
//
//     MovingGrid grid(2.0, 1.0);
//     grid.put(7, {0.5, 0.5});                                        // also when it is there
//     grid.visit({0.4, 0.4, 0.6, 0.6}, [&](uint32_t index) { … });    // perhaps more, each once
#pragma once

#include <cstdint>
#include <vector>

#include "sim/cell_grid.hpp"
#include "sim/definitions.hpp"

namespace vagus::sim {

class MovingGrid {
public:
    MovingGrid(double width, double height)
        : plan_(width, height), first_(plan_.count(), kNobody) {}

    void put(uint32_t index, const Point& at) {
        if (index >= places_.size()) places_.resize(index + 1);
        const auto cell = static_cast<uint32_t>(plan_.number_at(at.x, at.y));
        if (places_[index].cell == cell) return;
        remove(index);
        const uint32_t next = first_[cell];
        places_[index] = {cell, kNobody, next};
        if (next != kNobody) places_[next].before = index;
        first_[cell] = index;
    }

    // Nothing happens if it is not there.
    void remove(uint32_t index) {
        Place& place = places_[index];
        if (place.cell == kNobody) return;
        (place.before == kNobody ? first_[place.cell] : places_[place.before].next) = place.next;
        if (place.next != kNobody) places_[place.next].before = place.before;
        place = {};
    }

    // The visitor may put the one that it is given elsewhere; it may then come once more.
    template <typename Visitor>
    void visit(const Box& box, const Visitor& visitor) const {
        const CellPlan::Cells cells = plan_.cells_of(box);
        for (uint32_t row = cells.low; row <= cells.high; ++row) {
            for (uint32_t column = cells.left; column <= cells.right; ++column) {
                uint32_t next = first_[plan_.number(column, row)];
                while (next != kNobody) {
                    const uint32_t index = next;
                    next = places_[index].next;
                    visitor(index);
                }
            }
        }
    }

private:
    static constexpr uint32_t kNobody = UINT32_MAX;
    struct Place {
        uint32_t cell = kNobody;
        uint32_t before = kNobody;  // in the list of its cell, as `next`
        uint32_t next = kNobody;
    };

    CellPlan plan_;
    std::vector<uint32_t> first_;  // of each cell
    std::vector<Place> places_;    // by index
};

}  // namespace vagus::sim
