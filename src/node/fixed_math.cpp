#include "node/fixed_math.hpp"

#include "isa/flash.hpp"

namespace vagus {
namespace node {

namespace {

constexpr int16_t kQuarter = 16384;  // 90 degrees

// Section 4.3, table S: a quarter of a sine in 128 steps. Verbatim, 99 entries differ from the
// rounded sine.
// clang-format off
VAGUS_FLASH_TABLE(int16_t, kSine, 129) = {
        0,   403,   804,  1207,  1608,  2010,  2411,  2812,
     3212,  3612,  4011,  4411,  4808,  5206,  5603,  5998,
     6393,  6787,  7180,  7572,  7962,  8352,  8740,  9127,
     9513,  9896, 10279, 10660, 11040, 11417, 11794, 12167,
    12540, 12911, 13279, 13646, 14010, 14373, 14733, 15091,
    15447, 15801, 16151, 16500, 16846, 17190, 17531, 17869,
    18205, 18538, 18868, 19196, 19520, 19842, 20160, 20476,
    20788, 21097, 21403, 21706, 22006, 22302, 22595, 22884,
    23171, 23453, 23732, 24008, 24279, 24548, 24812, 25073,
    25330, 25583, 25833, 26078, 26320, 26557, 26791, 27020,
    27246, 27467, 27684, 27897, 28106, 28311, 28511, 28707,
    28899, 29086, 29269, 29448, 29622, 29792, 29957, 30117,
    30274, 30425, 30572, 30715, 30852, 30985, 31114, 31238,
    31357, 31471, 31581, 31686, 31786, 31881, 31972, 32057,
    32138, 32215, 32285, 32352, 32413, 32470, 32521, 32569,
    32610, 32647, 32679, 32706, 32728, 32746, 32758, 32766,
    32767,
};

// Section 4.3, table A: 8 entries for each doubling of the quotient, and one. Verbatim, 108 differ
// from the arc tangent.
VAGUS_FLASH_TABLE(int16_t, kArcTangent, 161) = {
      652,   735,   816,   896,   977,  1058,  1139,  1218,
     1300,  1459,  1620,  1777,  1935,  2093,  2250,  2403,
     2556,  2868,  3164,  3458,  3748,  4029,  4307,  4578,
     4839,  5359,  5836,  6290,  6720,  7126,  7507,  7861,
     8203,  8825,  9357,  9839, 10260, 10640, 10976, 11281,
    11557, 12037, 12425, 12755, 13036, 13277, 13486, 13671,
    13837, 14112, 14331, 14514, 14666, 14796, 14907, 15003,
    15091, 15235, 15348, 15441, 15519, 15585, 15642, 15691,
    15736, 15808, 15865, 15912, 15951, 15984, 16013, 16037,
    16060, 16096, 16125, 16148, 16168, 16184, 16199, 16211,
    16222, 16240, 16255, 16266, 16276, 16284, 16292, 16298,
    16303, 16312, 16320, 16325, 16331, 16334, 16338, 16341,
    16344, 16348, 16352, 16355, 16357, 16360, 16361, 16363,
    16364, 16366, 16369, 16369, 16371, 16372, 16373, 16373,
    16375, 16375, 16377, 16376, 16378, 16378, 16378, 16379,
    16379, 16380, 16380, 16380, 16382, 16381, 16381, 16381,
    16382, 16382, 16382, 16382, 16382, 16382, 16384, 16383,
    16383, 16383, 16383, 16383, 16383, 16383, 16383, 16383,
    16383, 16383, 16384, 16384, 16384, 16384, 16384, 16384,
    16384, 16384, 16384, 16384, 16384, 16384, 16384, 16384,
    16384,
};
// clang-format on

// Between entry `index` and the next, `part` of `1 << bits`.
int16_t between(const int16_t* table, uint16_t index, int32_t part, uint8_t bits) {
    const int32_t whole = int32_t{1} << bits;
    const int32_t low = flash_read(table + index);
    const int32_t high = flash_read(table + index + 1);
    return static_cast<int16_t>((low * (whole - part) + high * part) >> bits);
}

// The sine of an angle of the first quarter, its end not included.
int16_t sin_of_quarter(uint16_t angle) {
    return between(kSine, static_cast<uint16_t>(angle >> 7), angle & 127, 7);
}

uint32_t magnitude(int16_t value) {
    return value < 0 ? static_cast<uint32_t>(-static_cast<int32_t>(value))
                     : static_cast<uint32_t>(value);
}

uint8_t highest_bit(uint32_t value) {
    uint8_t position = 0;
    while (value >>= 1) ++position;
    return position;
}

// The angle whose tangent is quotient / 65536, in 0 to 16384.
int32_t arc_tangent(uint32_t quotient) {
    constexpr uint8_t kFirstBit = 12;  // below it a straight line is used
    const uint8_t bit = highest_bit(quotient);
    if (bit < kFirstBit) {
        const uint32_t slope = static_cast<uint32_t>(flash_read(kArcTangent));
        return static_cast<int32_t>((slope * quotient) >> kFirstBit);
    }
    const uint32_t fraction = (quotient - (uint32_t{1} << bit)) >> (bit - 8);
    const uint16_t row = static_cast<uint16_t>((bit - kFirstBit) * 8);
    return between(kArcTangent, static_cast<uint16_t>(row + (fraction >> 5)), fraction & 31, 5);
}

}  // namespace

int16_t fixed_sin(int16_t angle) {
    if (angle == kQuarter) return 32767;
    if (angle == -kQuarter) return -32767;
    const uint16_t turn = static_cast<uint16_t>(magnitude(angle));  // 0 to 32768
    const bool first_quarter = turn < static_cast<uint16_t>(kQuarter);
    const int16_t sine =
        sin_of_quarter(first_quarter ? turn : static_cast<uint16_t>(32768u - turn));
    return angle < 0 ? static_cast<int16_t>(-sine) : sine;
}

int16_t fixed_cos(int16_t angle) {
    return fixed_sin(wrap16(static_cast<uint32_t>(static_cast<int32_t>(angle) + kQuarter)));
}

int16_t fixed_atan2(int16_t y, int16_t x) {
    if (y == 0) return x >= 0 ? 0 : INT16_MIN;
    const bool x_extreme = x == INT16_MIN;
    const bool y_extreme = y == INT16_MIN;
    int32_t angle = kQuarter;
    if (x != 0 && x_extreme == y_extreme) angle = arc_tangent((magnitude(y) << 16) / magnitude(x));
    if (x < 0) angle = 32768 - angle;
    return wrap16(static_cast<uint32_t>(y > 0 ? angle : -angle));
}

Vector2 fixed_rotate(Vector2 v, int16_t angle) {
    const int32_t cosine = fixed_cos(angle);
    const int32_t sine = fixed_sin(angle);
    // Unsigned, so that the sum of two products may wrap.
    const uint32_t x = static_cast<uint32_t>(cosine * v.x) - static_cast<uint32_t>(sine * v.y);
    const uint32_t y = static_cast<uint32_t>(cosine * v.y) + static_cast<uint32_t>(sine * v.x);
    return {wrap16(static_cast<uint32_t>(shift_right(x, 15))),
            wrap16(static_cast<uint32_t>(shift_right(y, 15)))};
}

int16_t whole_sqrt(int16_t value) {
    // Digit by digit in base 4: `root` holds the digits found, `rest` what is left of the value.
    uint16_t rest = static_cast<uint16_t>(value);
    uint16_t root = 0;
    for (uint16_t digit = 1u << 14; digit > 0; digit = static_cast<uint16_t>(digit >> 2)) {
        const uint16_t trial = static_cast<uint16_t>(root + digit);
        root = static_cast<uint16_t>(root >> 1);
        if (rest < trial) continue;
        rest = static_cast<uint16_t>(rest - trial);
        root = static_cast<uint16_t>(root + digit);
    }
    return static_cast<int16_t>(root);
}

int32_t shift_right(uint32_t value, int16_t shift) {
    // On every compiler we use, >> of a negative number copies the sign; the conversion keeps the
    // bits.
    return static_cast<int32_t>(value) >> (static_cast<uint16_t>(shift) & 31);
}

}  // namespace node
}  // namespace vagus
