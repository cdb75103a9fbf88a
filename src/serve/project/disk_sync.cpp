#include "serve/project/disk_sync.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/file.hpp"

namespace vagus::serve {

DiskSync::~DiskSync() {
    thread_.request_stop();  // before the members that it uses are gone
    if (thread_.joinable()) thread_.join();
}

uint64_t DiskSync::post(const std::string& file, const std::vector<std::string>& obsolete) {
    {
        const std::lock_guard lock(mutex_);
        const auto same = std::find_if(due_.begin(), due_.end(),
                                       [&](const Due& one) { return one.file == file; });
        if (same != due_.end()) {
            same->obsolete.insert(same->obsolete.end(), obsolete.begin(), obsolete.end());
            return same->number;
        }
        due_.push_back({++last_, file, obsolete});
    }
    if (!thread_.joinable()) {
        thread_ = std::jthread([this](const std::stop_token& stop) { work(stop); });
    }
    posted_.notify_one();
    return last_;
}

DiskSync::News DiskSync::take() {
    const std::lock_guard lock(mutex_);
    return {news_.done, std::exchange(news_.failures, {})};
}

void DiskSync::work(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (posted_.wait(lock, stop, [this] { return !due_.empty(); }) && !stop.stop_requested()) {
        const Due next = std::move(due_.front());
        due_.pop_front();
        lock.unlock();
        const Status synced = sync_file(next.file);
        for (const std::string& obsolete : next.obsolete) {
            std::error_code ignored;
            if (synced.ok()) std::filesystem::remove(obsolete, ignored);
        }
        lock.lock();
        news_.done = next.number;
        if (!synced.ok() && news_.failures.size() < kDiskFailuresKept) {
            news_.failures.push_back({next.number, synced.error().what});
        }
        lock.unlock();
        tell_();
        lock.lock();
    }
}

}  // namespace vagus::serve
