// The broad phase of sight and of the ground: which things may lie in a rectangle? The world is cut
// into square cells, and each cell lists what overlaps it. Things outside the world are listed in
// the cells of its rim, so that nothing is ever lost.
//
//     CellGrid grid(2.0, 1.0);
//     grid.build(boxes);                                  // numbered 0, 1, 2 … in their order
//     grid.visit({0.4, 0.4, 0.6, 0.6}, [&](uint32_t number) { … });   // some may come twice
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vagus::sim {

constexpr double kCellSizeMin = 0.25;  // metres: about what a robot looks over
constexpr uint32_t kCellsPerSideMax = 128;

struct Box {
    double left = 0;
    double low = 0;
    double right = 0;
    double high = 0;
};

// How the world is cut into cells; what lies outside counts to those of its rim.
class CellPlan {
public:
    struct Cells {
        uint32_t left, low, right, high;
    };

    CellPlan(double width, double height) {
        const double side = std::max({width, height, kCellSizeMin}) / kCellsPerSideMax;
        const double cell = std::max(side, kCellSizeMin);
        cells_per_metre_ = 1 / cell;
        columns_ = static_cast<uint32_t>(width * cells_per_metre_) + 1;
        rows_ = static_cast<uint32_t>(height * cells_per_metre_) + 1;
    }

    size_t count() const { return size_t{columns_} * rows_; }
    size_t number(uint32_t column, uint32_t row) const { return size_t{row} * columns_ + column; }
    size_t number_at(double x, double y) const {
        return number(cell_of(x, columns_), cell_of(y, rows_));
    }
    Cells cells_of(const Box& box) const {
        return {cell_of(box.left, columns_), cell_of(box.low, rows_), cell_of(box.right, columns_),
                cell_of(box.high, rows_)};
    }

private:
    uint32_t cell_of(double at, uint32_t count) const {
        const double cell = at * cells_per_metre_;
        if (!(cell > 0)) return 0;
        return cell >= count ? count - 1 : static_cast<uint32_t>(cell);
    }

    double cells_per_metre_ = 1;
    uint32_t columns_ = 1;
    uint32_t rows_ = 1;
};

class CellGrid {
public:
    CellGrid(double width, double height) : plan_(width, height), starts_(plan_.count() + 1, 0) {}

    // Forgets what was there. A counting sort: first how many in each cell, then each in its place,
    // from the last to the first so that cells list them in ascending order.
    void build(std::span<const Box> boxes) {
        std::fill(starts_.begin(), starts_.end(), 0);
        for (const Box& box : boxes) for_cells(box, [this](size_t cell) { ++starts_[cell]; });
        uint32_t sum = 0;
        for (uint32_t& start : starts_) start = sum += start;
        items_.resize(sum);
        for (size_t i = boxes.size(); i-- > 0;) {
            for_cells(boxes[i], [this, i](size_t cell) {
                items_[--starts_[cell]] = static_cast<uint32_t>(i);
            });
        }
    }

    template <typename Visitor>
    void visit(const Box& box, const Visitor& visitor) const {
        if (items_.empty()) return;
        const CellPlan::Cells cells = plan_.cells_of(box);
        for (uint32_t row = cells.low; row <= cells.high; ++row) {
            // Cells of a row lie side by side, and so do their lists.
            const uint32_t end = starts_[plan_.number(cells.right, row) + 1];
            for (uint32_t k = starts_[plan_.number(cells.left, row)]; k < end; ++k)
                visitor(items_[k]);
        }
    }

private:
    template <typename Act>
    void for_cells(const Box& box, const Act& act) const {
        const CellPlan::Cells cells = plan_.cells_of(box);
        for (uint32_t row = cells.low; row <= cells.high; ++row)
            for (uint32_t column = cells.left; column <= cells.right; ++column)
                act(plan_.number(column, row));
    }

    CellPlan plan_;
    std::vector<uint32_t> starts_;  // of each cell in items_, and the end
    std::vector<uint32_t> items_;
};

}  // namespace vagus::sim
