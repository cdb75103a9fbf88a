// The colours of the ground: one colour or a picture, with patches on it; and the light that falls
// on it. Ground sensors ask it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "sim/cell_grid.hpp"
#include "sim/definitions.hpp"

namespace vagus::sim {

// Rows from the top (largest y) down, three bytes a pixel.
struct Picture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> pixels;
};

// The bytes of a PNG. At most kImageSideMax pixels a side; transparency is laid on white.
Result<Picture> read_png(std::string_view bytes, const std::string& file);

// How much a surface of that colour reflects, 0 to 1: the mean of its parts.
inline double brightness(const Colour& colour) {
    return (colour.r + colour.g + colour.b) / 3;
}

class Ground {
public:
    Ground(double width, double height, const Colour& colour);
    void set_picture(Picture picture) { picture_ = std::move(picture); }
    // Later patches lie on earlier ones. Replaces those that were there.
    void set_patches(std::vector<ObjectDefinition> patches);
    // The lamps that are on. A lamp is felt up to a metre away, as 1 under it and falling evenly.
    void set_lamps(std::vector<Point> lamps) { lamps_ = std::move(lamps); }

    Colour colour_at(const Point& at) const;
    // 0 in the dark, 1 right under a lamp; lamps do not add up.
    double light_at(const Point& at) const;

private:
    struct Patch {
        ObjectDefinition object;
        double cosine, sine;
    };
    Colour picture_at(const Point& at) const;

    double width_;
    double height_;
    Colour colour_;
    Picture picture_;
    std::vector<Patch> patches_;
    std::vector<Point> lamps_;
    CellGrid grid_;
};

}  // namespace vagus::sim
