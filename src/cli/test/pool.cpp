#include "cli/test/pool.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <optional>
#include <vector>

#include "base/process_copy.hpp"
#include "net/end_signal.hpp"

namespace vagus::cli {

namespace {

using Clock = std::chrono::steady_clock;

struct Running {
    size_t job = 0;
    pid_t process = 0;
    int pipe = -1;
    std::string text;
    Clock::time_point begun;
};

// Never returns: the child.
[[noreturn]] void work(int to, const std::function<std::string(size_t)>& job, size_t index) {
    const std::string text = job(index);
    for (size_t sent = 0; sent < text.size();) {
        const ssize_t now = write(to, text.data() + sent, text.size() - sent);
        if (now < 0 && errno == EINTR) continue;
        if (now < 0) _exit(1);
        sent += static_cast<size_t>(now);
    }
    _exit(0);
}

std::string trouble_of(int status) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    if (WIFSIGNALED(status)) {
        return fmt::format("its process crashed ({})", strsignal(WTERMSIG(status)));
    }
    return fmt::format("its process ended with exit status {}", WEXITSTATUS(status));
}

// Waits for it.
int end_of(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

class Pool {
public:
    explicit Pool(const std::function<std::string(size_t)>& job) : job_(job) {}
    ~Pool() {
        for (const Running& one : running_) {
            (void)kill(one.process, SIGKILL);
            (void)close(one.pipe);
            (void)waitpid(one.process, nullptr, 0);
        }
    }
    Pool(const Pool&) = delete;
    Pool& operator=(const Pool&) = delete;

    size_t size() const { return running_.size(); }

    // The sentence of what the system refuses; empty: it runs.
    std::string start(size_t job) {
        int ends[2];
        if (pipe(ends) != 0) return fmt::format("no pipe for its process: {}", strerror(errno));
        const auto child = static_cast<pid_t>(copy_of_process());
        if (child == 0) {
            (void)close(ends[0]);
            work(ends[1], job_, job);
        }
        (void)close(ends[1]);
        if (child < 0) {
            (void)close(ends[0]);
            return fmt::format("no process for it: {}", strerror(errno));
        }
        running_.push_back({job, child, ends[0], {}, Clock::now()});
        return {};
    }

    // Waits for something to read; gives those that are over. Nothing: this process is to end.
    std::optional<std::vector<std::pair<size_t, JobResult>>> wait() {
        std::vector<pollfd> polls;
        for (const Running& one : running_) polls.push_back({one.pipe, POLLIN, 0});
        polls.push_back({net::end_descriptor(), POLLIN, 0});
        (void)poll(polls.data(), polls.size(), -1);
        if (polls.back().revents != 0) return std::nullopt;
        std::vector<std::pair<size_t, JobResult>> over;
        for (size_t i = running_.size(); i-- > 0;) {
            if (polls[i].revents == 0 || !read_some(running_[i])) continue;
            over.emplace_back(running_[i].job, end(running_[i]));
            running_.erase(running_.begin() + static_cast<std::ptrdiff_t>(i));
        }
        return over;
    }

private:
    // True at the end.
    static bool read_some(Running& one) {
        char bytes[65536];
        const ssize_t got = read(one.pipe, bytes, sizeof bytes);
        if (got > 0) one.text.append(bytes, static_cast<size_t>(got));
        return got == 0 || (got < 0 && errno != EINTR);
    }

    static JobResult end(Running& one) {
        (void)close(one.pipe);
        const int status = end_of(one.process);
        const std::chrono::duration<double> took = Clock::now() - one.begun;
        return {std::move(one.text), trouble_of(status), took.count()};
    }

    const std::function<std::string(size_t)>& job_;
    std::vector<Running> running_;
};

}  // namespace

bool continue_in_copy(std::string& trouble) {
    const auto child = static_cast<pid_t>(copy_of_process());
    if (child == 0) return true;
    if (child < 0) {
        trouble = fmt::format("no process for it: {}", strerror(errno));
        return false;
    }
    trouble = trouble_of(end_of(child));
    return false;
}

bool run_jobs(size_t count, int at_once, const std::function<std::string(size_t)>& job,
              const std::function<bool(size_t, JobResult)>& done) {
    Pool pool(job);
    for (size_t next = 0; next < count || pool.size() > 0;) {
        while (next < count && pool.size() < static_cast<size_t>(at_once)) {
            const std::string refused = pool.start(next);
            if (!refused.empty() && !done(next, {.trouble = refused})) return true;
            ++next;
        }
        if (pool.size() == 0) continue;
        auto over = pool.wait();
        if (!over) return false;
        for (auto& [index, result] : *over) {
            if (!done(index, std::move(result))) return true;
        }
    }
    return true;
}

}  // namespace vagus::cli
