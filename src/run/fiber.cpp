// This file is compiled without sanitizers (CMakeLists.txt): Boost.Context switches stacks where a
// fiber is made and where it ends, too, in the middle of functions of its own. Were those watched,
// a sanitizer would take the one stack for the other. All else that runs on a fiber is watched.
#include "run/fiber.hpp"

#include <cxxabi.h>

#include <boost/context/fiber.hpp>
#include <boost/context/protected_fixedsize_stack.hpp>
#include <cassert>
#include <utility>

// Of the sanitizers (sanitizer/common_interface_defs.h, tsan_interface.h). Weak: in a program
// without them they are null. So one library serves programs with and without.
extern "C" {
[[gnu::weak]] void __sanitizer_start_switch_fiber(void** fake_stack, const void* bottom,
                                                  size_t size);
[[gnu::weak]] void __sanitizer_finish_switch_fiber(void* fake_stack, const void** old_bottom,
                                                   size_t* old_size);
[[gnu::weak]] void* __tsan_get_current_fiber();
[[gnu::weak]] void* __tsan_create_fiber(unsigned flags);
[[gnu::weak]] void __tsan_destroy_fiber(void* fiber);
[[gnu::weak]] void __tsan_switch_to_fiber(void* fiber, unsigned flags);
}

namespace vagus::run {

namespace {

namespace context = boost::context;

// What the C++ library keeps for each thread of exceptions that are on their way or caught: a chain
// and a count (Itanium C++ ABI, Exception Handling, 2.2.2). Without an exchange, two catch blocks
// that code waits in would leave the chain in another order than they entered it.
struct Exceptions {
    void* caught = nullptr;
    unsigned int uncaught = 0;
#ifdef __ARM_EABI_UNWINDER__
    void* propagating = nullptr;  // Exception Handling ABI for the Arm Architecture, 8.2
#endif
};

Exceptions& exceptions_of_thread() {
    return *reinterpret_cast<Exceptions*>(abi::__cxa_get_globals());
}

// One of the two stacks, and what must change hands with it besides registers. A switch is
//
//     here.leave_for(there);  …Boost's resume()…  here.arrive_from(there);
//
// with the same two calls, the other way round, on the other side.
class Side {
public:
    // On the stack that is left, last thing before the switch. `for_good`: nobody comes back.
    // Not inlined, as arrive_from(): where the thread keeps its own is looked up at each call.
    [[gnu::noinline]] void leave_for(const Side& there, bool for_good = false) {
        exceptions_ = exceptions_of_thread();
        if (__sanitizer_start_switch_fiber) {
            __sanitizer_start_switch_fiber(for_good ? nullptr : &fake_stack_, there.bottom_,
                                           there.size_);
        }
        if (__tsan_switch_to_fiber) __tsan_switch_to_fiber(there.tsan_fiber_, 0);
    }

    // On the stack that has been arrived at, first thing. AddressSanitizer tells the bounds of the
    // other one, which is how those of the executor's become known.
    [[gnu::noinline]] void arrive_from(Side& there) {
        if (__sanitizer_finish_switch_fiber) {
            __sanitizer_finish_switch_fiber(fake_stack_, &there.bottom_, &there.size_);
        }
        exceptions_of_thread() = exceptions_;
    }

    // The stack that this is called on.
    void be_this_one() {
        if (__tsan_get_current_fiber) tsan_fiber_ = __tsan_get_current_fiber();
    }
    // A stack that nothing has run on.
    void be_new(const context::stack_context& stack) {
        bottom_ = static_cast<const char*>(stack.sp) - stack.size;
        size_ = stack.size;
        if (__tsan_create_fiber) tsan_fiber_ = __tsan_create_fiber(0);
    }
    void forget_new() {
        if (__tsan_destroy_fiber) __tsan_destroy_fiber(tsan_fiber_);
    }

private:
    Exceptions exceptions_;
    // AddressSanitizer's
    const void* bottom_ = nullptr;
    size_t size_ = 0;
    void* fake_stack_ = nullptr;
    // ThreadSanitizer's
    void* tsan_fiber_ = nullptr;
};

}  // namespace

struct Fiber::Sides {
    Side executor;
    Side code;
    context::fiber other;  // the one of the two that does not run
    bool over = false;     // the fiber ends when it is switched to

    void switch_over(Side& here, Side& there) {
        here.leave_for(there);
        other = std::move(other).resume();
        here.arrive_from(there);
    }
    void switch_to_code() {
        executor.be_this_one();
        switch_over(executor, code);
    }
    void switch_to_executor() { switch_over(code, executor); }
};

Fiber::Fiber() : sides_(std::make_unique<Sides>()) {
    context::protected_fixedsize_stack stacks(kFiberStackBytes);
    const context::stack_context stack = stacks.allocate();
    sides_->code.be_new(stack);
    const auto take_turns = [this](context::fiber&& executor) {
        Sides& sides = *sides_;
        sides.other = std::move(executor);
        sides.code.arrive_from(sides.executor);
        while (!sides.over) {
            code_->run();
            code_ = nullptr;
            sides.switch_to_executor();
        }
        sides.code.leave_for(sides.executor, true);
        return std::move(sides.other);
    };
    sides_->other = context::fiber(
        std::allocator_arg, context::preallocated(stack.sp, stack.size, stack), stacks, take_turns);
}

Fiber::~Fiber() {
    assert(ended());
    sides_->over = true;
    sides_->switch_to_code();
    sides_->code.forget_new();
}

void Fiber::start(FiberCode& code) {
    assert(ended());
    code_ = &code;
    sides_->switch_to_code();
}

void Fiber::go_on() {
    assert(!ended());
    sides_->switch_to_code();
}

void Fiber::give_back() {
    sides_->switch_to_executor();
}

}  // namespace vagus::run
