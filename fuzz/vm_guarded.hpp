// A machine whose memories lie between guard words, for the fuzz targets vm_*. Whatever it is fed,
// it must leave the guards alone (reading them is caught by AddressSanitizer, where it is on), keep
// its own state in range, and send nothing that is longer than a message can be.
#pragma once

#include <sanitizer/asan_interface.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "isa/isa.hpp"
#include "vm/vm.hpp"

namespace vagus::vm {

// Aborts: a fuzz target has found something. (assert would vanish in some builds.)
inline void must(bool holds) {
    if (!holds) std::abort();
}

// `size` words of T between two rows of guard words. Memory begins at a multiple of 8 bytes, as
// AddressSanitizer wants it.
template <typename T>
class Guarded {
public:
    explicit Guarded(size_t size) : size_(size), words_(size + 2 * kGuard, kPattern) {
        std::fill_n(data(), size, T{0});
        lock();
    }
    ~Guarded() { unlock(); }
    Guarded(const Guarded&) = delete;
    Guarded& operator=(const Guarded&) = delete;

    T* data() { return words_.data() + kGuard; }
    uint16_t size() const { return static_cast<uint16_t>(size_); }

    void check() {
        unlock();
        for (size_t i = 0; i < kGuard; ++i) must(words_[i] == kPattern);
        for (size_t i = kGuard + size_; i < words_.size(); ++i) must(words_[i] == kPattern);
        lock();
    }

private:
    static constexpr size_t kGuard = 32;
    static constexpr T kPattern = 0x5aa5;

    void lock() {
        ASAN_POISON_MEMORY_REGION(words_.data(), kGuard * sizeof(T));
        ASAN_POISON_MEMORY_REGION(data() + size_, kGuard * sizeof(T));
    }
    void unlock() { ASAN_UNPOISON_MEMORY_REGION(words_.data(), words_.size() * sizeof(T)); }

    size_t size_;
    std::vector<T> words_;
};

struct GuardedSizes {
    uint16_t bytecode, variables, stack, arguments;
};

class GuardedMachine {
public:
    explicit GuardedMachine(GuardedSizes sizes)
        : bytecode(sizes.bytecode),
          variables(sizes.variables),
          stack(sizes.stack),
          breakpoints(kBreakpointsMax),
          config_{kId,
                  sizes.bytecode,
                  sizes.variables,
                  sizes.stack,
                  sizes.arguments,
                  bytecode.data(),
                  variables.data(),
                  stack.data(),
                  breakpoints.data(),
                  &kHost,
                  this} {
        init(vm, config_);
    }
    GuardedMachine(const GuardedMachine&) = delete;
    GuardedMachine& operator=(const GuardedMachine&) = delete;

    // To be called after everything that is done to the machine.
    void check() {
        bytecode.check();
        variables.check();
        stack.check();
        breakpoints.check();
        must(vm.config == &config_);
        must(vm.depth <= stack.size());
        must(vm.breakpoint_count <= kBreakpointsMax);
        must((vm.flags & ~(wire::kFlagActive | wire::kFlagStep | wire::kFlagRunning)) == 0);
    }

    static constexpr uint16_t kId = 1;

    Guarded<uint16_t> bytecode;
    Guarded<int16_t> variables;
    Guarded<int16_t> stack;
    Guarded<uint16_t> breakpoints;
    Vm vm;

private:
    static GuardedMachine& of(Vm& vm) { return *static_cast<GuardedMachine*>(vm.config->owner); }

    static void send(Vm& vm, uint16_t type, const uint16_t* words, uint16_t count) {
        must(count <= wire::kArgumentsMax);
        must(wire::is_user_event(type) ? type <= isa::kArgumentMask
                                       : type >= 0x9005 && type <= 0x900b);
        for (uint16_t i = 0; i < count; ++i) of(vm).read_ += words[i];
    }
    static void send_variables(Vm& vm, uint16_t start, uint16_t count) {
        must(count == 0 || start + count <= of(vm).variables.size());
    }
    static void send_error(Vm& vm, const char* text) {
        while (*text != '\0') of(vm).read_ += static_cast<unsigned>(*text++);
    }
    // A native that uses what it is given: the id says how many addresses and whether it fails.
    static void native(Vm& vm, uint16_t id) {
        uint16_t addresses[4];
        const unsigned count = id & 3;
        for (unsigned i = 0; i <= count; ++i) addresses[i] = pop(vm);
        const uint16_t size = pop(vm);
        for (unsigned i = 0; i <= count; ++i) {
            int16_t* const place = memory(vm, addresses[i], size);
            if (place == nullptr) return;
            for (uint16_t k = 0; k < size; ++k) place[k] = static_cast<int16_t>(place[k] ^ id);
        }
        if (id & 4) raise_division_by_zero(vm);
        if (id & 8) raise_out_of_bounds(vm, size, id);
        if (id & 16) raise_node_error(vm, "as asked");
    }
    static void notify(Vm&, Notice) {}
    static constexpr Host kHost = {send, send_variables, send_error, native, notify};

    unsigned read_ = 0;
    Config config_;
};

// Takes numbers from the input; zeros when it is used up.
class Input {
public:
    Input(const uint8_t* data, size_t size) : at_(data), end_(data + size) {}

    bool empty() const { return at_ == end_; }
    uint8_t byte() { return empty() ? uint8_t{0} : *at_++; }
    uint16_t word() {
        const unsigned low = byte();
        return static_cast<uint16_t>(low | static_cast<unsigned>(byte()) << 8);
    }

private:
    const uint8_t* at_;
    const uint8_t* end_;
};

}  // namespace vagus::vm
