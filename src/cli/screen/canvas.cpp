#include "cli/screen/canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace vagus::cli {
namespace {

constexpr int kQuadrants = 4;  // upper left, upper right, lower left, lower right
constexpr int kThinThing = 2;  // samples of the 8 in a quadrant that make it solid: walls are thin
constexpr double kEdgeContrast = 60;  // below this a cell counts as plain, and dots may be on it

// The block for each set of quadrants, bit 0 the upper left.
constexpr std::array<char32_t, 16> kQuarterBlocks = {
    U' ', U'▘', U'▝', U'▀', U'▖', U'▌', U'▞', U'▛', U'▗', U'▚', U'▐', U'▜', U'▄', U'▙', U'▟', U'█'};

struct Mix {
    double r = 0;
    double g = 0;
    double b = 0;
    double weight = 0;

    void add(Rgb colour) {
        r += colour.r;
        g += colour.g;
        b += colour.b;
        weight += 1;
    }
    void add(const Mix& other) {
        r += other.r;
        g += other.g;
        b += other.b;
        weight += other.weight;
    }
    Mix mean() const {
        if (weight <= 0) return {};
        return {r / weight, g / weight, b / weight, 1};
    }
    Colour colour() const {
        if (weight <= 0) return std::nullopt;
        const Mix m = mean();
        return Rgb{static_cast<uint8_t>(std::lround(m.r)), static_cast<uint8_t>(std::lround(m.g)),
                   static_cast<uint8_t>(std::lround(m.b))};
    }
};

double difference(const Mix& a, const Mix& b) {
    const Mix p = a.mean();
    const Mix q = b.mean();
    return std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
}

// A cell as four quadrants, with what most of its samples show.
struct Quarters {
    std::array<Mix, kQuadrants> colour;
    std::array<int, kQuadrants> things{};  // samples of things higher than the floor
    int marks = 0;
    int things_all = 0;
    int seen = 0;
    Stuff most = Stuff::Nothing;

    double contrast() const {
        double most_apart = 0;
        for (const Mix& a : colour) {
            for (const Mix& b : colour) {
                if ((a.weight > 0) != (b.weight > 0)) return kEdgeContrast;
                most_apart = std::max(most_apart, difference(a, b));
            }
        }
        return most_apart;
    }
};

Mix sum(const Quarters& quarters, unsigned set) {
    Mix mix;
    for (unsigned i = 0; i < kQuadrants; i++) {
        if (((set >> i) & 1u) != 0) mix.add(quarters.colour[i]);
    }
    return mix;
}

int things_in(const Quarters& quarters, unsigned set) {
    int things = 0;
    for (unsigned i = 0; i < kQuadrants; i++) {
        if (((set >> i) & 1u) != 0) things += quarters.things[i];
    }
    return things;
}

double cost_of(const Quarters& quarters, unsigned set) {
    const Mix inside = sum(quarters, set);
    const Mix outside = sum(quarters, 15u & ~set);
    double cost = 0;
    for (unsigned i = 0; i < kQuadrants; i++) {
        if (quarters.colour[i].weight <= 0) continue;
        cost += difference(quarters.colour[i], ((set >> i) & 1u) != 0 ? inside : outside);
    }
    return cost;
}

// The two colours and the block that lose least. Quadrants beyond the world stay as the terminal
// is.
Cell coloured_block(const Quarters& quarters) {
    unsigned empty = 0;
    for (unsigned i = 0; i < kQuadrants; i++) {
        if (quarters.colour[i].weight <= 0) empty |= 1u << i;
    }
    if (empty == 15u) return {};
    if (empty != 0) {
        const unsigned set = 15u & ~empty;
        return {kQuarterBlocks[set], {sum(quarters, set).colour(), std::nullopt, false}};
    }
    unsigned best = 0;
    for (unsigned set = 1; set < 8; set++) {
        if (cost_of(quarters, set) + 1 < cost_of(quarters, best)) best = set;
    }
    // Things are glyphs, the floor is what lies behind them: copied as mere text, a page shows the
    // same picture.
    if (best == 0 && quarters.things_all < quarters.seen) {
        return {U' ', {std::nullopt, sum(quarters, 15u).colour(), false}};
    }
    if (things_in(quarters, best) < things_in(quarters, 15u & ~best)) best = 15u & ~best;
    return {kQuarterBlocks[best],
            {sum(quarters, best).colour(), sum(quarters, 15u & ~best).colour(), false}};
}

// Without colour: what is higher than the floor is solid, marks on the floor are a light shade.
Cell plain_block(const Quarters& quarters) {
    unsigned set = 0;
    for (unsigned i = 0; i < kQuadrants; i++) {
        if (quarters.things[i] >= kThinThing) set |= 1u << i;
    }
    if (set == 0 && quarters.marks * 2 > quarters.seen) return {U'░', {}};
    return {kQuarterBlocks[set], {}};
}

Cell letter(const Quarters& quarters, bool coloured) {
    Cell cell;
    switch (quarters.most) {
        case Stuff::Nothing:
        case Stuff::Floor:
            cell.glyph = U' ';
            break;
        case Stuff::Mark:
            cell.glyph = U':';
            break;
        case Stuff::Solid:
            cell.glyph = U'#';
            break;
        case Stuff::Robot:
            cell.glyph = U'o';
            break;
        case Stuff::Lamp:
            cell.glyph = U'*';
            break;
    }
    if (!coloured) return cell;
    cell.ink.back = sum(quarters, 15u).colour();
    if (quarters.most != Stuff::Lamp) cell.glyph = U' ';
    return cell;
}

bool within(const Outline& outline, Point at) {
    if (outline.corners.empty()) {
        return std::hypot(at.x - outline.centre.x, at.y - outline.centre.y) <= outline.radius;
    }
    bool left = false;
    bool right = false;
    Point from = outline.corners.back();
    for (const Point to : outline.corners) {
        const double side = (to.x - from.x) * (at.y - from.y) - (to.y - from.y) * (at.x - from.x);
        left = left || side > 0;
        right = right || side < 0;
        from = to;
    }
    return !(left && right);
}

struct Box {
    Point low;
    Point high;
};

Box box_of(const Outline& outline) {
    if (outline.corners.empty()) {
        return {{outline.centre.x - outline.radius, outline.centre.y - outline.radius},
                {outline.centre.x + outline.radius, outline.centre.y + outline.radius}};
    }
    Box box{outline.corners.front(), outline.corners.front()};
    for (const Point corner : outline.corners) {
        box.low = {std::min(box.low.x, corner.x), std::min(box.low.y, corner.y)};
        box.high = {std::max(box.high.x, corner.x), std::max(box.high.y, corner.y)};
    }
    return box;
}

// The braille bit of a dot in its cell, 2 across and 4 down.
uint8_t braille_bit(int across, int down) {
    static constexpr uint8_t kBits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    return kBits[down][across];
}

}  // namespace

Canvas::Canvas(Area area, double width, double height)
    : area_(area),
      width_(width),
      height_(height),
      samples_(static_cast<size_t>(area.columns * kAcross) * static_cast<size_t>(area.rows * kDown),
               Paint{{}, Stuff::Nothing}),
      dots_(static_cast<size_t>(area.columns) * static_cast<size_t>(area.rows)) {
    const double scale = std::max(width / (area.columns * kAcross), height / (area.rows * kDown));
    const auto cells = [scale](double metres, int samples, int most) {
        return std::clamp(static_cast<int>(std::lround(metres / scale / samples)), 1, most);
    };
    columns_ = cells(width, kAcross, area.columns);
    rows_ = cells(height, kDown, area.rows);
    left_ = (area.columns - columns_) / 2 * kAcross;
    top_ = (area.rows - rows_) / 2 * kDown;
    scale_x_ = width / (columns_ * kAcross);
    scale_y_ = height / (rows_ * kDown);
}

Point Canvas::place_of(int x, int y) const {
    return {(x + 0.5 - left_) * scale_x_, height_ - (y + 0.5 - top_) * scale_y_};
}

bool Canvas::inside(Point at) const {
    return at.x >= 0 && at.y >= 0 && at.x <= width_ && at.y <= height_;
}

void Canvas::shape(const Outline& outline, const Paint& paint) {
    const Box box = box_of(outline);
    const auto across = [&](double x) { return x / scale_x_ + left_; };
    const auto down = [&](double y) { return (height_ - y) / scale_y_ + top_; };
    const int from_x = static_cast<int>(std::clamp(across(box.low.x), 0.0, 1.0 * samples_across()));
    const int to_x =
        static_cast<int>(std::clamp(across(box.high.x) + 1, 0.0, 1.0 * samples_across()));
    const int from_y = static_cast<int>(std::clamp(down(box.high.y), 0.0, 1.0 * samples_down()));
    const int to_y = static_cast<int>(std::clamp(down(box.low.y) + 1, 0.0, 1.0 * samples_down()));
    for (int y = from_y; y < to_y; y++) {
        for (int x = from_x; x < to_x; x++) {
            if (within(outline, place_of(x, y))) sample(x, y) = paint;
        }
    }
}

void Canvas::frame(const Paint& paint) {
    const int right = left_ + columns_ * kAcross;
    const int bottom = top_ + rows_ * kDown;
    for (int y = top_; y < bottom; y++) {
        const bool edge = y < top_ + kDown / 2 || y >= bottom - kDown / 2;
        for (int x = left_; x < right; x++) {
            if (edge || x < left_ + kAcross || x >= right - kAcross) sample(x, y) = paint;
        }
    }
}

void Canvas::dot(Point at, Rgb colour) {
    if (!inside(at)) return;
    const double across = (at.x / scale_x_ + left_) / 2;
    const double down = ((height_ - at.y) / scale_y_ + top_) / 2;
    const int x = std::clamp(static_cast<int>(across), 0, area_.columns * 2 - 1);
    const int y = std::clamp(static_cast<int>(down), 0, area_.rows * 4 - 1);
    Dots& dots = dots_[static_cast<size_t>(y / 4) * static_cast<size_t>(area_.columns) +
                       static_cast<size_t>(x / 2)];
    dots.bits = static_cast<uint8_t>(dots.bits | braille_bit(x % 2, y % 4));
    dots.colour = colour;
}

void Canvas::line(Point from, Point to, Rgb colour) {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const double apart = 2 * std::min(scale_x_, scale_y_);
    const double dots = std::min(length / apart, 4.0 * (area_.columns + area_.rows));
    const int steps = 1 + static_cast<int>(dots);
    for (int i = 0; i <= steps; i++) {
        const double part = 1.0 * i / steps;
        dot({from.x + part * (to.x - from.x), from.y + part * (to.y - from.y)}, colour);
    }
}

int Canvas::column_of(Point at) const {
    return area_.column + static_cast<int>(std::floor((at.x / scale_x_ + left_) / kAcross));
}

int Canvas::row_of(Point at) const {
    return area_.row + static_cast<int>(std::floor(((height_ - at.y) / scale_y_ + top_) / kDown));
}

Cell Canvas::cell(int column, int row, const Look& look) const {
    Quarters quarters;
    std::array<int, 6> count{};
    for (int y = 0; y < kDown; y++) {
        for (int x = 0; x < kAcross; x++) {
            const Paint& paint = sample(column * kAcross + x, row * kDown + y);
            count.at(static_cast<size_t>(paint.stuff))++;
            if (paint.stuff == Stuff::Nothing) continue;
            const auto quadrant = static_cast<size_t>(2 * (y / (kDown / 2)) + x / (kAcross / 2));
            quarters.colour[quadrant].add(paint.colour);
            quarters.seen++;
            if (paint.stuff == Stuff::Mark) quarters.marks++;
            if (paint.stuff >= Stuff::Solid) quarters.things[quadrant]++;
            if (paint.stuff >= Stuff::Solid) quarters.things_all++;
        }
    }
    if (quarters.things_all >= 2 * kThinThing) {
        for (const Stuff flat : {Stuff::Nothing, Stuff::Floor, Stuff::Mark}) {
            count.at(static_cast<size_t>(flat)) = 0;
        }
    }
    const auto most = std::max_element(count.begin(), count.end()) - count.begin();
    quarters.most = static_cast<Stuff>(most);
    const bool coloured = look.depth != ColourDepth::None;
    Cell cell = look.charset == Charset::Ascii ? letter(quarters, coloured)
                : coloured                     ? coloured_block(quarters)
                                               : plain_block(quarters);
    const Dots& dots = dots_[static_cast<size_t>(row) * static_cast<size_t>(area_.columns) +
                             static_cast<size_t>(column)];
    const bool plain =
        quarters.things_all == 0 && (!coloured || quarters.contrast() < kEdgeContrast);
    if (dots.bits == 0 || !plain) return cell;
    cell.glyph = look.charset == Charset::Ascii ? U'.' : U'\u2800' + dots.bits;
    cell.ink.fore = dots.colour;
    if (coloured) cell.ink.back = sum(quarters, 15u).colour();
    return cell;
}

void Canvas::draw(Grid& grid, const Look& look) const {
    for (int row = 0; row < area_.rows; row++) {
        for (int column = 0; column < area_.columns; column++) {
            grid.put(area_.column + column, area_.row + row, cell(column, row, look));
        }
    }
}

}  // namespace vagus::cli
