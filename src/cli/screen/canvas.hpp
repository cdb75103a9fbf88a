// A small picture for a rectangle of character cells: shapes are painted in metres, then each cell
// becomes the block character with the two colours that come nearest. Lines are dots of their own
// (braille), above the picture.
#pragma once

#include <cstdint>
#include <vector>

#include "cli/screen/grid.hpp"

namespace vagus::cli {

// How a terminal can draw. Blocks and braille, or letters where they would show as question marks.
enum class Charset { Unicode, Ascii };

// Of the background.
enum class Theme { Dark, Light };

struct Look {
    Charset charset = Charset::Unicode;
    ColourDepth depth = ColourDepth::True;
    Theme theme = Theme::Dark;
};

// What a sample shows: without colour this alone decides about the glyph.
enum class Stuff : uint8_t { Nothing, Floor, Mark, Solid, Robot, Lamp };

struct Paint {
    Rgb colour;
    Stuff stuff = Stuff::Floor;
};

struct Area {
    int column = 0;
    int row = 0;
    int columns = 1;
    int rows = 1;
};

class Canvas {
public:
    // Shows `width` by `height` metres in the middle of the area, as large as they fit; a cell is
    // twice as high as wide. They cover whole cells, so that opposite edges look the same at every
    // size: what is shown may be stretched by up to half a cell.
    Canvas(Area area, double width, double height);

    // Colours the floor by the place, in metres.
    template <typename ColourAt>
    void floor(const ColourAt& colour_at) {
        for (int y = 0; y < samples_down(); y++) {
            for (int x = 0; x < samples_across(); x++) {
                const Point place = place_of(x, y);
                if (inside(place)) sample(x, y) = {colour_at(place), Stuff::Floor};
            }
        }
    }
    void shape(const Outline& outline, const Paint& paint);
    // Along the four edges: a column wide, half a row high, which is the same on the screen.
    void frame(const Paint& paint);
    void line(Point from, Point to, Rgb colour);
    void dot(Point at, Rgb colour);

    // The cell over a place.
    int column_of(Point at) const;
    int row_of(Point at) const;
    bool inside(Point at) const;

    // Metres that one column covers.
    double column_metres() const { return kAcross * scale_x_; }

    void draw(Grid& grid, const Look& look) const;

private:
    // Samples in a cell: about squares, as a cell is twice as high as wide.
    static constexpr int kAcross = 4;
    static constexpr int kDown = 8;

    struct Dots {
        uint8_t bits = 0;
        Rgb colour;
    };

    int samples_across() const { return area_.columns * kAcross; }
    int samples_down() const { return area_.rows * kDown; }
    Paint& sample(int x, int y) {
        return samples_[static_cast<size_t>(y) * static_cast<size_t>(samples_across()) +
                        static_cast<size_t>(x)];
    }
    const Paint& sample(int x, int y) const {
        return samples_[static_cast<size_t>(y) * static_cast<size_t>(samples_across()) +
                        static_cast<size_t>(x)];
    }
    Point place_of(int x, int y) const;
    Cell cell(int column, int row, const Look& look) const;

    Area area_;
    double width_;
    double height_;
    int columns_ = 1;  // cells that the world covers, in the middle of the area
    int rows_ = 1;
    int left_ = 0;  // samples of margin
    int top_ = 0;
    double scale_x_ = 1;  // metres a sample
    double scale_y_ = 1;
    std::vector<Paint> samples_;
    std::vector<Dots> dots_;
};

}  // namespace vagus::cli
