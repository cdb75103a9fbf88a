// Waits for the disk on a thread of its own, so that writers need not: a disk can take
// seconds. Files are handed over by name, and waited for in the order in which they came.
//
//     DiskSync sync;
//     sync.post("journal/1f.8", {"journal/1f.7"});  // .7 goes when .8 is on the disk
//     const uint64_t number = sync.post("a.aesl");
//     const DiskSync::News news = sync.take();       // now and then, or when on_news() says so
//     if (news.done >= number) say("a.aesl is on the disk");
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

namespace vagus::serve {

constexpr size_t kDiskFailuresKept = 100;  // until somebody takes them

class DiskSync {
public:
    struct Failure {
        uint64_t number = 0;  // of post()
        std::string why;
    };
    struct News {
        uint64_t done = 0;  // all files up to this number were waited for
        std::vector<Failure> failures = {};
    };

    DiskSync() = default;
    // What was not begun is left to the system.
    ~DiskSync();
    DiskSync(const DiskSync&) = delete;
    DiskSync& operator=(const DiskSync&) = delete;

    // Called on the other thread when take() has something. Before the first post().
    void on_news(std::function<void()> tell) { tell_ = std::move(tell); }

    // Its number, from 1 on. A file that is posted again before its turn waits once.
    uint64_t post(const std::string& file, const std::vector<std::string>& obsolete = {});
    // Of what was posted last.
    uint64_t last() const { return last_; }
    News take();

private:
    struct Due {
        uint64_t number = 0;
        std::string file;
        std::vector<std::string> obsolete;
    };
    void work(const std::stop_token& stop);

    std::function<void()> tell_ = [] {};
    uint64_t last_ = 0;
    std::mutex mutex_;  // guards what follows
    std::condition_variable_any posted_;
    std::deque<Due> due_;
    News news_;
    std::jthread thread_;  // begins with the first file
};

}  // namespace vagus::serve
