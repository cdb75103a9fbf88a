// A clock of the calendar that is wrong by WRONG_CLOCK_BY seconds in the program that this library
// is loaded into (LD_PRELOAD): what a computer without a battery for its clock has after its start.
// With WRONG_CLOCK_JUMPS it is wrong in the other direction in every other second. Clocks that
// count from the start of the computer are right.
#include <dlfcn.h>
#include <sys/time.h>

#include <cstdlib>
#include <ctime>

namespace {

using Clock = int (*)(clockid_t, timespec*);

timespec right_now(clockid_t clock) {
    static const auto kClock = reinterpret_cast<Clock>(dlsym(RTLD_NEXT, "clock_gettime"));
    timespec now{};
    kClock(clock, &now);
    return now;
}

time_t wrong_by() {
    const char* const by = std::getenv("WRONG_CLOCK_BY");
    const time_t seconds = by == nullptr ? 0 : std::atoll(by);
    const bool jumps = std::getenv("WRONG_CLOCK_JUMPS") != nullptr;
    return jumps && right_now(CLOCK_MONOTONIC).tv_sec % 2 == 1 ? -seconds : seconds;
}

bool is_of_calendar(clockid_t clock) {
    return clock == CLOCK_REALTIME || clock == CLOCK_REALTIME_COARSE;
}

timespec wrong_now() {
    timespec now = right_now(CLOCK_REALTIME);
    now.tv_sec += wrong_by();
    return now;
}

}  // namespace

extern "C" {

int clock_gettime(clockid_t clock, timespec* told) noexcept {
    *told = is_of_calendar(clock) ? wrong_now() : right_now(clock);
    return 0;
}

int gettimeofday(timeval* told, void*) noexcept {
    const timespec now = wrong_now();
    *told = {now.tv_sec, now.tv_nsec / 1000};
    return 0;
}

time_t time(time_t* told) noexcept {
    const time_t now = wrong_now().tv_sec;
    if (told != nullptr) *told = now;
    return now;
}

}  // extern "C"
