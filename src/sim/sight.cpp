#include "sim/sight.hpp"

#include <algorithm>
#include <array>
#include <cmath>

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
    if (seen_[index].mobility == Mobility::Fixed) fixed_current_ = false;
    const uint32_t form = seen_[index].form;
    if (--forms_[form].users == 0) free_forms_.push_back(form);
}

Box Sight::box_of(uint32_t index) const {
    const Stand& at = stands_[index];
    const Form& form = forms_[seen_[index].form];
    const double bound = form.bound;
    return {at.x - bound, at.y - bound, at.x + bound, at.y + bound};
}

void Sight::refresh() {
    if (!fixed_current_) refresh_fixed();
    boxes_.clear();
    for (const uint32_t index : moving_) {
        const Stand& at = stands_[index];
        boxes_.push_back({at.x, at.y, at.x, at.y});
    }
    moving_grid_.build(boxes_);
}

void Sight::refresh_fixed() {
    boxes_.clear();
    for (const uint32_t index : fixed_) boxes_.push_back(box_of(index));
    fixed_grid_.build(boxes_);
    fixed_current_ = true;
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
    const Box wide = {box.left - moving_bound_, box.low - moving_bound_, box.right + moving_bound_,
                      box.high + moving_bound_};
    moving_grid_.visit(wide, [&](uint32_t number) { try_body(moving_[number]); });

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

// Tries one body in the columns that its bounding disc can cover.
void Sight::see_wide(uint32_t index, const Stand& eye, std::span<const double> tangents,
                     std::span<Column> columns) const {
    const Stand& stand = stands_[index];
    const double bound = forms_[seen_[index].form].bound;
    const double mx = stand.x - eye.x;
    const double my = stand.y - eye.y;
    const double ahead = eye.cosine * mx + eye.sine * my;
    const double left = eye.cosine * my - eye.sine * mx;
    if (ahead < -bound) return;
    size_t first = 0;
    size_t end = tangents.size();
    if (ahead > bound) {
        // The tangents to the corners of the square around the disc hold the disc between them.
        const double low = left - bound;
        const double high = left + bound;
        const double from = low / (low > 0 ? ahead + bound : ahead - bound);
        const double to = high / (high > 0 ? ahead - bound : ahead + bound);
        first = static_cast<size_t>(std::lower_bound(tangents.begin(), tangents.end(), from) -
                                    tangents.begin());
        end = static_cast<size_t>(std::upper_bound(tangents.begin(), tangents.end(), to) -
                                  tangents.begin());
    }
    for (size_t i = first; i < end; ++i) {
        const double length = std::sqrt(1 + tangents[i] * tangents[i]);
        const Beam beam = {eye.x, eye.y, (eye.cosine - eye.sine * tangents[i]) / length,
                           (eye.sine + eye.cosine * tangents[i]) / length};
        const double distance = hit(beam, forms_[seen_[index].form], stand, columns[i].distance);
        if (distance < columns[i].distance) columns[i] = {distance, BodyId{index}};
    }
}

}  // namespace vagus::sim
