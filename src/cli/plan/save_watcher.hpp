// Looks, on a thread of its own, whether files are saved, while a run goes on elsewhere.
//
//     SaveWatcher saves(FileWatch(files), [&run] { run.abort(); });
//     run.run();
//     const auto saved = saves.wait();               // the file, at once if it ended the run
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "cli/file_watch.hpp"
#include "net/network.hpp"

namespace vagus::cli {

class SaveWatcher {
public:
    // `on_save` is called once, on the thread of the watcher.
    SaveWatcher(FileWatch watch, std::function<void()> on_save);
    ~SaveWatcher();
    SaveWatcher(const SaveWatcher&) = delete;
    SaveWatcher& operator=(const SaveWatcher&) = delete;

    // Until a file was saved, or a signal asks the process to end: then nothing.
    std::optional<std::string> wait();

private:
    void look();

    FileWatch watch_;
    std::function<void()> on_save_;
    net::Network clock_;
    std::atomic<bool> over_ = false;
    std::string saved_;  // read when the thread has been joined
    std::thread thread_;
};

}  // namespace vagus::cli
