// The simulator: beside its peer, with 500 scripted robots, and how many of them keep up with time.
// The robots are at rest half a metre apart in a walled square; each drives, turns away from what
// its sensors see, and bends its way by a timer.
//
//     build/release/bin/bench_sim
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <thread>
#include <vector>

#include "aesl/compile.hpp"
#include "base/rng.hpp"
#include "session/sim_session.hpp"
#include "sim/world.hpp"
#include "sim_peer.hpp"
#include "wire/messages.hpp"

namespace {

using namespace vagus;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr double kSpacing = 0.5;  // m
constexpr int kRounds = 50;
// Simulated: all sensors have their turn in it. So short that some rounds are disturbed by nobody.
constexpr Duration kRound = 100ms;

constexpr std::string_view kScript = R"(const NEAR = 1800
const CRUISE = 300
var side = 1
var echo
var ignored[2]
var curve = 0
timer.period[0] = 3000
onevent prox
    call math.stat(prox.horizontal[0:4], ignored[0], echo, ignored[1])
    if echo > NEAR then
        if prox.horizontal[0] + prox.horizontal[1] > prox.horizontal[3] + prox.horizontal[4] then
            side = -1
        else
            side = 1
        end
        motor.left.target = -CRUISE * side / 2
        motor.right.target = CRUISE * side / 2
    else
        motor.left.target = CRUISE - curve
        motor.right.target = CRUISE + curve
    end
    call leds.circle(echo / 141, echo / 141, 0, 0, 0, 0, 0, echo / 141)
onevent timer0
    call math.rand(ignored)
    curve = ignored[0] % 60
)";

sim::WorldDefinition field(size_t count) {
    const auto side = static_cast<size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    sim::WorldDefinition world;
    world.width = world.height = kSpacing * static_cast<double>(side);
    SplitMix64 random(7);
    for (size_t i = 0; i < count; ++i) {
        world.robots.push_back({.name = "r" + std::to_string(i),
                                .at = {kSpacing * (static_cast<double>(i % side) + 0.5),
                                       kSpacing * (static_cast<double>(i / side) + 0.5)},
                                .angle = random.unit() * 6.28,
                                .node = static_cast<uint16_t>(i + 1)});
    }
    return world;
}

// For a Thymio, as it describes itself to any host.
std::vector<uint16_t> program() {
    session::SimSession session(std::move(sim::World::create(field(1)).value()), {});
    while (session.target(1) == nullptr) session.step(1ms);
    return aesl::compile(kScript, *session.target(1), {}, {}).program.bytecode;
}

class Host {
public:
    explicit Host(hub::Hub& bus) : bus_(bus), link_(bus.add({.name = "host"}).value()) {}
    void load(uint16_t node, const std::vector<uint16_t>& words) {
        wire::SetBytecode load{};
        load.dest = node;
        load.words.count = static_cast<uint16_t>(words.size());
        for (size_t i = 0; i < words.size(); ++i)
            load.words.values[i] = static_cast<int16_t>(words[i]);
        send(load);
        wire::Run run{};
        run.dest = node;
        send(run);
    }

private:
    template <typename Message>
    void send(const Message& message) {
        wire::Frame frame;
        if (wire::encode_message(message, wire::kHostId, frame) == wire::Error::None)
            bus_.receive(link_, frame);
    }
    hub::Hub& bus_;
    hub::LinkId link_;
};

struct Cost {
    double processor = 0;  // s of all threads together, and …
    double real = 0;       // … s on the clock, for one simulated second
};

double processor_seconds() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec) * 1e-9;
}

// A world of so many robots, all at work.
class Crowd {
public:
    Crowd(size_t count, unsigned threads)
        : world_(std::move(sim::World::create(field(count), {.threads = threads}).value())),
          count_(count) {
        Host host(world_.bus());
        const std::vector<uint16_t> words = program();
        for (size_t i = 0; i < count; ++i) host.load(static_cast<uint16_t>(i + 1), words);
        world_.step(2s);
    }

    // Other programs on the machine only add: the best round counts.
    void run_a_round() {
        const double busy = processor_seconds();
        const Clock::time_point start = Clock::now();
        world_.step(kRound);
        const std::chrono::duration<double> took = Clock::now() - start;
        best_.processor = std::min(best_.processor, (processor_seconds() - busy) / kShare);
        best_.real = std::min(best_.real, took.count() / kShare);
    }

    double real() const { return best_.real; }
    void print(double alone) const {
        std::printf("%15zu %9u %32.2f %13.1f %12.2f\n", count_, world_.threads(),
                    best_.processor * 60e3 / static_cast<double>(count_), 1 / best_.real,
                    alone / best_.real);
        std::fflush(stdout);
    }

private:
    static constexpr double kShare = std::chrono::duration<double>(kRound).count();

    sim::World world_;
    size_t count_;
    Cost best_{1e9, 1e9};
};

// Both worlds do the same, round by round, and take turns.
void print_crowds() {
    const unsigned most = std::max(2u, std::thread::hardware_concurrency());
    std::puts(
        "\nscripted robots   threads   ms of processor a robot-minute   x real time   x one "
        "thread");
    for (const size_t count : {500u, 1250u, 2500u, 5000u, 10000u}) {
        Crowd alone(count, 1);
        Crowd together(count, most);
        for (int round = 0; round < kRounds; ++round) {
            alone.run_a_round();
            together.run_a_round();
        }
        alone.print(alone.real());
        together.print(alone.real());
    }
}

}  // namespace

int main() {
    compare_with_peer();
    print_crowds();
    return 0;
}
