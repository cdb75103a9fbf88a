// Threads that do jobs, as many as there are jobs at once, kept for the next ones. A job may block:
// no other waits for it.
//
//     Workers workers;
//     const Workers::Job job = workers.start([] { look(); });
//     workers.leave(job);                                     // it takes too long
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace vagus::run {

class Workers {
    struct Shared;
    struct Worker;

public:
    // A job that was started.
    struct Job {
        std::shared_ptr<Worker> worker;
        uint64_t number = 0;
    };

    Workers();
    // Waits for the jobs that still run, but for those that were left.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    // Starts the job on a thread that is free, or a new one. Called from one thread only.
    Job start(std::function<void()> job);
    // Nobody waits for the job any more, at the end of the program neither: what it uses, it must
    // own. Its thread ends with it. Without effect on a job that is over.
    void leave(const Job& job);

private:
    static void loop(const std::shared_ptr<Shared>& shared, const std::shared_ptr<Worker>& worker);

    std::shared_ptr<Shared> shared_;            // owners: this, and each thread
    std::vector<std::shared_ptr<Worker>> all_;  // but those that were left; owners: as above
};

}  // namespace vagus::run
