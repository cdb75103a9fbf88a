#include "trial/signals.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vagus::trial {

namespace {

using plan::Type;

constexpr Signal kSignals[] = {
    {SignalId::Actor, "actor", Type::String, "", false,
     "the actor that runs, of a sub-plan too; '' between two; only with a plan"},
    {SignalId::Event, "event", Type::String, "", false,
     "the event that a supervisor raises, at the line of the trace that says so; without a plan "
     "the user event that is sent on the robot's bus, at that instant; else ''"},
    {SignalId::Time, "t", Type::Float, "s", false, "time since the run began"},
    {SignalId::X, "x", Type::Float, "m", true, "where the robot is"},
    {SignalId::Y, "y", Type::Float, "m", true, "where the robot is"},
    {SignalId::Angle, "angle", Type::Float, "deg", true,
     "where the robot looks, counter-clockwise from the x axis, above -180 to 180"},
    {SignalId::Contact, "contact", Type::Float, "s", true,
     "for how long something solid has touched the robot without a break; 0 if nothing does"},
    {SignalId::Bus, "bus", Type::Float, "%", true,
     "how busy the robot's bus was over the last second; 0 where the bus is ideal"},
};

}  // namespace

std::span<const Signal> signals() {
    return kSignals;
}

const Signal* find_signal(std::string_view name) {
    const auto found =
        std::ranges::find_if(kSignals, [name](const Signal& one) { return one.name == name; });
    return found == std::end(kSignals) ? nullptr : found;
}

std::string describe_signals() {
    std::string lines;
    const auto add = [&lines](std::string_view name, std::string_view unit, std::string_view help) {
        lines += fmt::format("  {:<26} {:<4} {}\n", name, unit, help);
    };
    for (const Signal& one : signals()) add(one.name, one.unit, one.help);
    add("NAME", "", "a variable of the plan");
    add("variable(\"NAME\")", "", "the same, for one that is called like a signal");
    add("node(\"NODE\", \"NAME\")", "",
        "a word of a node of the robot, as node(\"drive\", \"token\")");
    add("node(\"NODE\", \"NAME[2]\")", "", "a word of an array, counted from 0");
    return lines;
}

}  // namespace vagus::trial
