#include "survive.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>

namespace vagus::aesl {
namespace {

constexpr long kProcessorSecondsMax = 5;        // for one piece of work
constexpr rlim_t kMemoryMax = rlim_t{4} << 30;  // bytes of address space
constexpr char kRecordEnd = '\0';               // between what the pieces of work say

void limit_processor_time() {
    const itimerval limit{{0, 0}, {kProcessorSecondsMax, 0}};
    setitimer(ITIMER_VIRTUAL, &limit, nullptr);  // SIGVTALRM ends the process
}

void write_all(int file, const std::string& bytes) {
    for (size_t done = 0; done < bytes.size();) {
        const ssize_t written = write(file, bytes.data() + done, bytes.size() - done);
        if (written <= 0) _exit(EXIT_FAILURE);
        done += static_cast<size_t>(written);
    }
}

[[noreturn]] void run_child(int out, size_t first, size_t count,
                            const std::function<std::string(size_t)>& work) {
    const rlimit no_core{0, 0};
    const rlimit memory{kMemoryMax, kMemoryMax};
    setrlimit(RLIMIT_CORE, &no_core);
    setrlimit(RLIMIT_AS, &memory);
    dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);  // its last words are not ours
    for (size_t i = first; i < count; ++i) {
        limit_processor_time();
        write_all(out, work(i) + kRecordEnd);
    }
    _exit(EXIT_SUCCESS);
}

std::string read_all(int file) {
    std::string bytes;
    char block[4096];
    for (ssize_t got; (got = read(file, block, sizeof block)) > 0;)
        bytes.append(block, static_cast<size_t>(got));
    return bytes;
}

// Everything that one child says, from piece `first` on.
std::string one_child(size_t first, size_t count, const std::function<std::string(size_t)>& work) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe for a child process");
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("no child process");
    if (child == 0) {
        close(ends[0]);
        run_child(ends[1], first, count, work);
    }
    close(ends[1]);
    const std::string said = read_all(ends[0]);
    close(ends[0]);
    int status = 0;
    waitpid(child, &status, 0);
    return said;
}

}  // namespace

Survivors survive(size_t count, const std::function<std::string(size_t)>& work) {
    Survivors all;
    while (all.said.size() < count) {
        const std::string said = one_child(all.said.size(), count, work);
        for (size_t begin = 0, end = 0; (end = said.find(kRecordEnd, begin)) != std::string::npos;
             begin = end + 1)
            all.said.push_back(said.substr(begin, end - begin));
        if (all.said.size() == count) break;
        all.killed.push_back(all.said.size());
        all.said.emplace_back();
    }
    return all;
}

}  // namespace vagus::aesl
