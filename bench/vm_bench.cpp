// How fast the bytecode machine is on a host: the loop for hosts (fastvm), the small one (vm), and
// Debian's libasebavm, the same programs in turns in one run, by the time of the processor. Prints
// for each program millions of instructions a second, and the median of the ratios of the rounds;
// the aim is twice the peer. Before, all three have come to the same variables and have emitted as
// much.
//
//     build/release/bin/bench_vm
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "aesl/compile.hpp"
#include "aesl/project.hpp"
#include "base/file.hpp"
#include "base/rng.hpp"
#include "base/test_places.hpp"
#include "isa/isa.hpp"
#include "session/known_nodes.hpp"
#include "vm_machines.hpp"

namespace vagus::bench {
namespace {

constexpr int kRounds = 15;
constexpr double kRoundSeconds = 0.03;  // of the small loop
constexpr size_t kSteps = 672;          // events of a program in turn, again and again

struct Work {
    std::string name;
    std::string source;
    aesl::CommonDefinitions common;
    std::vector<std::string> events;  // in turn
};

// What scripts are made of: arithmetic in loops, arrays, subroutines, conditions on sensors.
constexpr const char* kPrimes = R"(
var number var divisor var count
onevent prox
count = 0
number = 2
while number < 120 do
	divisor = 2
	while divisor * divisor <= number and number % divisor != 0 do
		divisor += 1
	end
	if divisor * divisor > number then count++ end
	number += 1
end
)";

constexpr const char* kSort = R"(
var list[24] var seed = 7 var i var k var held
onevent prox
for i in 0:23 do
	seed = seed * 77 + 13
	list[i] = seed
end
for i in 0:22 do
	for k in 0:22 do
		if list[k] > list[k + 1] then
			held = list[k]
			list[k] = list[k + 1]
			list[k + 1] = held
		end
	end
end
)";

constexpr const char* kCollatz = R"(
var start var n var steps var longest
sub halve
	n = n / 2
sub triple
	n = 3 * n + 1
sub walk
	steps = 0
	while n != 1 do
		if n % 2 == 0 then callsub halve else callsub triple end
		steps++
	end
	if steps > longest then longest = steps end
onevent prox
	for start in 1:26 do
		n = start
		callsub walk
	end
)";

constexpr const char* kFollow = R"(
var weights[7] = [-20000, -9000, 0, 9000, 20000, -3000, 3000]
var error var before var sum var turn var i var lost = 0
onevent prox
	error = 0
	for i in 0:6 do
		if prox.horizontal[i] > 1000 then
			error += (prox.horizontal[i] >> 4) * weights[i] / 512
		end
	end
	sum = (sum * 7 + error) / 8
	turn = abs((3 * error + 2 * (error - before) - sum) / 16) & 0x7f
	before = error
	when abs(error) < 20 and prox.ground.delta[0] < 300 do
		lost++
		emit clear
	end
	motor.left.target = 300 + turn - (lost & 3)
	motor.right.target = 300 - turn + (lost & 3)
)";

// Five instructions: what a handler costs that does next to nothing.
constexpr const char* kShort = R"(
var n
onevent prox
	n = prox.ground.delta[0] + 1
)";

constexpr const char* kNatives = R"(
var values[7] var sorted[7] var sum var low var high var mean var turn var i
onevent prox
	call math.copy(values, prox.horizontal)
	for i in 1:4 do
		call math.stat(values, low, high, mean)
		call math.muldiv(turn, mean, i, 7)
		call math.dot(sum, values, prox.horizontal, 3)
		call math.copy(sorted, values)
		call math.sort(sorted)
		call math.max(high, sorted[6], turn)
		call math.argbounds(values, low, high)
	end
)";

Work explore() {
    const std::string path = test::examples("thymio/explore.aesl");
    const Result<std::string> text = read_file(path);
    const Result<aesl::Project> project = aesl::parse_project(text.value(), path);
    return {"explore.aesl",
            project.value().scripts[0].source,
            project.value().common,
            {"prox", "prox", "prox", "timer0", "prox", "prox", "button.center"}};
}

std::vector<Work> works() {
    const aesl::CommonDefinitions common = {.events = {{"clear", uint16_t{0}}}, .constants = {}};
    return {explore(),
            {"primes", kPrimes, common, {"prox"}},
            {"sort", kSort, common, {"prox"}},
            {"collatz", kCollatz, common, {"prox"}},
            {"follow", kFollow, common, {"prox"}},
            {"short", kShort, common, {"prox"}},
            {"natives", kNatives, common, {"prox"}}};
}

// A program on its machines, and what is done to them.
class Bench {
public:
    bool compile(const Work& work);
    // Runs `times` events, each with new values of the sensors; gives seconds of the processor.
    double run(BenchMachine& machine, int times) const;

    const MachineProgram& program() const { return program_; }
    size_t words() const { return program_.bytecode.size(); }

private:
    struct Step;
    std::vector<Step> steps() const;

    MachineProgram program_;
    std::vector<uint16_t> events_;
    size_t sensors_ = 0;  // address of the seven distances
    size_t ground_ = 0;
};

bool Bench::compile(const Work& work) {
    const aesl::Target target = session::known_node("thymio-II");
    const aesl::Compilation compiled = aesl::compile(work.source, target, work.common, {});
    if (!compiled.ok()) {
        fmt::print(stderr, "{} does not compile: {}\n", work.name, compiled.errors[0].message);
        return false;
    }
    program_ = {compiled.program.bytecode,
                {},
                target.bytecode_size,
                target.variables_size,
                target.stack_size};
    for (const aesl::NativeFunction& native : target.natives)
        program_.parameter_counts.push_back(static_cast<uint16_t>(native.parameters.size()));
    for (const std::string& name : work.events) {
        const auto found = std::ranges::find(target.local_events, name, &aesl::LocalEvent::name);
        const auto index = found - target.local_events.begin();
        events_.push_back(static_cast<uint16_t>(isa::kLocalEventFirst - index));
    }
    for (const aesl::VariablePlace& place : compiled.program.variables) {
        if (place.name == "prox.horizontal") sensors_ = place.address;
        if (place.name == "prox.ground.delta") ground_ = place.address;
    }
    return true;
}

// What happens at one event: made before the time is taken, for a division and a random number
// take as long as a handler of five instructions.
struct Bench::Step {
    uint16_t event;
    int16_t ground;
    std::array<int16_t, 7> sensors;
};

std::vector<Bench::Step> Bench::steps() const {
    SplitMix64 random(1);
    std::vector<Step> made(kSteps);
    for (size_t i = 0; i < kSteps; ++i) {
        const uint64_t bits = random.next();
        made[i] = {events_[i % events_.size()], static_cast<int16_t>(bits & 0x3ff), {}};
        for (size_t k = 0; k < 7; ++k)
            made[i].sensors[k] = static_cast<int16_t>(bits >> (k * 9) & 0xfff);
    }
    return made;
}

double Bench::run(BenchMachine& machine, int times) const {
    const std::vector<Step> steps = this->steps();
    int16_t* const variables = machine.variables().data();
    const std::clock_t start = std::clock();
    for (int done = 0; done < times;) {
        for (const Step& step : steps) {
            if (done++ == times) break;
            std::memcpy(variables + sensors_, step.sensors.data(), sizeof step.sensors);
            variables[ground_] = step.ground;
            machine.event(step.event);
        }
    }
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + kRounds / 2);
    return values[kRounds / 2];
}

// How many events make a round, and whether the three do the same: both on fresh machines.
int prepare(const Bench& bench, const std::string& name) {
    const auto fast = make_fast(bench.program());
    const auto small = make_small(bench.program());
    const auto peer = make_peer(bench.program());
    for (BenchMachine* machine : {fast.get(), small.get(), peer.get()}) {
        machine->event(isa::kInitEvent);
        bench.run(*machine, 1000);
    }
    const bool equal = std::ranges::equal(fast->variables(), small->variables()) &&
                       std::ranges::equal(fast->variables(), peer->variables()) &&
                       fast->sent() == small->sent() && fast->sent() == peer->sent() &&
                       fast->instructions() == small->instructions();
    if (!equal) {
        fmt::print(stderr, "{}: the three machines came to different variables\n", name);
        return 0;
    }
    int times = 1000;
    while (bench.run(*small, times) < kRoundSeconds) times *= 2;
    return times;
}

struct Figures {
    double fast, small, peer, fast_to_peer, small_to_peer;
};

Figures measure(const Bench& bench, int times) {
    const auto fast = make_fast(bench.program());
    const auto small = make_small(bench.program());
    const auto peer = make_peer(bench.program());
    for (BenchMachine* machine : {fast.get(), small.get(), peer.get()})
        machine->event(isa::kInitEvent);
    std::vector<double> speeds[3], ratios, small_ratios;
    for (int round = 0; round < kRounds; ++round) {
        const uint64_t before = fast->instructions();
        const double seconds[] = {bench.run(*fast, times), bench.run(*small, times),
                                  bench.run(*peer, times)};
        const auto millions = static_cast<double>(fast->instructions() - before) / 1e6;
        for (size_t i = 0; i < 3; ++i) speeds[i].push_back(millions / seconds[i]);
        ratios.push_back(seconds[2] / seconds[0]);
        small_ratios.push_back(seconds[2] / seconds[1]);
    }
    return {median(speeds[0]), median(speeds[1]), median(speeds[2]), median(ratios),
            median(small_ratios)};
}

int run() {
    fmt::print("millions of instructions a second, medians of {} rounds in turns\n", kRounds);
    fmt::print("{:14}{:>8}{:>8}{:>12}{:>14}{:>12}\n", "program", "fastvm", "vm", "libasebavm",
               "fastvm/peer", "vm/peer");
    std::vector<double> ratios;
    for (const Work& work : works()) {
        Bench bench;
        if (!bench.compile(work)) return 1;
        const int times = prepare(bench, work.name);
        if (times == 0) return 1;
        const Figures figures = measure(bench, times);
        ratios.push_back(figures.fast_to_peer);
        fmt::print("{:14}{:8.0f}{:8.0f}{:12.0f}{:14.2f}{:12.2f}\n", work.name, figures.fast,
                   figures.small, figures.peer, figures.fast_to_peer, figures.small_to_peer);
    }
    fmt::print("figure: fastvm is {:.1f} to {:.1f} times as fast as libasebavm (aim: 2 or more)\n",
               *std::ranges::min_element(ratios), *std::ranges::max_element(ratios));
    return 0;
}

}  // namespace
}  // namespace vagus::bench

int main() {
    return vagus::bench::run();
}
