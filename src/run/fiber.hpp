// Runs code in turn with the one who asked for it, on the same thread but on a stack of its own: a
// fiber of Boost.Context. Code that waits in the middle of calls, loops and catch blocks is left
// there, and goes on there, for some tens of nanoseconds; with a thread in its place that costs
// microseconds.
//
//     class Twice : public FiberCode {
//     public:
//         explicit Twice(Fiber& fiber) : fiber_(fiber) {}
//         void run() override {
//             first();
//             fiber_.give_back();          // waits here, in the middle of it
//             second();
//         }
//     private:
//         Fiber& fiber_;
//     };
//     Twice twice(fiber);
//     fiber.start(twice);                  // first() is done
//     fiber.go_on();                       // second() is done; fiber.ended()
//
// What the code sees is as on a thread of its own: exceptions that it has caught and not yet left
// behind stay its own, and so does what AddressSanitizer and ThreadSanitizer know of its stack
// (they are told of each switch). What belongs to the thread, `thread_local` for instance, it
// shares. A lock that it holds while it waits is held by the thread of all: do not wait with one.
#pragma once

#include <cstddef>
#include <memory>

namespace vagus::run {

// For actors' code, which may call OpenCV. Behind it lies a page that nobody may touch: code that
// needs more ends the program at once, it writes over nothing. Only pages that were used take
// memory.
constexpr size_t kFiberStackBytes = size_t{1} << 20;

// What a fiber runs. It must not throw: std::terminate(), as on a thread.
class FiberCode {
public:
    virtual ~FiberCode() = default;
    virtual void run() = 0;
};

// One code after the other, each on the same stack.
class Fiber {
public:
    // Throws std::bad_alloc where there is no memory for a stack.
    Fiber();
    // No code is on its way any more.
    ~Fiber();
    Fiber(const Fiber&) = delete;
    Fiber& operator=(const Fiber&) = delete;

    // Runs `code` until it gives back or ends; it is borrowed until it has ended. As go_on() not
    // from within the code; both on the thread on which the code began.
    void start(FiberCode& code);
    // Lets the code go on from give_back(), until it gives back again or has ended.
    void go_on();
    // There is no code, or it has run to its end.
    bool ended() const { return code_ == nullptr; }

    // For the code: back to the one who started it, or let it go on; returns when go_on() is
    // called.
    void give_back();

private:
    struct Sides;

    FiberCode* code_ = nullptr;
    std::unique_ptr<Sides> sides_;
};

}  // namespace vagus::run
