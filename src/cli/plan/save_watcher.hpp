// Looks, on a thread of its own, whether files are saved, while a run goes on elsewhere.
//
//     SaveWatcher saves(FileWatch(files), [&run](const auto& saved, FileWatch& watch) {
//         return run.takes(saved, watch);            // false: the watching is over
//     });
//     run.run();
//     const auto saved = saves.wait();               // the file, at once if it ended the watching
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cli/file_watch.hpp"
#include "net/links.hpp"

namespace vagus::cli {

class SaveWatcher {
public:
    // Called on the thread of the watcher; false: the watching is over.
    using OnSave = std::function<bool(const std::vector<std::string>& saved, FileWatch& watch)>;
    SaveWatcher(FileWatch watch, OnSave on_save);
    ~SaveWatcher();
    SaveWatcher(const SaveWatcher&) = delete;
    SaveWatcher& operator=(const SaveWatcher&) = delete;

    // Until a save has ended the watching, or a signal asks the process to end: then nothing.
    std::optional<std::string> wait();

private:
    void look();

    FileWatch watch_;
    OnSave on_save_;
    net::Links clock_;
    std::atomic<bool> over_ = false;
    std::string saved_;  // read when the thread has been joined
    std::thread thread_;
};

}  // namespace vagus::cli
