// deque.*: a queue with two ends in an array of words (docs/spec/aseba-wire-and-vm.md,
// section 4.5):
//
//     word 0: count N    word 1: position J of the front    words 2 … : a ring of K cells; element
//     i is cell (J + i) % K
//
// The array is the script's: it may hold anything, also counts and positions that make no sense.
// Every access goes through cell(), which stays inside the ring whatever they say.
#include "node/natives.hpp"
#include "node/node.hpp"
#include "node/operands.hpp"

namespace vagus {
namespace node {

namespace {

constexpr uint16_t kHeaderWords = 2;

// A block of elements outside the deque.
struct Block {
    int16_t* words;
    uint16_t size;
};

// The ring has at least one cell: Operands has looked.
class Deque {
public:
    Deque(vm::Vm& vm, int16_t* words, uint16_t size) : vm_(vm), words_(words), size_(size) {}

    uint16_t count() const { return static_cast<uint16_t>(words_[0]); }
    uint16_t capacity() const { return static_cast<uint16_t>(size_ - kHeaderWords); }

    // Each of these gives false and changes nothing after it has raised a fault. Indices may be
    // anything.
    bool get(int32_t index, Block dest);
    bool set(int32_t index, Block src);
    bool insert(int32_t index, Block src);
    bool erase(int32_t index, uint16_t removed);
    // Like insert, but any index is accepted: the end of a full deque is none of its cells.
    bool make_room(int32_t index, Block src);

private:
    uint16_t front() const { return static_cast<uint16_t>(words_[1]); }
    int16_t& cell(uint32_t position) { return words_[kHeaderWords + position % capacity()]; }
    bool fault(int32_t index) {
        vm::raise_out_of_bounds(vm_, capacity(), static_cast<uint16_t>(index));
        return false;
    }
    bool is_cell(int32_t index) const { return index >= 0 && index < capacity(); }
    bool holds(int32_t index, uint16_t size) const {
        return is_cell(index) && size <= int32_t{count()} - index;
    }
    void move_front_forward(int32_t index, uint16_t gap);
    void move_back_backward(int32_t index, uint16_t gap);

    vm::Vm& vm_;
    int16_t* words_;
    uint16_t size_;
};

bool Deque::get(int32_t index, Block dest) {
    if (!holds(index, dest.size)) return fault(index);
    const uint32_t first = uint32_t{front()} + static_cast<uint32_t>(index);
    for (uint16_t k = 0; k < dest.size; ++k) dest.words[k] = cell(first + k);
    return true;
}

bool Deque::set(int32_t index, Block src) {
    if (!holds(index, src.size)) return fault(index);
    const uint32_t first = uint32_t{front()} + static_cast<uint32_t>(index);
    for (uint16_t k = 0; k < src.size; ++k) cell(first + k) = src.words[k];
    return true;
}

bool Deque::insert(int32_t index, Block src) {
    if (!is_cell(index)) return fault(index);
    return make_room(index, src);
}

// The shorter side moves. An index beyond the end is accepted: nothing moves, the cells between
// keep what they held.
bool Deque::make_room(int32_t index, Block src) {
    const uint16_t old_count = count();
    if (src.size > int32_t{capacity()} - old_count) return fault(index);
    if (index < old_count / 2) {
        move_front_forward(index, src.size);
    } else {
        move_back_backward(index, src.size);
    }
    const uint32_t first = uint32_t{front()} + static_cast<uint32_t>(index);
    for (uint16_t k = 0; k < src.size; ++k) cell(first + k) = src.words[k];
    words_[0] = static_cast<int16_t>(static_cast<uint16_t>(old_count + src.size));
    return true;
}

// The front and the `index` elements behind it go `gap` cells toward the front.
void Deque::move_front_forward(int32_t index, uint16_t gap) {
    const uint16_t cells = capacity();
    const uint32_t old_front = front();
    const uint32_t new_front =
        old_front == 0 ? uint32_t{cells} - gap : (old_front + cells - gap) % cells;
    words_[1] = static_cast<int16_t>(static_cast<uint16_t>(new_front));
    const uint32_t end = new_front + static_cast<uint32_t>(index);
    for (uint32_t t = new_front; t < end; ++t) cell(t) = cell(t + gap);
}

// The elements from `index` to the end go `gap` cells toward the back, the last one first.
void Deque::move_back_backward(int32_t index, uint16_t gap) {
    const uint32_t begin = uint32_t{front()} + static_cast<uint32_t>(index) + gap;
    const uint32_t end = uint32_t{front()} + count() + gap;
    for (uint32_t t = end; t > begin; --t) cell(t - 1) = cell(t - 1 - gap);
}

bool Deque::erase(int32_t index, uint16_t removed) {
    if (!holds(index, removed)) return fault(index);
    const uint16_t old_count = count();
    const uint32_t begin = uint32_t{front()} + static_cast<uint32_t>(index);
    if (index < old_count / 2) {
        const uint32_t new_front = uint32_t{front()} + removed;
        for (uint32_t t = begin + removed; t > new_front; --t) cell(t - 1) = cell(t - 1 - removed);
        words_[1] = static_cast<int16_t>(static_cast<uint16_t>(new_front % capacity()));
    } else {
        const uint32_t end = uint32_t{front()} + old_count - removed;
        for (uint32_t t = begin; t < end; ++t) cell(t) = cell(t + removed);
    }
    words_[0] = static_cast<int16_t>(static_cast<uint16_t>(old_count - removed));
    return true;
}

// The words of a deque; nullptr, and a fault, if there are too few to hold anything.
int16_t* deque_memory(vm::Vm& vm, uint16_t address, uint16_t size) {
    int16_t* words = vm::memory(vm, address, size);
    if (words == nullptr || size > kHeaderWords) return words;
    vm::raise_out_of_bounds(vm, 0, 0);
    return nullptr;
}

// Is there an address of an index behind those of deque and block?
enum class Index : uint8_t { Absent, Present };

// The arguments (deque A, block B [, index 1]) of most functions.
struct Operands {
    Operands(Node& node, Index has_index) : index(0) {
        vm::Vm& machine = node.vm;
        const Addresses<2> addresses(machine);
        const bool indexed = has_index == Index::Present;
        const uint16_t index_address = indexed ? vm::pop(machine) : addresses.at[0];
        size = vm::pop(machine);
        block.size = vm::pop(machine);
        words = deque_memory(machine, addresses.at[0], size);
        block.words = vm::memory(machine, addresses.at[1], block.size);
        const int16_t* index_word = vm::memory(machine, index_address, 1);
        valid = words != nullptr && block.words != nullptr && index_word != nullptr;
        if (valid && indexed) index = *index_word;
    }
    Deque deque(Node& node) const { return Deque(node.vm, words, size); }

    int16_t* words;
    uint16_t size;
    Block block;
    int16_t index;
    bool valid;  // false: a fault has been raised
};

}  // namespace

namespace natives {

void deque_size(Node& node) {
    const Addresses<2> addresses(node.vm);
    const uint16_t size = vm::pop(node.vm);
    const int16_t* words = vm::memory(node.vm, addresses.at[0], size);
    int16_t* result = vm::memory(node.vm, addresses.at[1], 1);
    if (words == nullptr || result == nullptr) return;
    *result = size > 0 ? words[0] : int16_t{0};
}

void deque_get(Node& node) {
    const Operands o(node, Index::Present);
    if (o.valid) o.deque(node).get(o.index, o.block);
}

void deque_set(Node& node) {
    const Operands o(node, Index::Present);
    if (o.valid) o.deque(node).set(o.index, o.block);
}

void deque_insert(Node& node) {
    const Operands o(node, Index::Present);
    if (o.valid) o.deque(node).insert(o.index, o.block);
}

void deque_erase(Node& node) {
    const Addresses<3> addresses(node.vm);
    const uint16_t size = vm::pop(node.vm);
    int16_t* words = deque_memory(node.vm, addresses.at[0], size);
    const int16_t* index = vm::memory(node.vm, addresses.at[1], 1);
    const int16_t* removed = vm::memory(node.vm, addresses.at[2], 1);
    if (words == nullptr || index == nullptr || removed == nullptr) return;
    Deque(node.vm, words, size).erase(*index, static_cast<uint16_t>(*removed));
}

void deque_push_front(Node& node) {
    const Operands o(node, Index::Absent);
    if (o.valid) o.deque(node).insert(0, o.block);
}

void deque_push_back(Node& node) {
    const Operands o(node, Index::Absent);
    if (!o.valid) return;
    Deque deque = o.deque(node);
    deque.make_room(deque.count(), o.block);
}

void deque_pop_front(Node& node) {
    const Operands o(node, Index::Absent);
    if (!o.valid) return;
    Deque deque = o.deque(node);
    if (deque.get(0, o.block)) deque.erase(0, o.block.size);
}

void deque_pop_back(Node& node) {
    const Operands o(node, Index::Absent);
    if (!o.valid) return;
    Deque deque = o.deque(node);
    const int32_t index = int32_t{deque.count()} - o.block.size;
    if (deque.get(index, o.block)) deque.erase(index, o.block.size);
}

}  // namespace natives
}  // namespace node
}  // namespace vagus
