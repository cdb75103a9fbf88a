// What `vagus studio` and `vagus serve` have in common: the links, the door, the desk and the
// workbench, the loop until a signal comes, and an end after which nothing moves.
//
//     ServerLoop server;
//     TRY(server.open(options.door, data, log, places));
//     TRY(server.bench().open("examples/follow-wall", server.links().now()));
//     server.run({.next_tick = …, .tick = …});
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "net/links.hpp"
#include "serve/studio/calm_log.hpp"
#include "serve/workbench/door.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

class ServerLoop {
public:
    // What else takes part: all of it on this thread.
    struct Beside {
        std::function<Time(Time now)> next_tick = [](Time) { return Time::max(); };
        // After the pages were heard and the workbench had its turn, before pages are told.
        std::function<void(Time now)> tick = [](Time) {};
        std::function<void()> before_end = [] {};
    };

    // Listens for pages, and for signals.
    Status open(const DoorOptions& options, const std::filesystem::path& data,
                const std::function<void(const std::string&)>& log, const WorkbenchPlaces& places);
    net::Links& links() { return links_; }
    Door& door() { return *door_; }
    Desk& desk() { return *desk_; }
    Workbench& bench() { return *bench_; }
    const Workbench& bench() const { return *bench_; }

    // Until SIGINT, SIGTERM or SIGHUP. Then all nodes stop, and what was typed is kept.
    void run(const Beside& beside);
    // The longest time since it was asked last that somebody had to wait for the loop.
    Duration take_late_worst() { return std::exchange(late_worst_, {}); }

private:
    void hear(const net::Event& event);
    void turn(const Beside& beside);
    void guarded(const std::function<void()>& part);
    void end();
    void complete_recordings();

    net::Links links_;
    std::optional<Door> door_;
    std::unique_ptr<Desk> desk_;
    std::unique_ptr<Workbench> bench_;
    std::optional<CalmLog> faults_;      // a part that fails each time must not fill the log
    std::optional<std::string> signal_;  // that ends it
    Duration late_worst_{};
};

}  // namespace vagus::serve
