// Reference natives: see evaluate_natives.hpp. Letters in comments are those of appendix A.
#include "reference/evaluate_natives.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdlib>

namespace vagus::aesl {
namespace {

using Block = std::span<int16_t>;
using Ending = std::optional<FaultCause>;

constexpr Ending kFine = std::nullopt;
constexpr std::array<int32_t, 129> kSine = {
    0,     403,   804,   1207,  1608,  2010,  2411,  2812,  3212,  3612,  4011,  4411,  4808,
    5206,  5603,  5998,  6393,  6787,  7180,  7572,  7962,  8352,  8740,  9127,  9513,  9896,
    10279, 10660, 11040, 11417, 11794, 12167, 12540, 12911, 13279, 13646, 14010, 14373, 14733,
    15091, 15447, 15801, 16151, 16500, 16846, 17190, 17531, 17869, 18205, 18538, 18868, 19196,
    19520, 19842, 20160, 20476, 20788, 21097, 21403, 21706, 22006, 22302, 22595, 22884, 23171,
    23453, 23732, 24008, 24279, 24548, 24812, 25073, 25330, 25583, 25833, 26078, 26320, 26557,
    26791, 27020, 27246, 27467, 27684, 27897, 28106, 28311, 28511, 28707, 28899, 29086, 29269,
    29448, 29622, 29792, 29957, 30117, 30274, 30425, 30572, 30715, 30852, 30985, 31114, 31238,
    31357, 31471, 31581, 31686, 31786, 31881, 31972, 32057, 32138, 32215, 32285, 32352, 32413,
    32470, 32521, 32569, 32610, 32647, 32679, 32706, 32728, 32746, 32758, 32766, 32767};
constexpr std::array<int32_t, 161> kArc = {
    652,   735,   816,   896,   977,   1058,  1139,  1218,  1300,  1459,  1620,  1777,  1935,
    2093,  2250,  2403,  2556,  2868,  3164,  3458,  3748,  4029,  4307,  4578,  4839,  5359,
    5836,  6290,  6720,  7126,  7507,  7861,  8203,  8825,  9357,  9839,  10260, 10640, 10976,
    11281, 11557, 12037, 12425, 12755, 13036, 13277, 13486, 13671, 13837, 14112, 14331, 14514,
    14666, 14796, 14907, 15003, 15091, 15235, 15348, 15441, 15519, 15585, 15642, 15691, 15736,
    15808, 15865, 15912, 15951, 15984, 16013, 16037, 16060, 16096, 16125, 16148, 16168, 16184,
    16199, 16211, 16222, 16240, 16255, 16266, 16276, 16284, 16292, 16298, 16303, 16312, 16320,
    16325, 16331, 16334, 16338, 16341, 16344, 16348, 16352, 16355, 16357, 16360, 16361, 16363,
    16364, 16366, 16369, 16369, 16371, 16372, 16373, 16373, 16375, 16375, 16377, 16376, 16378,
    16378, 16378, 16379, 16379, 16380, 16380, 16380, 16382, 16381, 16381, 16381, 16382, 16382,
    16382, 16382, 16382, 16382, 16384, 16383, 16383, 16383, 16383, 16383, 16383, 16383, 16383,
    16383, 16383, 16383, 16384, 16384, 16384, 16384, 16384, 16384, 16384, 16384, 16384, 16384,
    16384, 16384, 16384, 16384, 16384};

int16_t wrap(int64_t value) {
    return static_cast<int16_t>(static_cast<uint64_t>(value));
}

// ---- A.1 ----

int32_t sine_table(int32_t l) {
    const auto i = static_cast<size_t>(l >> 7);
    const int32_t f = l & 127;
    if (f == 0) return kSine[i];
    return (kSine[i] * (128 - f) + kSine[i + 1] * f) >> 7;
}

int16_t sine(int16_t a) {
    if (a == 16384) return 32767;
    if (a == -16384) return -32767;
    if (a >= 0) return wrap(sine_table(a < 16384 ? a : 32768 - a));
    return wrap(-sine_table(a > -16384 ? -a : 32768 + a));
}

int16_t cosine(int16_t a) {
    return sine(wrap(a + 16384));
}

// The quotient's part of atan2: q is |y| / |x| in 16 binary places.
int32_t arc_table(uint32_t q) {
    const int b = q == 0 ? 0 : static_cast<int>(std::bit_width(q)) - 1;
    const int k = b - 12;
    if (k < 0) return static_cast<int32_t>((static_cast<uint32_t>(kArc[0]) * q) >> 12);
    const uint32_t s = (q - (uint32_t{1} << b)) >> (b - 8);
    const auto at = static_cast<size_t>(8 * k) + (s >> 5);
    const auto d = static_cast<int32_t>(s & 31);
    return (kArc[at] * (32 - d) + kArc[at + 1] * d) >> 5;
}

int16_t arc_tangent(int16_t y, int16_t x) {
    if (y == 0) return x >= 0 ? 0 : INT16_MIN;
    int32_t r = 16384;
    const bool is_one_smallest = (x == INT16_MIN) != (y == INT16_MIN);
    if (x != 0 && !is_one_smallest) {
        const auto up = static_cast<uint32_t>(std::abs(int32_t{y}));
        const auto across = static_cast<uint32_t>(std::abs(int32_t{x}));
        r = arc_table((up << 16) / across);
        if (x < 0) r = 32768 - r;
    }
    return wrap(y > 0 ? r : -r);
}

// ---- element by element ----

// dest[i] = of(a[i], b[i]).
template <typename Of>
Ending each(const NativeArguments& p, const Of& of) {
    for (size_t i = 0; i < p[0].size(); ++i) p[0][i] = of(p[1][i], p[2][i]);
    return kFine;
}

template <typename Of>
Ending each_one(const NativeArguments& p, const Of& of) {
    for (size_t i = 0; i < p[0].size(); ++i) p[0][i] = of(p[1][i]);
    return kFine;
}

Ending copy(const NativeArguments& p) {
    return each_one(p, [](int16_t value) { return value; });
}

Ending fill(const NativeArguments& p) {
    const int16_t value = p[1][0];
    for (int16_t& word : p[0]) word = value;
    return kFine;
}

Ending add_scalar(const NativeArguments& p) {
    const int16_t scalar = p[2][0];
    return each_one(p, [scalar](int16_t value) { return wrap(value + scalar); });
}

Ending add(const NativeArguments& p) {
    return each(p, [](int16_t a, int16_t b) { return wrap(a + b); });
}
Ending subtract(const NativeArguments& p) {
    return each(p, [](int16_t a, int16_t b) { return wrap(a - b); });
}
Ending multiply(const NativeArguments& p) {
    return each(p, [](int16_t a, int16_t b) { return wrap(a * b); });
}
Ending smaller(const NativeArguments& p) {
    return each(p, [](int16_t a, int16_t b) { return std::min(a, b); });
}
Ending larger(const NativeArguments& p) {
    return each(p, [](int16_t a, int16_t b) { return std::max(a, b); });
}

Ending divide(const NativeArguments& p) {
    for (size_t i = 0; i < p[0].size(); ++i) {
        if (p[2][i] == 0) return FaultCause::DivisionByZero;
        p[0][i] = wrap(p[1][i] / p[2][i]);
    }
    return kFine;
}

Ending clamp(const NativeArguments& p) {
    for (size_t i = 0; i < p[0].size(); ++i) {
        const int16_t src = p[1][i];
        const int16_t low = p[2][i];
        const int16_t high = p[3][i];
        p[0][i] = src > high ? high : (src < low ? low : src);
    }
    return kFine;
}

Ending dot(const NativeArguments& p) {
    uint32_t sum = 0;
    for (size_t i = 0; i < p[1].size(); ++i)
        sum += static_cast<uint32_t>(int32_t{p[1][i]} * int32_t{p[2][i]});
    const int16_t shift = p[3][0];
    p[0][0] = shift > 32 ? int16_t{0} : wrap(static_cast<int32_t>(sum) >> (shift & 31));
    return kFine;
}

Ending statistics(const NativeArguments& p) {
    int32_t sum = 0;
    for (size_t i = 0; i < p[0].size(); ++i) {
        const int16_t value = p[0][i];
        sum += value;
        if (i == 0 || value < p[1][0]) p[1][0] = value;
        if (i == 0 || value > p[2][0]) p[2][0] = value;
    }
    p[3][0] = wrap(sum / static_cast<int32_t>(p[0].size()));
    return kFine;
}

Ending bounds(const NativeArguments& p) {
    int16_t lowest = INT16_MAX;
    int16_t highest = INT16_MIN;
    for (size_t i = 0; i < p[0].size(); ++i) {
        const int16_t value = p[0][i];
        if (value < lowest) {
            lowest = value;
            p[1][0] = wrap(static_cast<int64_t>(i));
        }
        if (value > highest) {
            highest = value;
            p[2][0] = wrap(static_cast<int64_t>(i));
        }
    }
    return kFine;
}

Ending sort(const NativeArguments& p) {
    std::sort(p[0].begin(), p[0].end());
    return kFine;
}

Ending multiply_divide(const NativeArguments& p) {
    for (size_t i = 0; i < p[0].size(); ++i) {
        if (p[3][i] == 0) return FaultCause::DivisionByZero;
        p[0][i] = wrap(int64_t{p[1][i]} * p[2][i] / p[3][i]);
    }
    return kFine;
}

Ending atan2(const NativeArguments& p) {
    return each(p, arc_tangent);
}
Ending sin(const NativeArguments& p) {
    return each_one(p, sine);
}
Ending cos(const NativeArguments& p) {
    return each_one(p, cosine);
}

Ending rotate(const NativeArguments& p) {
    const int32_t c = cosine(p[2][0]);
    const int32_t s = sine(p[2][0]);
    const int32_t v0 = p[1][0];
    const int32_t v1 = p[1][1];
    p[0][0] = wrap((int64_t{c} * v0 - int64_t{s} * v1) >> 15);
    p[0][1] = wrap((int64_t{c} * v1 + int64_t{s} * v0) >> 15);
    return kFine;
}

Ending square_root(const NativeArguments& p) {
    for (size_t i = 0; i < p[0].size(); ++i) {
        if (p[1][i] < 0) return FaultCause::NodeSpecific;
        int32_t root = 0;
        while ((root + 1) * (root + 1) <= p[1][i]) ++root;
        p[0][i] = wrap(root);
    }
    return kFine;
}

Ending sum(const NativeArguments& p) {
    int64_t total = 0;
    for (const int16_t word : p[1]) total += word;
    p[0][0] = wrap(total);
    return kFine;
}

Ending nothing(const NativeArguments&) {
    return kFine;
}

// ---- A.2 ----

// An array of K + 2 words as a ring: N elements, the first at storage word J.
class Deque {
public:
    explicit Deque(Block array) : array_(array) {}

    bool is_usable() const { return array_.size() >= 3; }
    int capacity() const { return static_cast<int>(array_.size()) - 2; }
    int count() const { return static_cast<uint16_t>(array_[0]); }
    int16_t& at(int index) {
        const int slot = (static_cast<uint16_t>(array_[1]) + index) % capacity();
        return array_[static_cast<size_t>(slot) + 2];
    }

    bool has_range(int index, int length) const {
        return index >= 0 && index < capacity() && length <= count() - index;
    }

    void get(int index, Block to) {
        for (size_t i = 0; i < to.size(); ++i) to[i] = at(index + static_cast<int>(i));
    }
    void set(int index, Block from) {
        for (size_t i = 0; i < from.size(); ++i) at(index + static_cast<int>(i)) = from[i];
    }

    void insert(int index, Block from) {
        const auto length = static_cast<int>(from.size());
        if (index < count() / 2) {
            move_front(-length);
            for (int i = 0; i < index; ++i) at(i) = at(i + length);
        } else {
            for (int i = count() - 1; i >= index; --i) at(i + length) = at(i);
        }
        set(index, from);
        set_count(count() + length);
    }

    void erase(int index, int length) {
        if (index < count() / 2) {
            for (int i = index - 1; i >= 0; --i) at(i + length) = at(i);
            move_front(length);
        } else {
            for (int i = index; i < count() - length; ++i) at(i) = at(i + length);
        }
        set_count(count() - length);
    }

private:
    void set_count(int count) { array_[0] = wrap(count); }
    void move_front(int by) {
        const int moved = static_cast<uint16_t>(array_[1]) + by;
        array_[1] = wrap((moved % capacity() + capacity()) % capacity());
    }

    Block array_;
};

Ending deque_size(const NativeArguments& p) {
    p[1][0] = p[0][0];
    return kFine;
}

Ending deque_get_at(Deque deque, int index, Block to) {
    if (!deque.is_usable() || !deque.has_range(index, static_cast<int>(to.size())))
        return FaultCause::ArrayOutOfBounds;
    deque.get(index, to);
    return kFine;
}

Ending deque_erase_at(Deque deque, int index, int length) {
    if (!deque.is_usable() || !deque.has_range(index, length)) return FaultCause::ArrayOutOfBounds;
    deque.erase(index, length);
    return kFine;
}

// `index` is checked by the caller, where it is checked at all.
Ending deque_insert_at(Deque deque, int index, Block from) {
    if (static_cast<int>(from.size()) > deque.capacity() - deque.count())
        return FaultCause::ArrayOutOfBounds;
    deque.insert(index, from);
    return kFine;
}

Ending deque_get(const NativeArguments& p) {
    return deque_get_at(Deque(p[0]), p[2][0], p[1]);
}

Ending deque_set(const NativeArguments& p) {
    Deque deque(p[0]);
    if (!deque.is_usable() || !deque.has_range(p[2][0], static_cast<int>(p[1].size())))
        return FaultCause::ArrayOutOfBounds;
    deque.set(p[2][0], p[1]);
    return kFine;
}

Ending deque_insert(const NativeArguments& p) {
    const Deque deque(p[0]);
    const int16_t index = p[2][0];
    if (!deque.is_usable() || index < 0 || index >= deque.capacity())
        return FaultCause::ArrayOutOfBounds;
    return deque_insert_at(deque, index, p[1]);
}

Ending deque_erase(const NativeArguments& p) {
    return deque_erase_at(Deque(p[0]), p[1][0], p[2][0]);
}

Ending deque_push_front(const NativeArguments& p) {
    const Deque deque(p[0]);
    if (!deque.is_usable()) return FaultCause::ArrayOutOfBounds;
    return deque_insert_at(deque, 0, p[1]);
}

Ending deque_push_back(const NativeArguments& p) {
    const Deque deque(p[0]);
    if (!deque.is_usable()) return FaultCause::ArrayOutOfBounds;
    return deque_insert_at(deque, deque.count(), p[1]);
}

Ending deque_pop_front(const NativeArguments& p) {
    if (const auto fault = deque_get_at(Deque(p[0]), 0, p[1])) return fault;
    return deque_erase_at(Deque(p[0]), 0, static_cast<int>(p[1].size()));
}

Ending deque_pop_back(const NativeArguments& p) {
    const auto length = static_cast<int>(p[1].size());
    const int index = static_cast<uint16_t>(p[0][0]) - length;
    if (const auto fault = deque_get_at(Deque(p[0]), index, p[1])) return fault;
    return deque_erase_at(Deque(p[0]), index, length);
}

struct Entry {
    std::string_view name;
    Ending (*function)(const NativeArguments&);
};

constexpr Entry kFunctions[] = {
    {"math.copy", copy},
    {"math.fill", fill},
    {"math.addscalar", add_scalar},
    {"math.add", add},
    {"math.sub", subtract},
    {"math.mul", multiply},
    {"math.div", divide},
    {"math.min", smaller},
    {"math.max", larger},
    {"math.clamp", clamp},
    {"math.dot", dot},
    {"math.stat", statistics},
    {"math.argbounds", bounds},
    {"math.sort", sort},
    {"math.muldiv", multiply_divide},
    {"math.atan2", atan2},
    {"math.sin", sin},
    {"math.cos", cos},
    {"math.rot2", rotate},
    {"math.sqrt", square_root},
    {"deque.size", deque_size},
    {"deque.get", deque_get},
    {"deque.set", deque_set},
    {"deque.insert", deque_insert},
    {"deque.erase", deque_erase},
    {"deque.push_front", deque_push_front},
    {"deque.push_back", deque_push_back},
    {"deque.pop_front", deque_pop_front},
    {"deque.pop_back", deque_pop_back},
    {"sys.nop", nothing},
    {"sys.sum", sum},
};

}  // namespace

std::optional<FaultCause> call_native(std::string_view name, const NativeArguments& arguments,
                                      uint16_t& random_state) {
    if (name == "math.rand") {
        for (int16_t& word : arguments[0]) {
            random_state = static_cast<uint16_t>(25173u * random_state + 13849u);
            word = static_cast<int16_t>(random_state);
        }
        return kFine;
    }
    const auto* entry = std::find_if(std::begin(kFunctions), std::end(kFunctions),
                                     [name](const Entry& each) { return each.name == name; });
    assert(entry != std::end(kFunctions));
    return entry->function(arguments);
}

}  // namespace vagus::aesl
