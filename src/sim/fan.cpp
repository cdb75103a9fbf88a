#include "sim/fan.hpp"

#include "base/trig.hpp"

namespace vagus::sim {

std::vector<Beam> middle_beams(std::span<const Ray> rays, std::span<const double> distances,
                               const Pose& pose) {
    const double cosine = trig::cos(pose.angle);
    const double sine = trig::sin(pose.angle);
    std::vector<Beam> beams;
    for (size_t i = 0; i < rays.size(); i += kRaysPerSensor) {
        const Ray& ray = rays[i];
        const Point from = {pose.at.x + cosine * ray.from.x - sine * ray.from.y,
                            pose.at.y + sine * ray.from.x + cosine * ray.from.y};
        const Point way = {cosine * ray.direction.x - sine * ray.direction.y,
                           sine * ray.direction.x + cosine * ray.direction.y};
        const double length = distances[i];
        beams.push_back(
            {from, {from.x + way.x * length, from.y + way.y * length}, length < ray.range});
    }
    return beams;
}

}  // namespace vagus::sim
