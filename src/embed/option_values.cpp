// Values of the options of `plan run`, read from the words on a command line (prepared_run.hpp),
// and which of them go together (run_words.hpp).
#include <fmt/format.h>

#include <array>
#include <numbers>

#include "base/file.hpp"
#include "base/nearest.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "embed/prepared_run.hpp"
#include "embed/run_words.hpp"
#include "plan/value.hpp"
#include "sim/chaos_file.hpp"
#include "sim/crew.hpp"
#include "toolbox/core_values.hpp"

namespace vagus::embed {

namespace {

Error usage(std::string sentence) {
    return {Code::BadInput, std::move(sentence)};
}

constexpr double kRadiansPerDegree = std::numbers::pi / 180;

}  // namespace

Status check_words(const RunWords& words) {
    if (!words.clock.empty() && words.clock != "real" && words.clock != "virtual") {
        return usage(fmt::format("--clock {}: expected real or virtual", words.clock));
    }
    if (!words.bus.empty() && !words.world.empty()) {
        return usage("--bus and --world: a run has one bus; leave one of them out");
    }
    if (!words.bus.empty() && words.clock == "virtual") {
        return usage(
            "--bus with --clock virtual: what is on a bus lives in real time; leave "
            "--clock out, or let a --world take its place");
    }
    if (!words.answers.empty() && words.world.empty() && words.clock != "virtual") {
        return usage(
            "--answers: code that answers by itself needs no real time, and no bus; write --clock "
            "virtual, or give it a --world");
    }
    if (!words.listen.empty() && words.world.empty()) {
        return usage("--listen goes with --world: it opens the bus of the world to others");
    }
    if (!words.listen.empty() && words.clock == "virtual") {
        return usage(
            "--listen with --clock virtual: programs on a bus live in real time; leave one "
            "of them out");
    }
    if (!words.project.empty() && words.bus.empty()) {
        return usage(
            "--project goes with --bus; beside a world, names of events are those of the "
            "scripts that its robots load");
    }
    if (!words.robot.empty() && words.world.empty()) {
        return usage("--robot goes with --world: it names one of its robots");
    }
    if (!words.poses.empty() && words.world.empty()) {
        return usage("--pose goes with --world: it says where one of its robots begins");
    }
    if (!words.threads.empty() && words.world.empty()) {
        return usage("--threads goes with --world: they sense and run scripts for its robots");
    }
    if (!words.chaos.empty() && words.world.empty()) {
        return usage(
            "--chaos goes with --world: it breaks what the world simulates; a real robot is not "
            "broken on purpose");
    }
    if (!words.trace_all.empty() && words.world.empty()) {
        return usage("--trace-all goes with --world; for the plan alone there is --trace");
    }
    return Status::done();
}

Result<uint64_t> parse_seed(const std::string& text) {
    if (const auto seed = decimal_number(text)) return *seed;
    return usage(
        fmt::format("--seed {}: expected a whole number from 0 to {} in digits", text, UINT64_MAX));
}

Result<sim::RobotStart> parse_pose(const std::string& text) {
    const size_t equals = text.find('=');
    const std::string numbers = equals == std::string::npos ? "" : text.substr(equals + 1);
    std::array<double, 3> values{};
    const auto parts = split(numbers, ',');
    bool good = equals > 0 && parts.size() == values.size();
    for (size_t i = 0; good && i < values.size(); ++i) {
        const Result<double> number = plan::float_from_text(std::string(parts[i]));
        good = number.ok();
        if (good) values[i] = number.value();
    }
    if (!good) {
        return usage(fmt::format(
            "--pose {}: expected a robot's name, x and y in metres and an angle in degrees, as "
            "--pose carbot=1.5,0.8,90",
            text));
    }
    return sim::RobotStart{text.substr(0, equals),
                           {{values[0], values[1]}, values[2] * kRadiansPerDegree}};
}

Result<unsigned> parse_threads(const std::string& text) {
    const auto threads = decimal_number(text);
    if (threads && *threads >= 1 && *threads <= sim::kThreadsMax)
        return static_cast<unsigned>(*threads);
    return usage(
        fmt::format("--threads {}: expected a whole number from 1 to {}", text, sim::kThreadsMax));
}

namespace {

constexpr std::string_view kRandom = "random:";

// N[:SEED[:SECONDS[:KIND,KIND]]]
Result<sim::Chaos> parse_drawn(const std::string& text) {
    const auto parts = split(std::string_view(text).substr(kRandom.size()), ':');
    const auto count = decimal_number(std::string(parts[0]));
    sim::ChaosDraw draw;
    bool good = count && *count >= 1 && *count <= sim::kChaosDrawnMax && parts.size() <= 4;
    if (good) draw.count = static_cast<size_t>(*count);
    if (good && parts.size() > 1) {
        draw.seed = decimal_number(std::string(parts[1]));
        good = draw.seed.has_value();
    }
    if (good && parts.size() > 2) {
        const Result<double> seconds = plan::float_from_text(std::string(parts[2]));
        good = seconds.ok() && seconds.value() > 0 && seconds.value() <= sim::kChaosTimeMax;
        if (good) draw.within = from_seconds(seconds.value());
    }
    if (!good) {
        return usage(fmt::format(
            "--chaos {}: expected how many faults, 1 to {}, perhaps a seed, perhaps the seconds "
            "within which they begin, as random:3, random:3:7 or random:3:7:60",
            text, sim::kChaosDrawnMax));
    }
    if (parts.size() > 3) {
        auto kinds = sim::parse_chaos_kinds(parts[3]);
        if (!kinds.ok()) return usage(fmt::format("--chaos {}: {}", text, kinds.error().what));
        draw.kinds = std::move(kinds.value());
    }
    sim::Chaos chaos{.file = "--chaos " + text};
    chaos.draw = draw;
    return chaos;
}

}  // namespace

Result<sim::Chaos> read_chaos_words(const std::string& text) {
    if (text.starts_with(kRandom)) return parse_drawn(text);
    if (text.starts_with('[') || text.starts_with('{')) return sim::read_chaos(text, "--chaos");
    return sim::read_chaos(TRY(read_file(text)), text);
}

Result<std::pair<int, plan::Value>> parse_set(const plan::GraphPlan& plan,
                                              const std::string& text) {
    const size_t equals = text.find('=');
    if (equals == std::string::npos) {
        return usage(fmt::format("--set {}: expected NAME=VALUE, as --set speed=12", text));
    }
    const std::string name = text.substr(0, equals);
    for (size_t slot = 0; slot < plan.variables.size(); ++slot) {
        if (plan.variables[slot].name != name) continue;
        Result<plan::Value> value =
            plan::convert(plan::Value(text.substr(equals + 1)), plan.variables[slot].type);
        if (value.ok()) return std::pair(static_cast<int>(slot), std::move(value.value()));
        return usage(fmt::format("--set {}: {}", text, value.error().what));
    }
    std::vector<std::string> known;
    for (const plan::GraphVariable& one : plan.variables) known.push_back(one.name);
    return Error{Code::NotFound, fmt::format("--set {}: the plan {} has no variable \"{}\"; {}",
                                             text, plan.name, name, known_instead(name, known))};
}

Result<std::optional<Duration>> parse_max_time(const std::string& text) {
    const Result<double> seconds = plan::float_from_text(text);
    const Duration time = seconds.ok() ? toolbox::duration_of(seconds.value()) : Duration{0};
    if (time == run::kNever) return std::optional<Duration>();
    if (time.count() > 0) return std::optional(time);
    return usage(fmt::format("--max-time {}: expected seconds above 0, as --max-time 2.5", text));
}

Result<sim::WorldOptions> world_options(const WorldWords& words) {
    sim::WorldOptions options;
    if (!words.seed.empty()) options.seed = TRY(parse_seed(words.seed));
    for (const std::string& pose : words.poses) options.starts.push_back(TRY(parse_pose(pose)));
    if (!words.chaos.empty()) options.chaos = TRY(read_chaos_words(words.chaos));
    return options;
}

}  // namespace vagus::embed
