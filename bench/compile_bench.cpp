// How long it takes to compile a program of 1,000 lines: our compiler and Debian's libasebacompiler
// in turns, in one run. Prints both medians and their ratio; the aim is a third.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "aesl/compile.hpp"
#include "aesl/node_file.hpp"
#include "peer.hpp"

namespace vagus::aesl {
namespace {

constexpr int kEvents = 20;
constexpr int kSubs = 20;
constexpr int kLines = 1000;
constexpr int kRounds = 101;

// A robot with a few sensors and motors and an event for each behaviour.
NodeFile robot() {
    NodeFile node;
    node.target.name = "robot";
    node.target.bytecode_size = 4000;
    node.target.variables_size = 1000;
    node.target.stack_size = 64;
    node.target.variables = {{"_id", 1},    {"event.source", 1}, {"event.args", 32}, {"prox", 7},
                             {"ground", 2}, {"motor.left", 1},   {"motor.right", 1}};
    for (int i = 0; i < kEvents; ++i)
        node.target.local_events.push_back({fmt::format("e{}", i), ""});
    node.target.natives = {
        {"math.rand", "", {{"dest", -1}}},
        {"math.clamp", "", {{"dest", -1}, {"src", -1}, {"low", -1}, {"high", -1}}}};
    node.common.events = {{"lost", 1}, {"seen", 3}};
    node.common.constants = {{"LIMIT", 2000}, {"CRUISE", 200}};
    return node;
}

// 24 lines of the kind that people write; `n` makes the names differ.
std::string behaviour(int n, const std::string& header) {
    const std::string calls = n < kEvents ? fmt::format("callsub s{}", n) : "# nothing to call";
    return fmt::format(
        "\n"
        "# Behaviour {0}: keep the distance, slow down near things, tell when the line is lost.\n"
        "{1}\n"
        "count{0} += 1\n"
        "if prox[2] > LIMIT and count{0} % 4 == 0 then\n"
        "\tspeed{0} = (prox[0] + 2 * prox[1] - prox[4]) / 3\n"
        "elseif prox[0] < prox[4] - 100 then\n"
        "\tspeed{0} = CRUISE\n"
        "else\n"
        "\tspeed{0} -= 10  # rolls out\n"
        "end\n"
        "motor.left = speed{0} + turn{0}[0]\n"
        "motor.right = speed{0} - turn{0}[0]\n"
        "for i in 0:6 do\n"
        "\tif prox[i] > highest{0} then highest{0} = prox[i] end\n"
        "end\n"
        "turn{0} = [turn{0}[1], ground[0] - ground[1]]\n"
        "when ground[0] < 100 and ground[1] < 100 do\n"
        "\temit lost count{0}\n"
        "end\n"
        "# the hull first\n"
        "\n"
        "{2}\n"
        "\n",
        n, header, calls);
}

std::string program() {
    std::string source = "# Drives a robot by reflexes.\nvar i\n";
    for (int n = 0; n < kEvents + kSubs; ++n)
        source +=
            fmt::format("var count{0} var speed{0} = CRUISE var highest{0} var turn{0}[2]\n", n);
    for (int n = 0; n < kEvents; ++n) source += behaviour(n, fmt::format("onevent e{}", n));
    for (int n = 0; n < kSubs; ++n) source += behaviour(kEvents + n, fmt::format("sub s{}", n));
    const auto lines = std::count(source.begin(), source.end(), '\n');
    for (auto i = lines; i < kLines; ++i) source += "# the end\n";
    return source;
}

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + kRounds / 2, values.end());
    return values[kRounds / 2];
}

template <typename Work>
double microseconds(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start)
        .count();
}

int run() {
    const NodeFile node = robot();
    const std::string source = program();
    const std::wstring wide = widened(source);
    PeerCompiler peer(node);
    const Compilation compiled = compile(source, node.target, node.common, {});
    if (!compiled.ok() || !peer.compiles(wide)) {
        std::fprintf(stderr, "the program does not compile: %s\n",
                     compiled.ok() ? "peer" : compiled.errors[0].message.c_str());
        return 1;
    }
    std::vector<double> ours;
    std::vector<double> theirs;
    for (int i = 0; i < kRounds; ++i) {
        ours.push_back(microseconds([&] { (void)compile(source, node.target, node.common, {}); }));
        theirs.push_back(microseconds([&] { (void)peer.compiles(wide); }));
    }
    const auto lines = std::count(source.begin(), source.end(), '\n');
    std::printf("%ld lines, %zu words of bytecode, median of %d\n", static_cast<long>(lines),
                compiled.program.bytecode.size(), kRounds);
    std::printf("vagus             %8.0f us\n", median(ours));
    std::printf("libasebacompiler  %8.0f us\n", median(theirs));
    std::printf("ratio             %8.3f (aim: 0.333 or less)\n", median(ours) / median(theirs));
    return 0;
}

}  // namespace
}  // namespace vagus::aesl

int main() {
    return vagus::aesl::run();
}
