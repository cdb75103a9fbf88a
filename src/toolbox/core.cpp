#include "toolbox/core.hpp"

#include <fmt/format.h>

#include "toolbox/core_values.hpp"

namespace vagus::toolbox {

using plan::Given;
using plan::Kind;
using plan::Type;
using plan::Value;
using run::Actor;
using run::ActorContext;
using run::Check;
using run::Coded;
using run::CodeError;
using run::Supervisor;

namespace {

Value text(std::string_view value) {
    return Value(std::string(value));
}

// ---- actors ----

class Wait final : public Actor {
    void run(ActorContext& context) override { context.sleep(duration_of(context.in(0).number())); }
};

class WaitForever final : public Actor {
    void run(ActorContext& context) override { context.sleep(run::kNever); }
};

class Log final : public Actor {
    void run(ActorContext& context) override { context.log(context.in(0).string()); }
};

class Fail final : public Actor {
    void run(ActorContext& context) override { throw CodeError(context.in(0).string()); }
};

class Stubborn final : public Actor {
    void run(ActorContext& context) override {
        try {
            context.sleep(duration_of(context.in(0).number()));
        } catch (const run::Stop&) {
            const Duration linger = duration_of(context.in(1).number());
            if (linger.count() > 0) context.linger(linger);
            throw;
        }
    }
};

class Send final : public Actor {
    void run(ActorContext& context) override {
        context.emit({context.in(0).string(), words_of(context.in(1).string())});
    }
};

// Arguments that an event lacks are 0.
void give_arguments(const run::BusEvent& event, std::vector<std::optional<Value>>& outputs) {
    for (size_t i = 0; i < run::kEventArgumentsMax; ++i) {
        const int16_t word = i < event.arguments.size() ? event.arguments[i] : int16_t{0};
        outputs[i] = Value(int64_t{word});
    }
}

class Receive final : public Actor {
    void run(ActorContext& context) override {
        const run::BusEvent event = context.wait_event(context.in(0).string());
        std::vector<std::optional<Value>> outputs(run::kEventArgumentsMax);
        give_arguments(event, outputs);
        for (size_t i = 0; i < outputs.size(); ++i) context.out(i, *outputs[i]);
    }
};

// ---- computations ----

class Assign final : public Actor {
    void run(ActorContext& context) override { context.out(0, context.in(0)); }
};

class Compare final : public Actor {
    void run(ActorContext& context) override {
        context.end(compare(context.in(0), context.in(1).string(), context.in(2)) ? 0 : 1);
    }
};

class For final : public Actor {
    void run(ActorContext& context) override {
        const int64_t counter = context.in(0).integer();
        const int64_t last = context.in(1).integer();
        const int64_t step = context.in(2).integer();
        if (step < 0 ? counter < last : counter > last) {
            context.end(1);
            return;
        }
        int64_t next = 0;
        if (__builtin_add_overflow(counter, step, &next)) {
            throw CodeError(fmt::format("{} + {} does not fit an int of 64 bits", counter, step));
        }
        context.out(0, Value(next));
    }
};

class Random final : public Actor {
    void run(ActorContext& context) override {
        const int64_t low = context.in(0).integer();
        const int64_t high = context.in(1).integer();
        if (low > high) throw CodeError(fmt::format("low ({}) is above high ({})", low, high));
        // Unsigned throughout: a range of 2^64 values has the width 0.
        const uint64_t width = static_cast<uint64_t>(high) - static_cast<uint64_t>(low) + 1;
        const uint64_t next = context.random().next();
        const uint64_t value = static_cast<uint64_t>(low) + (width == 0 ? next : next % width);
        context.out(0, Value(static_cast<int64_t>(value)));
    }
};

// ---- supervisors ----

class Timeout final : public Supervisor {
    std::optional<Given> check(const Check& check) override {
        if (raised_ || check.since_start < duration_of(check.in[0].number())) return std::nullopt;
        raised_ = true;
        return Given{};
    }
    bool raised_ = false;
};

class Every final : public Supervisor {
    std::optional<Given> check(const Check& check) override {
        const Duration every = std::max(duration_of(check.in[0].number()), Duration{1});
        const int64_t count = check.since_start / every;
        if (count <= raised_at_) return std::nullopt;
        raised_at_ = count;
        return Given{.outcome = 0, .outputs = {Value(count)}};
    }
    int64_t raised_at_ = 0;
};

class Watch final : public Supervisor {
    std::optional<Given> check(const Check& check) override {
        if (!compare(check.in[0], check.in[1].string(), check.in[2])) return std::nullopt;
        return Given{};
    }
};

class OnEvent final : public Supervisor {
    std::optional<Given> check(const Check& check) override {
        if (check.event->name != check.in[0].string()) return std::nullopt;
        Given given{.outcome = 0, .outputs = {run::kEventArgumentsMax, std::nullopt}};
        give_arguments(*check.event, given.outputs);
        return given;
    }
};

// ---- declarations ----

template <typename Code>
Coded actor(plan::Template declared) {
    return {std::move(declared), [] { return std::make_unique<Code>(); }, {}};
}

template <typename Code>
Coded supervisor(plan::Template declared) {
    declared.kind = Kind::Supervisor;
    return {std::move(declared), {}, [] { return std::make_unique<Code>(); }};
}

std::vector<plan::OutputDeclaration> argument_outputs() {
    std::vector<plan::OutputDeclaration> outputs;
    for (size_t i = 0; i < run::kEventArgumentsMax; ++i) {
        outputs.push_back({.name = fmt::format("arg{}", i),
                           .type = Type::Int,
                           .help = "an argument of the event, 0 if it has fewer"});
    }
    return outputs;
}

plan::Input seconds(std::string help) {
    return {.name = "seconds", .type = Type::Float, .unit = "s", .help = std::move(help)};
}

plan::Input event_name() {
    return {.name = "event", .type = Type::String, .help = "name of the event on the bus"};
}

std::vector<plan::Input> comparison() {
    return {{.name = "left", .type = {}, .help = "any value"},
            {.name = "op", .type = Type::String, .help = "one of == != < <= > >="},
            {.name = "right", .type = {}, .help = "any value"}};
}

// Icons are SVG path data on a 24 x 24 field.
std::vector<Coded> actors() {
    std::vector<Coded> list;
    list.push_back(actor<Wait>({.name = "Wait",
                                .help = "Waits so long.",
                                .icon = "M12 2a10 10 0 1 0 0 20a10 10 0 0 0 0-20M12 6v6l4 3",
                                .inputs = {seconds("how long")},
                                .outcomes = {{"Done", "the time is over"}}}));
    list.push_back(actor<WaitForever>({.name = "WaitForever",
                                       .help = "Waits until a supervisor interrupts it.",
                                       .icon = "M7 9a3 3 0 1 0 0 6c4 0 6-6 10-6a3 3 0 1 1 0 6c-4 "
                                               "0-6-6-10-6"}));
    list.push_back(
        actor<Log>({.name = "Log",
                    .help = "Writes a line to the log and the trace.",
                    .icon = "M4 5h16M4 10h16M4 15h10",
                    .inputs = {{.name = "text", .type = Type::String, .help = "the line"}},
                    .outcomes = {{"Done", "it is written"}}}));
    list.push_back(
        actor<Fail>({.name = "Fail",
                     .help = "Ends the plan with an internal error.",
                     .icon = "M5 5l14 14M19 5L5 19",
                     .inputs = {{.name = "message", .type = Type::String, .help = "the error"}},
                     .only_fails = true}));
    list.push_back(actor<Stubborn>(
        {.name = "Stubborn",
         .help = "Waits, and when told to stop goes on for a while: to see how a plan takes that.",
         .icon = "M6 4h12v16H6zM9 9h6M9 13h6",
         .inputs = {seconds("how long it waits"),
                    {.name = "linger",
                     .type = Type::Float,
                     .unit = "s",
                     .help = "how long it goes on when told to stop"}},
         .outcomes = {{"Done", "the time is over"}}}));
    list.push_back(actor<Send>({.name = "Send",
                                .help = "Emits an event on the bus.",
                                .icon = "M3 12h14M12 6l6 6l-6 6",
                                .inputs = {event_name(),
                                           {.name = "args",
                                            .type = Type::String,
                                            .fallback = text(""),
                                            .help = "up to eight whole numbers, as \"1 2 3\""}},
                                .outcomes = {{"Sent", "it is on its way"}}}));
    list.push_back(actor<Receive>({.name = "Receive",
                                   .help = "Waits for an event on the bus.",
                                   .icon = "M21 12H7M12 6l-6 6l6 6",
                                   .inputs = {event_name()},
                                   .outputs = argument_outputs(),
                                   .outcomes = {{"Received", "the event has come"}}}));
    return list;
}

std::vector<Coded> computations() {
    std::vector<Coded> list;
    list.push_back(
        actor<Assign>({.name = "Assign",
                       .kind = Kind::Computation,
                       .help = "Gives a variable the value of a formula.",
                       .icon = "M4 9h16M4 15h16",
                       .inputs = {{.name = "value", .type = {}, .help = "any value"}},
                       .outputs = {{.name = "result", .type = {}, .help = "the same value"}},
                       .outcomes = {{"Done", "it is written"}}}));
    list.push_back(actor<Compare>({.name = "Compare",
                                   .kind = Kind::Computation,
                                   .help = "Takes one of two ways by a comparison.",
                                   .icon = "M12 3l9 9l-9 9l-9-9z",
                                   .inputs = comparison(),
                                   .outcomes = {{"True", "it holds"}, {"False", "it does not"}}}));
    list.push_back(actor<For>(
        {.name = "For",
         .kind = Kind::Computation,
         .help = "Counts a variable on while it is not beyond the last value.",
         .icon = "M5 12a7 7 0 1 1 7 7M12 19l3-3M12 19l3 3",
         .inputs = {{.name = "counter", .type = Type::Int, .help = "the value of the counter"},
                    {.name = "last", .type = Type::Int, .help = "the last value that counts"},
                    {.name = "step",
                     .type = Type::Int,
                     .fallback = Value(int64_t{1}),
                     .help = "added each time; may be negative"}},
         .outputs = {{.name = "counter", .type = Type::Int, .help = "counter + step"}},
         .outcomes = {{"Loop", "go on"}, {"Done", "the counter is beyond the last value"}}}));
    list.push_back(actor<Random>(
        {.name = "Random",
         .kind = Kind::Computation,
         .help = "Draws a number; the seed of the run decides which.",
         .icon = "M4 4h16v16H4zM8 8h.1M16 16h.1M12 12h.1",
         .inputs = {{.name = "low", .type = Type::Int, .help = "the lowest number"},
                    {.name = "high", .type = Type::Int, .help = "the highest number"}},
         .outputs = {{.name = "value", .type = Type::Int, .help = "the number drawn"}},
         .outcomes = {{"Done", "it is drawn"}}}));
    return list;
}

std::vector<Coded> supervisors() {
    std::vector<Coded> list;
    list.push_back(supervisor<Timeout>({.name = "Timeout",
                                        .help = "Raises its event once, after a time.",
                                        .icon = "M12 4a9 9 0 1 0 .1 0M12 8v5M9 1h6",
                                        .inputs = {seconds("how long after its start")},
                                        .outcomes = {{"Timeout", "the time is over"}}}));
    list.push_back(supervisor<Every>(
        {.name = "Every",
         .help = "Raises its event again and again.",
         .icon = "M4 12a8 8 0 0 1 14-5M20 12a8 8 0 0 1-14 5M18 3v4h-4M6 21v-4h4",
         .inputs = {seconds("time from one to the next")},
         .outputs = {{.name = "count", .type = Type::Int, .help = "whole times since its start"}},
         .outcomes = {{"Tick", "the time is over again"}}}));
    list.push_back(supervisor<Watch>({.name = "Watch",
                                      .help = "Raises its event whenever a comparison holds.",
                                      .icon = "M2 12s4-7 10-7s10 7 10 7s-4 7-10 7s-10-7-10-7M12 "
                                              "9a3 3 0 1 0 .1 0",
                                      .inputs = comparison(),
                                      .outcomes = {{"True", "it holds"}}}));
    list.push_back(supervisor<OnEvent>({.name = "OnEvent",
                                        .help = "Raises its event when one comes on the bus.",
                                        .icon = "M6 10a6 6 0 0 1 12 0v5l2 3H4l2-3zM10 21h4",
                                        .inputs = {event_name()},
                                        .outputs = argument_outputs(),
                                        .outcomes = {{"Received", "the event has come"}},
                                        .period_ms = 0}));
    return list;
}

}  // namespace

void add_core(run::CodeLibrary& library) {
    std::vector<Coded> all = actors();
    for (auto* more : {&computations, &supervisors}) {
        for (Coded& one : (*more)()) all.push_back(std::move(one));
    }
    library.add("core", "Templates for every platform: waiting, counting, comparing, bus events.",
                std::move(all));
}

}  // namespace vagus::toolbox
