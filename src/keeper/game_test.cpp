// Keepers and robots with a broker between them whose links are late, double what they carry, and
// break; keepers are killed, hang and are started again. Never do two robots hold a lease of one
// thing, and in the end each task is finished.
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <memory>

#include "base/rng.hpp"
#include "keeper/keeper.hpp"
#include "keeper/leases.hpp"

namespace vagus::keeper {
namespace {

constexpr int kRobots = 5;
constexpr int kTasks = 20;
constexpr Duration kStep = 50ms;
constexpr Duration kTrouble = 120s;  // then all is well, and must come to an end
constexpr Duration kEnd = 400s;

struct Process {
    std::unique_ptr<Keeper> keeper;
    uint64_t life = 0;
    Time hangs_until{};
    bool connected = false;
    std::deque<Input> inbox;  // while it hangs
};

struct Robot {
    std::string name;
    Leases leases;
    uint64_t question = 0;
    bool claims = false;
    std::optional<Task> task;
    std::optional<Claim> claim;
    Time work_until{};
};

class Game {
public:
    explicit Game(uint64_t seed) : rng_(seed) {
        for (int i = 0; i < kRobots; ++i) robots_[i].name = "r" + std::to_string(i);
        boss_.name = "boss";
    }

    void play() {
        for (; now_ < kEnd && !testing::Test::HasFailure(); now_ += kStep) {
            deliver();
            if (now_ < kTrouble) trouble();
            for (Process& process : processes_) live(process);
            for (Robot& robot : robots_) live(robot);
            give();
            look();
            if (finished_.size() == kTasks && now_ > kTrouble) break;
        }
        EXPECT_EQ(finished_.size(), size_t{kTasks});
    }

private:
    bool chance(int one_in) { return rng_.below(static_cast<uint64_t>(one_in)) == 0; }

    void later(std::function<void()> what, Duration least = 0ms) {
        const bool is_slow = now_ < kTrouble && chance(20);
        const auto late = static_cast<int64_t>(rng_.below(is_slow ? 8'000'000 : 60'000));
        mail_.insert({now_ + least + Duration(late), std::move(what)});
    }

    void deliver() {
        while (!mail_.empty() && mail_.begin()->first <= now_) {
            const auto what = std::move(mail_.begin()->second);
            mail_.erase(mail_.begin());
            what();
        }
    }

    void trouble() {
        Process& process = processes_[rng_.below(2)];
        if (chance(400)) process = {};
        if (chance(400)) process.hangs_until = now_ + Duration(rng_.below(20'000'000));
        if (chance(600)) cut(process);
    }

    void cut(Process& process) {
        if (!process.keeper || !process.connected) return;
        process.connected = false;
        tell(process, Lost{});
    }

    void tell(Process& process, const Input& input) {
        if (!process.keeper) return;
        process.inbox.push_back(input);
    }

    void live(Process& process) {
        if (!process.keeper && chance(40)) {
            process.life = ++lives_;
            process.keeper =
                std::make_unique<Keeper>(Options{"k" + std::to_string(process.life), 10s, 1});
        }
        if (!process.keeper || now_ < process.hangs_until) return;
        if (!process.connected && chance(20)) {
            process.connected = true;
            tell(process, Connected{});
            tell(process, LastBeat{last_epoch_});
            for (const auto& [topic, record] : retained_) tell(process, Retained{record});
        }
        while (!process.inbox.empty()) {
            const Input input = process.inbox.front();
            process.inbox.pop_front();
            perform(process, process.keeper->take(input, now_));
        }
        perform(process, process.keeper->tick(now_));
        if (process.keeper->state() == Keeper::State::Out) process = {};
    }

    // What it sends is with the broker at once or lost; the broker's messages are late.
    void perform(Process& process, const Actions& actions) {
        for (const Action& action : actions) {
            if (!process.connected) continue;
            if (const auto* beat = std::get_if<Beat>(&action)) {
                last_epoch_ = std::max(last_epoch_, beat->epoch);
                for (Process& other : processes_)
                    if (other.connected) tell(other, *beat);
                for (Robot& robot : robots_) robot.leases.heard_of(beat->epoch, now_);
            } else if (const auto* publish = std::get_if<Publish>(&action)) {
                retain(process, *publish);
            } else if (const auto* answer = std::get_if<Answer>(&action)) {
                const Answer sent = *answer;
                for (int copies = chance(5) ? 2 : 1; copies > 0; --copies)
                    later([this, sent] { hear(sent); });
            }
        }
    }

    void retain(Process& process, const Publish& publish) {
        std::string topic = "shared/";
        if (const auto* task = std::get_if<Task>(&publish.record)) {
            topic = "task/" + task->id;
            if (task->work == Work::Done) finished_.insert(task->id);
        } else if (const auto* claim = std::get_if<Claim>(&publish.record)) {
            topic += claim->name;
        }
        if (publish.gone)
            retained_.erase(topic);
        else
            retained_[topic] = publish.record;
        for (Process& other : processes_)
            if (&other != &process && other.connected && !publish.gone)
                tell(other, Retained{publish.record});
        tell(process, Acknowledged{publish.publication});
    }

    void send(const std::string& robot, const Ask& ask) {
        for (int copies = chance(5) ? 2 : 1; copies > 0; --copies)
            later([this, robot, ask] {
                for (Process& process : processes_)
                    if (process.connected)
                        tell(process, Asked{{robot, 1, ask.number}, ask.request});
            });
    }

    Robot& robot_of(const std::string& name) {
        for (Robot& robot : robots_)
            if (robot.name == name) return robot;
        return boss_;
    }

    void hear(const Answer& answer) {
        robot_of(answer.asker.robot).leases.hear(answer.asker.number, answer.reply, now_);
    }

    void live(Robot& robot) {
        for (const Over& over : robot.leases.take_over()) {
            if (over.number != robot.question) continue;
            robot.question = 0;
            if (!over.reply || over.reply->outcome != Outcome::Done) continue;
            if (const auto* task = std::get_if<Task>(&*over.reply->record))
                if (task->work == Work::Leased) robot.task = *task;
            if (const auto* claim = std::get_if<Claim>(&*over.reply->record))
                if (!claim->lease.robot.empty()) robot.claim = *claim;
            robot.work_until = now_ + Duration(rng_.below(8'000'000));
        }
        for (const Term& term : robot.leases.take_ended(now_)) {
            if (robot.task && robot.task->lease.term == term) robot.task.reset();
            if (robot.claim && robot.claim->lease.term == term) robot.claim.reset();
        }
        if (robot.question == 0 && now_ >= robot.work_until) work(robot);
        for (const Ask& ask : robot.leases.tick(now_)) send(robot.name, ask);
    }

    void work(Robot& robot) {
        if (robot.task) {
            robot.question = robot.leases.ask(Finish{robot.task->lease.term, "1"}, now_);
            robot.task.reset();
        } else if (robot.claim) {
            robot.question = robot.leases.ask(Release{robot.claim->lease.term}, now_);
            robot.claim.reset();
        } else if (chance(10)) {
            robot.claims = !robot.claims;
            robot.question = robot.claims ? robot.leases.ask(ClaimName{"aisle", 4s}, now_)
                                          : robot.leases.ask(Take{"pick", 4s}, now_);
        }
    }

    void give() {
        if (boss_.question == 0 && given_ < kTasks)
            boss_.question = boss_.leases.ask(Give{"pick", "t" + std::to_string(given_), ""}, now_);
        for (const Ask& ask : boss_.leases.tick(now_)) send(boss_.name, ask);
        for (const Over& over : boss_.leases.take_over()) {
            boss_.question = 0;
            if (over.reply && over.reply->outcome == Outcome::Done) ++given_;
        }
    }

    // Nobody works on what another works on.
    void look() {
        std::map<std::string, std::string> who;
        for (const Robot& robot : robots_) {
            const auto has = [&](const std::string& what, Term term) {
                if (!robot.leases.holds(term, now_)) return;
                const auto [other, is_new] = who.insert({what, robot.name});
                EXPECT_TRUE(is_new) << other->second << " and " << robot.name << " have " << what
                                    << " at " << seconds_of(now_) << " s";
            };
            if (robot.task) has(robot.task->id, robot.task->lease.term);
            if (robot.claim) has(robot.claim->name, robot.claim->lease.term);
        }
    }

    SplitMix64 rng_;
    Time now_{};
    std::multimap<Time, std::function<void()>> mail_;
    std::map<std::string, Record> retained_;
    Process processes_[2];
    uint64_t lives_ = 0, last_epoch_ = 0;
    Robot robots_[kRobots];
    Robot boss_;
    int given_ = 0;
    std::set<std::string> finished_;
};

TEST(Game, NoTwoRobotsEverHaveOneThingAndEachTaskIsFinished) {
    const int games = std::getenv("VAGUS_LONG") ? 5'000 : 100;
    for (int seed = 1; seed <= games && !HasFailure(); ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Game(static_cast<uint64_t>(seed)).play();
    }
}

}  // namespace
}  // namespace vagus::keeper
