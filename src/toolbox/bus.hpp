// Which nodes are on the bus of a run, by name: told by whoever has the bus, asked by templates
// whose work is done on nodes. From any thread.
//
//     BusNodes nodes;
//     nodes.appeared("drive");
//     nodes.has("drive")                                   // true
//     nodes.left("drive");                                 // and code that waits is woken:
//     run.hear({node_left("drive"), {}});                  // context.wait_event("") gives it
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace vagus::toolbox {

// The name of what a run hears when the last node of that name has left. No event of a bus is
// called so: names of events have neither `@` nor spaces.
inline std::string node_left(std::string_view node) {
    return "@left " + std::string(node);
}

class BusNodes {
public:
    // Once for each node; several can have one name.
    void appeared(const std::string& name) {
        const std::lock_guard lock(mutex_);
        ++count_[name];
    }
    // True if it was the last of that name.
    bool left(const std::string& name) {
        const std::lock_guard lock(mutex_);
        const auto found = count_.find(name);
        if (found == count_.end()) return false;
        if (--found->second > 0) return false;
        count_.erase(found);
        return true;
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
    mutable std::mutex mutex_;  // guards the map
    std::map<std::string, int, std::less<>> count_;
};

}  // namespace vagus::toolbox
