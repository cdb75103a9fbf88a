// What can be seen from a point: rays against discs and convex polygons, exactly, after one
// question to the broad phase. Knows where bodies are and what they look like; nothing of forces.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sim/arena.hpp"
#include "sim/cell_grid.hpp"
#include "sim/moving_grid.hpp"

namespace vagus::sim {

// How far a body may get from where it was listed last (spacing.hpp), and a step beyond.
constexpr double kLeashMax = 0.03;
constexpr double kStrayMax = kLeashMax + 0.01;

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
    // One that moves must not get farther than kStrayMax from where it was listed last.
    void put(uint32_t index, const Stand& stand) { stands_[index] = stand; }
    const Stand& stand(uint32_t index) const { return stands_[index]; }
    // Lists a body that moves where it is now.
    void anchor(uint32_t index) { moving_grid_.put(index, {stands_[index].x, stands_[index].y}); }
    // A fixed body has been put somewhere else.
    void fixed_moved() { fixed_current_ = false; }
    // Call it after fixed bodies have come, gone or moved, before anybody looks.
    void refresh() {
        if (!fixed_current_) refresh_fixed();
    }

    // The radius around the origin of the body that holds all of it.
    double bound(uint32_t index) const { return forms_[seen_[index].form].bound; }
    // How far the disc of that radius is from all fixed bodies and walls, as far as that is less
    // than `most`; rather less than more.
    double room_to_fixed(uint32_t index, double most) const;
    // All that move and may be within `reach` of its disc, some of them farther; not itself.
    template <typename Visitor>
    void visit_moving(uint32_t index, double reach, const Visitor& visitor) const {
        const Stand& at = stands_[index];
        const double wide = bound(index) + reach + moving_bound_ + kStrayMax;
        moving_grid_.visit({at.x - wide, at.y - wide, at.x + wide, at.y + wide},
                           [&](uint32_t other) {
                               if (other != index) visitor(other);
                           });
    }

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
    double distance(const Point& from, uint32_t fixed) const;
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
    std::vector<uint32_t> fixed_;  // by number in the grid
    std::vector<uint32_t> moving_;
    std::vector<Box> boxes_;  // of one build, kept for its memory
    CellGrid fixed_grid_;
    MovingGrid moving_grid_;
    double moving_bound_ = 0;  // the largest of those that move: their grid lists middles only
    bool fixed_current_ = true;
};

}  // namespace vagus::sim
