#include "base/lost_pages.hpp"

#include <signal.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>

namespace vagus {
namespace {

// What the handler looks at. It may run between any two instructions, so a place is taken by its
// begin, written last, and left by it first.
struct Guarded {
    std::atomic<uintptr_t> begin = 0;  // 0: free
    std::atomic<size_t> size = 0;
};
static_assert(std::atomic<uintptr_t>::is_always_lock_free);

std::array<Guarded, kGuardedMax> guarded;
std::mutex guarded_mutex;  // of those who write; never of the handler
uintptr_t page_bytes = 0;

bool is_guarded(uintptr_t address) {
    for (const Guarded& one : guarded) {
        const uintptr_t begin = one.begin;
        if (begin != 0 && address >= begin && address - begin < one.size) return true;
    }
    return false;
}

// Puts an empty page where the file has none, or lets the instruction fail again without this
// handler.
void on_lost_page(int, siginfo_t* info, void*) {
    const auto address = reinterpret_cast<uintptr_t>(info->si_addr);
    void* const page = reinterpret_cast<void*>(address / page_bytes * page_bytes);
    const bool replaced =
        is_guarded(address) && ::mmap(page, page_bytes, PROT_READ,
                                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) != MAP_FAILED;
    if (!replaced) ::signal(SIGBUS, SIG_DFL);
}

void take_signal() {
    page_bytes = static_cast<uintptr_t>(::sysconf(_SC_PAGESIZE));
    struct sigaction action = {};
    action.sa_sigaction = on_lost_page;
    action.sa_flags = SA_SIGINFO;
    ::sigaction(SIGBUS, &action, nullptr);
}

}  // namespace

void guard_pages(const void* data, size_t size) {
    static std::once_flag once;
    std::call_once(once, take_signal);
    const std::lock_guard lock(guarded_mutex);
    for (Guarded& one : guarded) {
        if (one.begin != 0) continue;
        one.size = size;
        one.begin = reinterpret_cast<uintptr_t>(data);
        return;
    }
}

void unguard_pages(const void* data) {
    const std::lock_guard lock(guarded_mutex);
    for (Guarded& one : guarded) {
        if (one.begin == reinterpret_cast<uintptr_t>(data)) one.begin = 0;
    }
}

}  // namespace vagus
