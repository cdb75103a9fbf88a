#include "sim/sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <tuple>

#include "base/trig.hpp"

namespace vagus::sim {

Sight::Sight(const ArenaSize& size)
    : size_(size), fixed_grid_(size.width, size.height), moving_grid_(size.width, size.height) {}

uint32_t Sight::form_of(const Outline& outline) {
    Form form;
    form.bound = outline.radius;
    const size_t count = outline.corners.size();
    for (size_t i = 0; i < count; ++i) {
        const Point& from = outline.corners[i];
        const Point& to = outline.corners[(i + 1) % count];
        const double length = trig::hypot(to.x - from.x, to.y - from.y);
        const double nx = (to.y - from.y) / length;
        const double ny = -(to.x - from.x) / length;
        form.edges.push_back({nx, ny, nx * from.x + ny * from.y});
        form.bound = std::max(form.bound, trig::hypot(from.x, from.y));
    }
    // Robots of one type share theirs, so that the forms of hundreds stay in the cache. Only the
    // latest is compared: robots are added in a row.
    if (!forms_.empty() && forms_.back().users > 0 && forms_.back().bound == form.bound &&
        forms_.back().edges.size() == count &&
        std::equal(form.edges.begin(), form.edges.end(), forms_.back().edges.begin(),
                   [](const Edge& a, const Edge& b) {
                       return a.nx == b.nx && a.ny == b.ny && a.reach == b.reach;
                   })) {
        return static_cast<uint32_t>(forms_.size() - 1);
    }
    if (free_forms_.empty()) {
        forms_.push_back(std::move(form));
        return static_cast<uint32_t>(forms_.size() - 1);
    }
    const uint32_t index = free_forms_.back();
    free_forms_.pop_back();
    forms_[index] = std::move(form);
    return index;
}

void Sight::add(uint32_t index, const Outline& outline, double height, Mobility mobility) {
    if (index >= seen_.size()) {
        seen_.resize(index + 1);
        stands_.resize(index + 1);
    }
    seen_[index] = {form_of(outline), height, mobility};
    ++forms_[seen_[index].form].users;
    std::vector<uint32_t>& list = mobility == Mobility::Fixed ? fixed_ : moving_;
    list.push_back(index);
    if (mobility == Mobility::Fixed) fixed_current_ = false;
    if (mobility == Mobility::Moving)
        moving_bound_ = std::max(moving_bound_, forms_[seen_[index].form].bound);
}

void Sight::remove(uint32_t index) {
    std::vector<uint32_t>& list = seen_[index].mobility == Mobility::Fixed ? fixed_ : moving_;
    std::erase(list, index);
    if (seen_[index].mobility == Mobility::Fixed)
        fixed_current_ = false;
    else
        moving_grid_.remove(index);
    const uint32_t form = seen_[index].form;
    if (--forms_[form].users == 0) free_forms_.push_back(form);
}

Box Sight::box_of(uint32_t index) const {
    const Stand& at = stands_[index];
    const Form& form = forms_[seen_[index].form];
    const double bound = form.bound;
    return {at.x - bound, at.y - bound, at.x + bound, at.y + bound};
}

void Sight::refresh_fixed() {
    boxes_.clear();
    for (const uint32_t index : fixed_) boxes_.push_back(box_of(index));
    fixed_grid_.build(boxes_);
    fixed_current_ = true;
}

// Exact beside an edge; beyond a corner less than the true distance.
double Sight::distance(const Point& from, uint32_t fixed) const {
    const Point at = stands_[fixed].to_body(from);
    const Form& form = forms_[seen_[fixed].form];
    if (form.edges.empty()) return trig::hypot(at.x, at.y) - form.bound;
    double farthest = -form.bound;
    for (const Edge& edge : form.edges)
        farthest = std::max(farthest, edge.nx * at.x + edge.ny * at.y - edge.reach);
    return farthest;
}

double Sight::room_to_fixed(uint32_t index, double most) const {
    const Stand& at = stands_[index];
    const double radius = bound(index);
    double room = most;
    if (!size_.open) {
        const double border =
            std::min(std::min(at.x, size_.width - at.x), std::min(at.y, size_.height - at.y));
        room = std::min(room, border - radius);
    }
    const double wide = radius + most;
    fixed_grid_.visit({at.x - wide, at.y - wide, at.x + wide, at.y + wide}, [&](uint32_t number) {
        room = std::min(room, distance({at.x, at.y}, fixed_[number]) - radius);
    });
    return room;
}

RayFan::RayFan(std::span<const Ray> rays) : size_(rays.size()) {
    for (size_t i = 0; i < size_; ++i) {
        x[i] = rays[i].from.x;
        y[i] = rays[i].from.y;
        dx[i] = rays[i].direction.x;
        dy[i] = rays[i].direction.y;
        range[i] = rays[i].range;
        reach = std::max(reach, trig::hypot(x[i], y[i]) + range[i]);
    }
}

// Rays stay in the frame of their robot; what may be met is brought there, which is less work.
void Sight::look(uint32_t self, const RayFan& rays, double eye, std::span<double> distances) const {
    const Stand& stand = stands_[self];
    std::copy_n(rays.range.begin(), rays.size(), distances.begin());
    const auto try_body = [&](uint32_t index) {
        const Seen& seen = seen_[index];
        if (index == self || seen.height < eye) return;
        const Stand& at = stands_[index];
        const Form& form = forms_[seen.form];
        const double mx = at.x - stand.x;
        const double my = at.y - stand.y;
        const double near = rays.reach + form.bound;
        if (mx * mx + my * my > near * near) return;
        look_at(form,
                {stand.cosine * mx + stand.sine * my, stand.cosine * my - stand.sine * mx,
                 stand.cosine * at.cosine + stand.sine * at.sine,
                 stand.cosine * at.sine - stand.sine * at.cosine},
                rays, distances);
    };
    const Box box = {stand.x - rays.reach, stand.y - rays.reach, stand.x + rays.reach,
                     stand.y + rays.reach};
    fixed_grid_.visit(box, [&](uint32_t number) { try_body(fixed_[number]); });
    const double wide = rays.reach + moving_bound_ + kStrayMax;
    moving_grid_.visit({stand.x - wide, stand.y - wide, stand.x + wide, stand.y + wide}, try_body);

    const bool inside =
        box.left > 0 && box.low > 0 && box.right < size_.width && box.high < size_.height;
    if (size_.open || inside) return;
    for (size_t i = 0; i < rays.size(); ++i) {
        const Point from = stand.to_world({rays.x[i], rays.y[i]});
        const Beam beam = {from.x, from.y, stand.cosine * rays.dx[i] - stand.sine * rays.dy[i],
                           stand.sine * rays.dx[i] + stand.cosine * rays.dy[i]};
        distances[i] = hit_border(beam, distances[i]);
    }
}

// The disc around the body sorts out most rays, in one pass without branches.
void Sight::look_at(const Form& form, const Stand& stand, const RayFan& rays,
                    std::span<double> distances) const {
    std::array<double, kRaysMax> missed;  // above 0: the ray misses the disc
    const double square = form.bound * form.bound;
    for (size_t i = 0; i < kRaysMax; ++i) {
        const double mx = stand.x - rays.x[i];
        const double my = stand.y - rays.y[i];
        const double along = mx * rays.dx[i] + my * rays.dy[i];
        const double beside = mx * rays.dy[i] - my * rays.dx[i];
        const double past = along - std::min(std::max(along, 0.0), rays.range[i]);
        missed[i] = beside * beside + past * past - square;
    }
    for (size_t i = 0; i < rays.size(); ++i) {
        if (missed[i] > 0) continue;
        const Beam beam = {rays.x[i], rays.y[i], rays.dx[i], rays.dy[i]};
        distances[i] = hit(beam, form, stand, distances[i]);
    }
}

// How far the beam gets, at most `range`.
double Sight::hit(const Beam& beam, const Form& form, const Stand& stand, double range) {
    if (!form.edges.empty()) return hit_polygon(beam, form, stand, range);
    const double mx = stand.x - beam.x;
    const double my = stand.y - beam.y;
    const double along = mx * beam.dx + my * beam.dy;
    const double beside = mx * beam.dy - my * beam.dx;
    const double left = form.bound * form.bound - beside * beside;
    if (left < 0) return range;
    const double half = std::sqrt(left);
    if (along + half < 0) return range;
    return std::min(range, std::max(0.0, along - half));
}

// Clips the beam by each half-plane of the polygon, in the frame of the body.
double Sight::hit_polygon(const Beam& beam, const Form& form, const Stand& stand, double range) {
    const double mx = beam.x - stand.x;
    const double my = beam.y - stand.y;
    const double x = stand.cosine * mx + stand.sine * my;
    const double y = stand.cosine * my - stand.sine * mx;
    const double dx = stand.cosine * beam.dx + stand.sine * beam.dy;
    const double dy = stand.cosine * beam.dy - stand.sine * beam.dx;
    double enter = 0;
    double leave = range;
    for (const Edge& edge : form.edges) {
        const double outside = edge.nx * x + edge.ny * y - edge.reach;  // > 0: beyond this edge
        const double speed = edge.nx * dx + edge.ny * dy;
        if (speed < 0) {
            // The division only where it can move `enter`: outside / -speed > enter.
            if (outside > -speed * enter) enter = outside / -speed;
        } else if (outside > 0) {
            return range;
        } else if (-outside < speed * leave) {
            leave = -outside / speed;
        }
        if (enter > leave) return range;
    }
    return enter;
}

double Sight::hit_border(const Beam& beam, double range) const {
    const auto clip = [&range](double from, double speed, double size) {
        const double room = speed > 0 ? size - from : from;
        const double pace = std::fabs(speed);
        if (room < range * pace) range = std::max(0.0, room / pace);
    };
    clip(beam.x, beam.dx, size_.width);
    clip(beam.y, beam.dy, size_.height);
    return range;
}

void Sight::look_wide(uint32_t self, double ahead, std::span<const double> tangents,
                      std::span<Column> columns) const {
    Stand eye = stands_[self];
    const Point from = eye.to_world({ahead, 0});
    eye.x = from.x;
    eye.y = from.y;
    constexpr double kFar = 4 * kWorldSizeMax;
    for (size_t i = 0; i < tangents.size(); ++i) {
        const double length = std::sqrt(1 + tangents[i] * tangents[i]);
        const Beam beam = {eye.x, eye.y, (eye.cosine - eye.sine * tangents[i]) / length,
                           (eye.sine + eye.cosine * tangents[i]) / length};
        columns[i] = {size_.open ? kFar : hit_border(beam, kFar), size_.open ? BodyId{} : kBorder};
    }
    for (const std::vector<uint32_t>* list : {&fixed_, &moving_}) {
        for (const uint32_t index : *list)
            if (index != self) see_wide(index, eye, tangents, columns);
    }
}

// The columns that the bounding disc of a body can cover.
Sight::Span Sight::columns_of(uint32_t index, const Stand& eye,
                              std::span<const double> tangents) const {
    const Stand& stand = stands_[index];
    const double bound = forms_[seen_[index].form].bound;
    const double mx = stand.x - eye.x;
    const double my = stand.y - eye.y;
    const double ahead = eye.cosine * mx + eye.sine * my;
    const double left = eye.cosine * my - eye.sine * mx;
    if (ahead < -bound) return {0, 0};
    if (ahead <= bound) return {0, tangents.size()};
    // The tangents to the corners of the square around the disc hold the disc between them.
    const double low = left - bound;
    const double high = left + bound;
    const double from = low / (low > 0 ? ahead + bound : ahead - bound);
    const double to = high / (high > 0 ? ahead - bound : ahead + bound);
    const auto first = std::lower_bound(tangents.begin(), tangents.end(), from);
    const auto end = std::upper_bound(tangents.begin(), tangents.end(), to);
    return {static_cast<size_t>(first - tangents.begin()),
            static_cast<size_t>(end - tangents.begin())};
}

// Tries one body in the columns that it can cover.
void Sight::see_wide(uint32_t index, const Stand& eye, std::span<const double> tangents,
                     std::span<Column> columns) const {
    const Stand& stand = stands_[index];
    const Span span = columns_of(index, eye, tangents);
    for (size_t i = span.first; i < span.end; ++i) {
        const double length = std::sqrt(1 + tangents[i] * tangents[i]);
        const Beam beam = {eye.x, eye.y, (eye.cosine - eye.sine * tangents[i]) / length,
                           (eye.sine + eye.cosine * tangents[i]) / length};
        const double distance = hit(beam, forms_[seen_[index].form], stand, columns[i].distance);
        if (distance < columns[i].distance) columns[i] = {distance, BodyId{index}};
    }
}

// ---- cameras ----

void Sight::slice(uint32_t self, const Stand& eye, std::span<const double> tangents,
                  std::vector<Slice>& slices) const {
    slices.clear();
    if (!size_.open) slice_border(eye, tangents, slices);
    for (const std::vector<uint32_t>* list : {&fixed_, &moving_}) {
        for (const uint32_t index : *list)
            if (index != self) slice_body(index, eye, tangents, slices);
    }
    std::sort(slices.begin(), slices.end(), [](const Slice& a, const Slice& b) {
        return std::tie(a.column, a.enter, a.body) < std::tie(b.column, b.enter, b.body);
    });
}

namespace {

// The part of a line inside a disc or a polygon around the origin, and the outward normal where it
// goes in.
struct Passage {
    double enter = 0;
    double leave = 0;
    Point normal;
};

std::optional<Passage> pass_disc(const Point& from, const Point& way, double radius) {
    const double square = way.x * way.x + way.y * way.y;
    const double along = -(from.x * way.x + from.y * way.y) / square;
    const double beside = from.x * way.y - from.y * way.x;
    const double left = radius * radius - beside * beside / square;
    if (left < 0) return std::nullopt;
    const double half = std::sqrt(left / square);
    const double enter = along - half;
    return Passage{enter,
                   along + half,
                   {(from.x + enter * way.x) / radius, (from.y + enter * way.y) / radius}};
}

template <typename Edges>
std::optional<Passage> pass_polygon(const Point& from, const Point& way, const Edges& edges) {
    Passage passage = {-1e9, 1e9, {}};
    for (const auto& edge : edges) {
        const double outside = edge.nx * from.x + edge.ny * from.y - edge.reach;
        const double speed = edge.nx * way.x + edge.ny * way.y;
        if (speed < 0 && -outside / speed > passage.enter) {
            passage.enter = -outside / speed;
            passage.normal = {edge.nx, edge.ny};
        } else if (speed > 0) {
            passage.leave = std::min(passage.leave, -outside / speed);
        } else if (speed == 0 && outside > 0) {
            return std::nullopt;
        }
    }
    if (passage.enter > passage.leave) return std::nullopt;
    return passage;
}

}  // namespace

// Lines of sight have depth 1 in one unit of their length, so lengths along them are depths.
void Sight::slice_body(uint32_t index, const Stand& eye, std::span<const double> tangents,
                       std::vector<Slice>& slices) const {
    const Stand& stand = stands_[index];
    const Form& form = forms_[seen_[index].form];
    const Span span = columns_of(index, eye, tangents);
    const Point from = stand.to_body({eye.x, eye.y});
    for (size_t i = span.first; i < span.end; ++i) {
        const Point ray = {eye.cosine - eye.sine * tangents[i],
                           eye.sine + eye.cosine * tangents[i]};
        const Point way = {stand.cosine * ray.x + stand.sine * ray.y,
                           stand.cosine * ray.y - stand.sine * ray.x};
        const auto passage = form.edges.empty() ? pass_disc(from, way, form.bound)
                                                : pass_polygon(from, way, form.edges);
        // What begins behind the camera is around it, and hides nothing: the camera is above it.
        if (!passage || passage->enter <= 0) continue;
        const auto& [enter, leave, normal] = *passage;
        slices.push_back({.column = static_cast<uint32_t>(i),
                          .body = BodyId{index},
                          .enter = enter,
                          .leave = leave,
                          .height = seen_[index].height,
                          .normal = {stand.cosine * normal.x - stand.sine * normal.y,
                                     stand.sine * normal.x + stand.cosine * normal.y},
                          .on_body = {from.x + enter * way.x, from.y + enter * way.y}});
    }
}

void Sight::slice_border(const Stand& eye, std::span<const double> tangents,
                         std::vector<Slice>& slices) const {
    constexpr double kFar = 4 * kWorldSizeMax;
    for (size_t i = 0; i < tangents.size(); ++i) {
        const Beam beam = {eye.x, eye.y, eye.cosine - eye.sine * tangents[i],
                           eye.sine + eye.cosine * tangents[i]};
        const double depth = hit_border(beam, kFar);
        const Point at = {eye.x + depth * beam.dx, eye.y + depth * beam.dy};
        // The nearest of the four sides is the one that was hit.
        const double side = std::min(at.x, size_.width - at.x);
        const bool upright = side < std::min(at.y, size_.height - at.y);
        const Point normal =
            upright ? Point{beam.dx > 0 ? -1.0 : 1.0, 0} : Point{0, beam.dy > 0 ? -1.0 : 1.0};
        slices.push_back({.column = static_cast<uint32_t>(i),
                          .body = kBorder,
                          .enter = depth,
                          .leave = kFar,
                          .height = kBorderHeight,
                          .normal = normal,
                          .on_body = at});
    }
}

}  // namespace vagus::sim
