// Which nodes are on the bus of a run, and whose programs were stopped, by name: told by what
// has the bus, asked by templates whose work is done on nodes. From any thread.
//
//     BusNodes nodes;
//     nodes.appeared("drive");
//     nodes.has("drive");                                  // true
//     nodes.left("drive");                                 // and code that waits is woken:
//     run.hear({node_left("drive"), {}});                  // context.wait_event("") gives it
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>

namespace vagus::toolbox {

// The name of what a run hears when the last node of that name has left. No event of a bus is
// called so: names of events have neither `@` nor spaces.
inline std::string node_left(std::string_view node) {
    return "@left " + std::string(node);
}

// The same of a node whose program was stopped, and of one that runs again.
inline std::string node_stopped(std::string_view node) {
    return "@stopped " + std::string(node);
}
inline std::string node_runs(std::string_view node) {
    return "@runs " + std::string(node);
}

class BusNodes {
public:
    enum class Change : uint8_t { Appeared, Left, Stopped, Runs };
    using Listener = std::function<void(const std::string& node, Change change)>;
    // Is told at once how it is, and then of each change, on the thread that makes it; it must not
    // call these nodes. Empty: nobody is.
    void listen(Listener listener) {
        const std::lock_guard lock(mutex_);
        listener_ = std::move(listener);
        for (const auto& [name, count] : count_) {
            for (int i = 0; i < count; ++i) tell(name, Change::Appeared);
        }
        for (const std::string& name : stopped_) tell(name, Change::Stopped);
    }

    // Once for each node; several can have one name.
    void appeared(const std::string& name) {
        const std::lock_guard lock(mutex_);
        ++count_[name];
        tell(name, Change::Appeared);
    }
    // True if it was the last of that name.
    bool left(const std::string& name) {
        const std::lock_guard lock(mutex_);
        const auto found = count_.find(name);
        if (found == count_.end()) return false;
        tell(name, Change::Left);
        if (--found->second > 0) return false;
        count_.erase(found);
        return true;
    }
    // Its program was stopped, or runs again. Code that begins to work with it later asks
    // is_stopped(): what was told before is not told again.
    void stopped(const std::string& name) {
        const std::lock_guard lock(mutex_);
        if (stopped_.insert(name).second) tell(name, Change::Stopped);
    }
    void runs(const std::string& name) {
        const std::lock_guard lock(mutex_);
        if (stopped_.erase(name) > 0) tell(name, Change::Runs);
    }
    bool is_stopped(std::string_view name) const {
        const std::lock_guard lock(mutex_);
        return stopped_.find(name) != stopped_.end();
    }
    bool has(std::string_view name) const {
        const std::lock_guard lock(mutex_);
        return count_.find(name) != count_.end();
    }
    // Sentences of errors say: "on the bus are drive, bumper". Empty: nothing is.
    std::string list() const {
        const std::lock_guard lock(mutex_);
        std::string names;
        for (const auto& [name, count] : count_) names += (names.empty() ? "" : ", ") + name;
        return names;
    }

private:
    void tell(const std::string& name, Change change) const {
        if (listener_) listener_(name, change);
    }

    mutable std::mutex mutex_;  // guards what follows
    Listener listener_;
    std::map<std::string, int, std::less<>> count_;
    std::set<std::string, std::less<>> stopped_;
};

}  // namespace vagus::toolbox
