// A mapped file that somebody else makes shorter: pages that it has no longer are read as zeros.
// Otherwise the system ends the process with SIGBUS at the next look at them. Readers of such files
// check what they read.
//
//     guard_pages(data, size);   // of a mapping that is only read
//     …
//     unguard_pages(data);       // before munmap()
#pragma once

#include <cstddef>

namespace vagus {

constexpr size_t kGuardedMax = 64;  // mappings at a time; those beyond it are not guarded

// From any thread. The first call takes the signal for the whole process.
void guard_pages(const void* data, size_t size);
void unguard_pages(const void* data);

}  // namespace vagus
