// Robots of a fleet that give, take, drop and finish tasks of a keeper, all in one process with one
// clock, so that it can be judged whether two of them ever had one task at once. Some work for
// longer than their lease without renewing it, as a robot that was cut off.
//
//     fleet_workers TARGET FOLDER WORKERS TASKS SEED
//
// FOLDER is that of `vagus fleet init`, with logins boss and w0 to w(WORKERS-1). Prints "finished
// N" at each hundredth, and at the end what was wrong, or "all N tasks are finished". Exit code 1
// if something was wrong.
#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "base/rng.hpp"
#include "fleet/keeper_client.hpp"
#include "serve/broker/bell.hpp"
#include "serve/broker/fleet_options.hpp"

using namespace vagus;
using namespace std::chrono_literals;

namespace {

constexpr Duration kLease = 3s;
constexpr Duration kWork = 80ms;         // at most, of most
constexpr Duration kTakeAgain = 100ms;   // when no task waits
constexpr uint64_t kOneInIsCutOff = 60;  // of those that have a task
constexpr Duration kCutOff = 4s;         // longer than a lease
constexpr int kGivenAtOnce = 32;

Duration now() {
    return std::chrono::duration_cast<Duration>(
        std::chrono::steady_clock::now().time_since_epoch());
}

// A robot's name, its connection, and what it asks.
class Robot {
public:
    Robot(const std::string& target, const std::string& folder, const std::string& robot,
          int64_t epoch, serve::Bell& bell)
        : name(robot), client({.fleet = "lab", .robot = robot, .epoch = epoch}) {
        serve::FleetOptions options{
            .target = target, .ca = folder + "/ca.crt", .login = folder + "/" + robot + ".login"};
        auto link_options = serve::link_options(options, fmt::format("{}-{}", robot, epoch));
        if (!link_options.ok()) {
            fmt::print("{}\n", link_options.error().what);
            std::exit(2);
        }
        link = std::make_unique<serve::MosquittoLink>(std::move(link_options.value()),
                                                      [&bell] { bell.ring(); });
    }

    void hear(const fleet::LinkEvent& event) {
        if (std::get_if<fleet::Connected>(&event)) link->subscribe(client.filters());
        client.hear(event, now());
    }
    void send() {
        client.tick(now());
        for (const fleet::Post& post : client.take()) link->publish(post);
    }

    std::string name;
    fleet::KeeperClient client;
    std::unique_ptr<serve::MosquittoLink> link;
};

struct Worker : Robot {
    using Robot::Robot;
    uint64_t question = 0;
    std::optional<keeper::Task> task;
    Time again{};      // when it takes or finishes
    bool cut = false;  // it does not hear and say anything until then
};

class Play {
public:
    Play(const std::string& target, const std::string& folder, int workers, int tasks,
         uint64_t seed)
        : tasks_(tasks), rng_(seed), boss_(target, folder, "boss", epoch(), bell_) {
        for (int i = 0; i < workers; ++i)
            workers_.push_back(
                std::make_unique<Worker>(target, folder, "w" + std::to_string(i), epoch(), bell_));
    }

    bool run() {
        while (finished_.size() < static_cast<size_t>(tasks_) && wrong_.empty()) {
            turn_of_boss();
            for (const auto& worker : workers_) turn_of(*worker);
            look();
            bell_.wait(20ms);
        }
        fmt::print("{}\n",
                   wrong_.empty() ? fmt::format("all {} tasks are finished", tasks_) : wrong_);
        return wrong_.empty();
    }

private:
    int64_t epoch() { return static_cast<int64_t>(rng_.next() >> 16); }

    // It gives, and sees in the records what is done.
    void turn_of_boss() {
        for (const fleet::LinkEvent& event : boss_.link->take()) {
            boss_.hear(event);
            if (std::get_if<fleet::Connected>(&event))
                boss_.link->subscribe({{fleet::filter_of("lab", fleet::Kind::Task)}});
            const auto* received = std::get_if<fleet::Received>(&event);
            if (received == nullptr) continue;
            const auto* record = std::get_if<keeper::Record>(&received->heard.message);
            if (record != nullptr) see(std::get<keeper::Task>(*record));
        }
        for (const keeper::Over& over : boss_.client.leases().take_over()) {
            const int task = asked_.at(over.number);
            asked_.erase(over.number);
            // Nobody has answered: it may be there, and is given again.
            if (!over.reply || over.reply->outcome != keeper::Outcome::Done) again_.insert(task);
        }
        while (asked_.size() < kGivenAtOnce && (given_ < tasks_ || !again_.empty())) {
            const int task = again_.empty() ? given_++ : *again_.begin();
            again_.erase(task);
            asked_[boss_.client.ask(keeper::Give{"pick", "t" + std::to_string(task), ""}, now())] =
                task;
        }
        boss_.send();
    }

    void see(const keeper::Task& task) {
        const bool done = task.work == keeper::Work::Done;
        if (!done && finished_.contains(task.id)) wrong_ = task.id + " was done, and is not";
        if (!done || !finished_.insert(task.id).second || finished_.size() % 100 != 0) return;
        fmt::print("finished {}\n", finished_.size());
        std::fflush(stdout);
    }

    void turn_of(Worker& worker) {
        if (worker.cut && now() < worker.again) return;
        worker.cut = false;
        for (const fleet::LinkEvent& event : worker.link->take()) worker.hear(event);
        for (const keeper::Over& over : worker.client.leases().take_over()) {
            if (over.number == worker.question) answered(worker, over.reply);
        }
        for (const keeper::Term& term : worker.client.leases().take_ended(now()))
            if (worker.task && worker.task->lease.term == term) worker.task.reset();
        if (worker.question == 0 && now() >= worker.again) work(worker);
        worker.send();
    }

    void answered(Worker& worker, const std::optional<keeper::Reply>& reply) {
        worker.question = 0;
        worker.again = now() + kTakeAgain;
        if (!reply || reply->outcome != keeper::Outcome::Done) return;
        const auto* task = reply->record ? std::get_if<keeper::Task>(&*reply->record) : nullptr;
        if (task == nullptr || task->work != keeper::Work::Leased) return;
        if (!worker.client.leases().holds(task->lease.term, now())) return;  // it came too late
        worker.task = *task;
        worker.cut = rng_.below(kOneInIsCutOff) == 0;
        worker.again = now() + (worker.cut ? kCutOff : Duration(rng_.below(kWork.count())));
    }

    void work(Worker& worker) {
        const auto request = worker.task
                                 ? keeper::Request(keeper::Finish{worker.task->lease.term, "true"})
                                 : keeper::Request(keeper::Take{"pick", kLease});
        worker.task.reset();
        worker.question = worker.client.ask(request, now());
    }

    // By its own lease each may work: never two of them on one task.
    void look() {
        std::map<std::string, const Worker*> who;
        for (const auto& worker : workers_) {
            if (!worker->task) continue;
            if (!worker->client.leases().holds(worker->task->lease.term, now())) continue;
            const auto [other, is_new] = who.insert({worker->task->id, worker.get()});
            if (!is_new)
                wrong_ = fmt::format("{} and {} have {} at once", other->second->name, worker->name,
                                     worker->task->id);
        }
    }

    const int tasks_;
    SplitMix64 rng_;
    serve::Bell bell_;  // before those who ring it
    Robot boss_;
    std::vector<std::unique_ptr<Worker>> workers_;
    int given_ = 0;
    std::map<uint64_t, int> asked_;
    std::set<int> again_;
    std::set<std::string> finished_;
    std::string wrong_;
};

}  // namespace

int main(int count, char** words) {
    if (count != 6) return 2;
    const uint64_t seed = std::strtoull(words[5], nullptr, 10);
    fmt::print("seed {}\n", seed);
    std::fflush(stdout);
    return Play(words[1], words[2], std::atoi(words[3]), std::atoi(words[4]), seed).run() ? 0 : 1;
}
