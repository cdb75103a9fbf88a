#include "serve/workbench/server_loop.hpp"

#include <algorithm>

#include "serve/thrown.hpp"

namespace vagus::serve {

namespace {

constexpr Duration kLastWords = 1500ms;  // for the nodes to say that they have stopped

}  // namespace

Status ServerLoop::open(const DoorOptions& options, const std::filesystem::path& data,
                        const std::function<void(const std::string&)>& log,
                        const WorkbenchPlaces& places) {
    faults_.emplace(log);
    TRY(links_.watch_signals());
    door_.emplace(TRY(Door::open(options, data, [this] { links_.wake(); })));
    desk_ = std::make_unique<Desk>(door_->access(), door_->outside(log));
    bench_ = std::make_unique<Workbench>(links_, *desk_, places);
    return Status::done();
}

void ServerLoop::run(const Beside& beside) {
    while (!signal_) {
        const Time now = links_.now();
        const Time due =
            std::min({bench_->next_tick(now), desk_->next_tick(now), beside.next_tick(now)});
        const std::vector<net::Event> events = links_.poll(due);
        const Time woken = links_.now();
        for (const net::Event& event : events) hear(event);
        turn(beside);
        // The last to come waited for all of this.
        late_worst_ = std::max({late_worst_, links_.now() - woken, woken - due});
    }
    beside.before_end();
    end();
}

void ServerLoop::hear(const net::Event& event) {
    if (event.kind == net::EventKind::Signal) {
        signal_ = event.what;
    } else {
        guarded([&] { bench_->hear(event); });
    }
}

// A fault of ours in one part is told and passed over: the others, Stop among them, go on.
void ServerLoop::guarded(const std::function<void()>& part) {
    const auto thrown = thrown_by(part);
    if (thrown) faults_->add("a fault of Vagus, please report it: " + *thrown, links_.now());
}

void ServerLoop::turn(const Beside& beside) {
    const Time now = links_.now();
    guarded([&] { desk_->hear(door_->web().take(), now); });
    guarded([&] { bench_->tick(now); });
    guarded([&] { beside.tick(now); });
    guarded([&] { desk_->tick(now); });
    faults_->tick(now);
}

// Robots must not go on without anybody, and no text may be lost.
void ServerLoop::end() {
    bench_->end_by(*signal_, life::Why::Signal);
    const Time until = links_.now() + kLastWords;
    while (bench_->is_stopping() || links_.has_unwritten()) {
        const Time now = links_.now();
        if (now >= until) break;
        for (const net::Event& event : links_.poll(std::min(until, bench_->next_tick(now)))) {
            guarded([&] { bench_->hear(event); });
        }
        guarded([&] { bench_->tick(links_.now()); });
    }
    bench_->close();
    desk_->tick(links_.now());
    complete_recordings();
}

// By the processes of runs, which have nothing to do with the robot any more. What has not ended
// by then is killed with this server.
void ServerLoop::complete_recordings() {
    const Time until = links_.now() + kClosedEndsWithin;
    while (bench_->runs_are_ending() && links_.now() < until) {
        (void)links_.poll(std::min(until, bench_->next_tick(links_.now())));
        guarded([&] { bench_->tick(links_.now()); });
    }
}

}  // namespace vagus::serve
