#include "conformance/standard_natives.hpp"

namespace vagus::conformance {

std::span<const StandardNative> standard_natives() {
    static const StandardNative kAll[] = {
        {"math.copy", {-1, -1}},
        {"math.fill", {-1, 1}},
        {"math.addscalar", {-1, -1, 1}},
        {"math.add", {-1, -1, -1}},
        {"math.sub", {-1, -1, -1}},
        {"math.mul", {-1, -1, -1}},
        {"math.div", {-1, -1, -1}},
        {"math.min", {-1, -1, -1}},
        {"math.max", {-1, -1, -1}},
        {"math.clamp", {-1, -1, -1, -1}},
        {"math.dot", {1, -1, -1, 1}},
        {"math.stat", {-1, 1, 1, 1}},
        {"math.argbounds", {-1, 1, 1}},
        {"math.sort", {-1}},
        {"math.muldiv", {-1, -1, -1, -1}},
        {"math.atan2", {-1, -1, -1}},
        {"math.sin", {-1, -1}},
        {"math.cos", {-1, -1}},
        {"math.rot2", {2, 2, 1}},
        {"math.sqrt", {-1, -1}},
        {"math.rand", {-1}},
        {"deque.size", {-1, 1}},
        {"deque.get", {-1, -2, 1}},
        {"deque.set", {-1, -2, 1}},
        {"deque.insert", {-1, -2, 1}},
        {"deque.erase", {-1, 1, 1}},
        {"deque.push_front", {-1, -2}},
        {"deque.push_back", {-1, -2}},
        {"deque.pop_front", {-1, -2}},
        {"deque.pop_back", {-1, -2}},
    };
    return kAll;
}

}  // namespace vagus::conformance
