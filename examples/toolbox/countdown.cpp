// A toolbox with an actor and a supervisor of its own: what `--toolbox build/countdown.so` brings.
#include <chrono>
#include <memory>
#include <string>
#include <vagus/toolbox/plugin.hpp>

using namespace vagus;

namespace {

using plan::Type;
using plan::Value;

// Counts down, a number a second, into the log.
class CountDown final : public run::Actor {
    void run(run::ActorContext& context) override {
        for (int64_t n = context.in(0).integer(); n > 0; --n) {
            context.log(std::to_string(n));
            context.out(0, Value(n - 1));
            context.sleep(std::chrono::seconds(1));  // throws Stop when the plan goes another way
        }
        context.end(0);
    }
};

// Raises its event when the fuel is as low as that.
class CheckFuel final : public run::Supervisor {
    std::optional<plan::Given> check(const run::Check& check) override {
        if (check.in[0].number() > check.in[1].number()) return std::nullopt;
        return plan::Given{.outcome = 0, .outputs = {}};
    }
};

toolbox::Plugin make(const toolbox::Parts&) {
    plan::Template count_down{
        .name = "CountDown",
        .help = "Counts down in the log, a number a second.",
        .icon = "M5 4h14M5 20h14M7 4c0 8 10 8 10 16M17 4c0 8-10 8-10 16",
        .inputs = {{.name = "from",
                    .type = Type::Int,
                    .fallback = Value(int64_t{10}),
                    .help = "the first number",
                    .low = 0,
                    .high = 100}},
        .outputs = {{.name = "left", .type = Type::Int, .help = "numbers not yet counted"}},
        .outcomes = {{"Zero", "it has counted to the end"}}};
    plan::Template check_fuel{
        .name = "CheckFuel",
        .kind = plan::Kind::Supervisor,
        .help = "Raises its event when there is little fuel.",
        .icon = "M6 21V4h8v17M4 21h12M14 10h3v7a1.5 1.5 0 0 0 3 0V8l-3-3",
        .inputs = {{.name = "fuel", .type = Type::Float, .unit = "l", .help = "what there is"},
                   {.name = "least",
                    .type = Type::Float,
                    .fallback = Value(1.0),
                    .unit = "l",
                    .help = "from here on it is little"}},
        .outcomes = {{"FuelLow", "there is little"}},
        .period_ms = 100};
    return {.name = "countdown",
            .help = "Launches rockets.",
            .templates = {
                {count_down, [] { return std::make_unique<CountDown>(); }, {}},
                {check_fuel, {}, [] { return std::make_unique<CheckFuel>(); }},
            }};
}

}  // namespace

VAGUS_TOOLBOX(make)
