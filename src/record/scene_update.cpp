#include "record/scene_update.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/json.hpp"
#include "base/trig.hpp"
#include "record/topics.hpp"

namespace vagus::record {

namespace {

constexpr std::string_view kNothingDeleted = "[]";

struct Number {
    std::string_view before;  // text
    double value = 0;
    int decimals = 0;
};

void append_exact(std::string& to, double value, int decimals) {
    constexpr size_t kLongest = 400;  // the largest double, all digits
    std::array<char, kLongest> text;
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value,
                                   std::chars_format::fixed, decimals);
    to.append(text.data(), end.ptr);
}

// The digits of a number without its point, which comes before the last `decimals`.
void append_digits(std::string& to, uint64_t number, int decimals) {
    constexpr size_t kLongest = 24;
    std::array<char, kLongest> text;
    char* begin = text.data() + text.size();
    for (int i = 0; number > 0 || i <= decimals; ++i) {
        if (i == decimals) *--begin = '.';
        *--begin = static_cast<char>('0' + number % 10);
        number /= 10;
    }
    to.append(begin, text.data() + text.size());
}

// As "%.6f" has it, to the byte. Ten robots take a thousand numbers a second: all but a few are
// rounded as whole numbers, which takes a tenth of the time that their exact digits take.
void append(std::string& to, const Number& number) {
    constexpr std::array<double, 7> kPowers = {1, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6};
    // So that the product is off by less than a hundredth of kDoubt.
    constexpr double kLargest = 1e9;
    constexpr double kDoubt = 1e-4;
    const double scaled = std::abs(number.value) * kPowers[static_cast<size_t>(number.decimals)];
    const double whole = std::floor(scaled);
    const double rest = scaled - whole;
    to += number.before;
    // Half, or next to it: up or down is for the exact digits to say. So is what is no number.
    if (!(scaled < kLargest) || std::abs(rest - 0.5) < kDoubt) {
        return append_exact(to, number.value, number.decimals);
    }
    if (std::signbit(number.value)) to += '-';
    append_digits(to, static_cast<uint64_t>(whole) + (rest > 0.5 ? 1 : 0), number.decimals);
}

void append_pose(std::string& to, const Shape& shape) {
    append(to, {R"("pose":{"position":{"x":)", shape.pose.at.x, 6});
    append(to, {R"(,"y":)", shape.pose.at.y, 6});
    append(to, {R"(,"z":)", shape.height / 2, 3});
    append(to, {R"(},"orientation":{"x":0,"y":0,"z":)", trig::sin(shape.pose.angle / 2), 6});
    append(to, {R"(,"w":)", trig::cos(shape.pose.angle / 2), 6});
    to += "}}";
}

void append_entity(std::string& to, const Shape& shape, std::string_view stamp) {
    const bool round = shape.radius > 0;
    to += R"({"timestamp":)";
    to += stamp;
    to += R"(,"frame_id":"world","id":)";
    to += json_quote(shape.id);
    to += R"(,"lifetime":{"sec":0,"nsec":0},"frame_locked":false,"metadata":[],)";
    to += round ? R"("cylinders":[{)" : R"("cubes":[{)";
    append_pose(to, shape);
    append(to, {R"(,"size":{"x":)", round ? 2 * shape.radius : shape.x, 4});
    append(to, {R"(,"y":)", round ? 2 * shape.radius : shape.y, 4});
    append(to, {R"(,"z":)", shape.height, 4});
    append(to, {R"(},"color":{"r":)", shape.colour.r, 3});
    append(to, {R"(,"g":)", shape.colour.g, 3});
    append(to, {R"(,"b":)", shape.colour.b, 3});
    to += R"(,"a":1})";
    if (round) to += R"(,"bottom_scale":1,"top_scale":1)";
    to += "}]}";
}

std::string update(std::span<const Shape> shapes, std::string_view stamp,
                   std::string_view deletions) {
    constexpr size_t kBytesOfEntity = 400;  // about
    std::string text;
    text.reserve(kBytesOfEntity * (shapes.size() + 1));
    text += R"({"deletions":)";
    text += deletions;
    text += R"(,"entities":[)";
    for (const Shape& shape : shapes) {
        if (&shape != shapes.data()) text += ',';
        append_entity(text, shape, stamp);
    }
    return text + "]}";
}

}  // namespace

std::string key_of(const sim::ObjectView& object) {
    const std::string& id = object.definition->id;
    return id.empty() ? fmt::format("object {}", object.id.number) : id;
}

Shape shape_of(const sim::ObjectView& object) {
    const sim::ObjectDefinition& of = *object.definition;
    return {"object/" + key_of(object),
            object.pose,
            of.height,
            of.width,
            of.length,
            of.radius,
            of.colour};
}

Shape shape_of(const sim::RobotView& robot) {
    constexpr double kHeight = 0.1;  // for the eye only
    double x = 0;
    double y = 0;
    for (const sim::Point& point : robot.outline) {
        x = std::max(x, 2 * std::abs(point.x));
        y = std::max(y, 2 * std::abs(point.y));
    }
    return {"robot/" + std::string(robot.name), robot.pose, kHeight, x, y, 0, robot.paint};
}

std::string scene_update(std::span<const Shape> shapes, Time at) {
    return update(shapes, stamp_json(at), kNothingDeleted);
}

std::string whole_scene(std::span<const Shape> shapes, Time at) {
    const std::string stamp = stamp_json(at);
    // 1: all entities of this topic before these.
    return update(shapes, stamp, R"([{"timestamp":)" + stamp + R"(,"type":1,"id":""}])");
}

}  // namespace vagus::record
