// math.*: vectors, element by element, from index 0 upward. What is written is read again by later
// elements where vectors overlap; so all of them work in place (section 4.2).
#include "node/fixed_math.hpp"
#include "node/natives.hpp"
#include "node/node.hpp"
#include "node/operands.hpp"

namespace vagus {
namespace node {

namespace {

typedef int16_t (*BinaryFunction)(int16_t left, int16_t right);

int16_t sum(int16_t left, int16_t right) {
    return wrap16(static_cast<uint32_t>(int32_t{left} + right));
}
int16_t difference(int16_t left, int16_t right) {
    return wrap16(static_cast<uint32_t>(int32_t{left} - right));
}
int16_t product(int16_t left, int16_t right) {
    return wrap16(static_cast<uint32_t>(int32_t{left} * right));
}
int16_t smaller(int16_t left, int16_t right) {
    return left < right ? left : right;
}
int16_t larger(int16_t left, int16_t right) {
    return left > right ? left : right;
}

// dest = function(src1, src2)
void for_each_pair(Node& node, BinaryFunction function) {
    const Vectors<3> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) v.words[0][i] = function(v.words[1][i], v.words[2][i]);
}

uint32_t scalar_product(const int16_t* left, const int16_t* right, uint16_t size) {
    uint32_t total = 0;  // wraps
    for (uint16_t i = 0; i < size; ++i) total += static_cast<uint32_t>(int32_t{left[i]} * right[i]);
    return total;
}

// Moves words[root] down until no child is larger: the step of a heap sort, which needs no memory
// and has no bad case.
void sift_down(int16_t* words, uint32_t root, uint32_t size) {
    const int16_t value = words[root];
    for (uint32_t child = 2 * root + 1; child < size; child = 2 * root + 1) {
        if (child + 1 < size && words[child + 1] > words[child]) ++child;
        if (words[child] <= value) break;
        words[root] = words[child];
        root = child;
    }
    words[root] = value;
}

void heap_sort(int16_t* words, uint32_t size) {
    for (uint32_t root = size / 2; root-- > 0;) sift_down(words, root, size);
    while (size > 1) {
        --size;
        const int16_t largest = words[0];
        words[0] = words[size];
        words[size] = largest;
        sift_down(words, 0, size);
    }
}

}  // namespace

namespace natives {

void copy(Node& node) {
    const Vectors<2> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) v.words[0][i] = v.words[1][i];
}

void fill(Node& node) {
    const Addresses<2> addresses(node.vm);
    const uint16_t size = vm::pop(node.vm);
    int16_t* dest = vm::memory(node.vm, addresses.at[0], size);
    const int16_t* value = vm::memory(node.vm, addresses.at[1], 1);
    if (dest == nullptr || value == nullptr) return;
    for (uint16_t i = 0; i < size; ++i) dest[i] = *value;
}

void addscalar(Node& node) {
    const Addresses<3> addresses(node.vm);
    const uint16_t size = vm::pop(node.vm);
    int16_t* dest = vm::memory(node.vm, addresses.at[0], size);
    const int16_t* src = vm::memory(node.vm, addresses.at[1], size);
    const int16_t* scalar = vm::memory(node.vm, addresses.at[2], 1);
    if (dest == nullptr || src == nullptr || scalar == nullptr) return;
    const int16_t added = *scalar;  // read once, before anything is written
    for (uint16_t i = 0; i < size; ++i) dest[i] = sum(src[i], added);
}

void add(Node& node) {
    for_each_pair(node, sum);
}
void sub(Node& node) {
    for_each_pair(node, difference);
}
void mul(Node& node) {
    for_each_pair(node, product);
}
void min(Node& node) {
    for_each_pair(node, smaller);
}
void max(Node& node) {
    for_each_pair(node, larger);
}

void div(Node& node) {
    const Vectors<3> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) {
        const int32_t divisor = v.words[2][i];
        if (divisor == 0) return vm::raise_division_by_zero(node.vm);
        v.words[0][i] = wrap16(static_cast<uint32_t>(v.words[1][i] / divisor));
    }
}

void clamp(Node& node) {
    const Vectors<4> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) {
        const int16_t value = v.words[1][i];
        const int16_t low = v.words[2][i];
        const int16_t high = v.words[3][i];
        // The upper limit is looked at first: that decides where low > high.
        v.words[0][i] = value > high ? high : (value < low ? low : value);
    }
}

void muldiv(Node& node) {
    const Vectors<4> v(node.vm);
    if (!v.valid()) return;
    for (uint16_t i = 0; i < v.size; ++i) {
        const int32_t divisor = v.words[3][i];
        if (divisor == 0) return vm::raise_division_by_zero(node.vm);
        v.words[0][i] =
            wrap16(static_cast<uint32_t>(int32_t{v.words[1][i]} * v.words[2][i] / divisor));
    }
}

void dot(Node& node) {
    const Addresses<4> addresses(node.vm);
    const uint16_t size = vm::pop(node.vm);
    int16_t* dest = vm::memory(node.vm, addresses.at[0], 1);
    const int16_t* src1 = vm::memory(node.vm, addresses.at[1], size);
    const int16_t* src2 = vm::memory(node.vm, addresses.at[2], size);
    const int16_t* shift = vm::memory(node.vm, addresses.at[3], 1);
    if (dest == nullptr || src1 == nullptr || src2 == nullptr || shift == nullptr) return;
    if (*shift > 32) {
        *dest = 0;
        return;
    }
    *dest = wrap16(static_cast<uint32_t>(shift_right(scalar_product(src1, src2, size), *shift)));
}

// min and max are compared where they lie, so a result that overlaps src shows (section 4.2).
void stat(Node& node) {
    const Addresses<4> addresses(node.vm);
    const uint16_t size = vm::pop(node.vm);
    const int16_t* src = vm::memory(node.vm, addresses.at[0], size);
    int16_t* min = vm::memory(node.vm, addresses.at[1], 1);
    int16_t* max = vm::memory(node.vm, addresses.at[2], 1);
    int16_t* mean = vm::memory(node.vm, addresses.at[3], 1);
    if (src == nullptr || min == nullptr || max == nullptr || mean == nullptr || size == 0) return;
    int32_t total = src[0];  // 65535 words cannot overflow it
    *min = src[0];
    *max = src[0];
    for (uint16_t i = 1; i < size; ++i) {
        const int16_t value = src[i];
        if (value < *min) *min = value;
        if (value > *max) *max = value;
        total += value;
    }
    *mean = wrap16(static_cast<uint32_t>(total / static_cast<int32_t>(size)));
}

// The extremes start beyond what a first element could be; so 32767 is never a new minimum, nor
// -32768 a maximum.
void argbounds(Node& node) {
    const Addresses<3> addresses(node.vm);
    const uint16_t size = vm::pop(node.vm);
    const int16_t* src = vm::memory(node.vm, addresses.at[0], size);
    int16_t* argmin = vm::memory(node.vm, addresses.at[1], 1);
    int16_t* argmax = vm::memory(node.vm, addresses.at[2], 1);
    if (src == nullptr || argmin == nullptr || argmax == nullptr) return;
    int16_t smallest = INT16_MAX;
    int16_t largest = INT16_MIN;
    for (uint16_t i = 0; i < size; ++i) {
        const int16_t value = src[i];
        if (value < smallest) {
            smallest = value;
            *argmin = static_cast<int16_t>(i);
        }
        if (value > largest) {
            largest = value;
            *argmax = static_cast<int16_t>(i);
        }
    }
}

void sort(Node& node) {
    const Vectors<1> v(node.vm);
    if (v.valid()) heap_sort(v.words[0], v.size);
}

}  // namespace natives
}  // namespace node
}  // namespace vagus
