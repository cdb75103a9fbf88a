#include "cli/plan/save_watcher.hpp"

#include <utility>

#include "net/end_signal.hpp"

namespace vagus::cli {

SaveWatcher::SaveWatcher(FileWatch watch, OnSave on_save)
    : watch_(std::move(watch)), on_save_(std::move(on_save)), thread_([this] { look(); }) {}

SaveWatcher::~SaveWatcher() {
    over_ = true;
    clock_.wake();
    if (thread_.joinable()) thread_.join();
}

void SaveWatcher::look() {
    while (!over_ && !net::end_asked()) {
        const std::vector<std::string> changed = watch_.changed(clock_.now());
        if (!changed.empty() && !on_save_(changed, watch_)) {
            saved_ = changed.front();
            return;
        }
        (void)clock_.poll(clock_.now() + kLookEvery);
    }
}

std::optional<std::string> SaveWatcher::wait() {
    thread_.join();
    return saved_.empty() ? std::nullopt : std::optional(saved_);
}

}  // namespace vagus::cli
