// What can be seen from a point: rays against discs and convex polygons, exactly, after one
// question to the broad phase. Knows where bodies are and what they look like; nothing of forces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/arena.hpp"
#include "sim/cell_grid.hpp"

namespace vagus::sim {

// Where a body is, with the cosine and sine of its angle.
struct Stand {
    double x = 0;
    double y = 0;
    double cosine = 1;
    double sine = 0;

    Point to_world(Point point) const {
        return {x + cosine * point.x - sine * point.y, y + sine * point.x + cosine * point.y};
    }
    Point to_body(Point point) const {
        const double mx = point.x - x;
        const double my = point.y - y;
        return {cosine * mx + sine * my, cosine * my - sine * mx};
    }
};

enum class Mobility : uint8_t { Fixed, Moving };

class Sight {
public:
    explicit Sight(const ArenaSize& size);

    // `index` is that of the body; the corners are copied.
    void add(uint32_t index, const Outline& outline, double height, Mobility mobility);
    void remove(uint32_t index);
    // Bodies have moved: call refresh() before the next look.
    void put(uint32_t index, const Stand& stand) { stands_[index] = stand; }
    const Stand& stand(uint32_t index) const { return stands_[index]; }
    // A fixed body has been put somewhere else.
    void fixed_moved() { fixed_current_ = false; }
    void refresh();

    void look(uint32_t self, const RayFan& rays, double eye, std::span<double> distances) const;
    void look_wide(uint32_t self, double ahead, std::span<const double> tangents,
                   std::span<Column> columns) const;
    void slice(uint32_t self, const Stand& eye, std::span<const double> tangents,
               std::vector<Slice>& slices) const;

private:
    // The half-plane left of an edge: x * nx + y * ny <= reach.
    struct Edge {
        double nx, ny, reach;
    };
    struct Form {
        std::vector<Edge> edges;  // empty: a disc
        double bound = 0;         // radius around the origin of the body that holds all of it
        uint32_t users = 0;       // bodies that look like this; 0: free for another
    };
    struct Seen {
        uint32_t form = 0;
        double height = 0;
        Mobility mobility = Mobility::Fixed;
    };
    // A ray, in whatever frame.
    struct Beam {
        double x, y, dx, dy;
    };

    uint32_t form_of(const Outline& outline);
    Box box_of(uint32_t index) const;
    void refresh_fixed();
    void look_at(const Form& form, const Stand& stand, const RayFan& rays,
                 std::span<double> distances) const;
    static double hit(const Beam& beam, const Form& form, const Stand& stand, double range);
    static double hit_polygon(const Beam& beam, const Form& form, const Stand& stand, double range);
    double hit_border(const Beam& beam, double range) const;
    struct Span {
        size_t first, end;
    };
    Span columns_of(uint32_t index, const Stand& eye, std::span<const double> tangents) const;
    void slice_body(uint32_t index, const Stand& eye, std::span<const double> tangents,
                    std::vector<Slice>& slices) const;
    void slice_border(const Stand& eye, std::span<const double> tangents,
                      std::vector<Slice>& slices) const;
    void see_wide(uint32_t index, const Stand& eye, std::span<const double> tangents,
                  std::span<Column> columns) const;

    ArenaSize size_;
    std::vector<Form> forms_;
    std::vector<uint32_t> free_forms_;
    std::vector<Seen> seen_;  // by index of the body, as stands_
    std::vector<Stand> stands_;
    std::vector<uint32_t> fixed_;   // by number in the grid
    std::vector<uint32_t> moving_;  // by number in the grid
    std::vector<Box> boxes_;        // of one build, kept for its memory
    CellGrid fixed_grid_;
    CellGrid moving_grid_;
    double moving_bound_ = 0;  // the largest of those that move: their grid lists middles only
    bool fixed_current_ = true;
};

}  // namespace vagus::sim
