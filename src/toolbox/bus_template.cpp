#include "toolbox/bus_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "toolbox/bus.hpp"
#include "toolbox/bus_talk.hpp"

namespace vagus::toolbox {

using plan::Given;
using plan::Value;
using run::ActorContext;
using run::BusEvent;
using run::CodeError;

namespace {

// What code needs of its template.
struct Work {
    BusTemplate of;
    const Parts& parts;
};

std::vector<int16_t> words_of(const Work& work, const std::vector<Value>& in) {
    std::vector<int16_t> words;
    for (size_t i = 0; i < work.of.inputs.size(); ++i) {
        const Status fits = encode(work.of.declared.inputs[i], work.of.inputs[i], in[i], words);
        if (!fits.ok()) throw CodeError(fits.error().what);
    }
    return words;
}

// The state or event that `event`, without its token, brings; empty if none.
std::optional<Given> outcome_of(const Work& work, const BusEvent& event) {
    const auto& outcomes = work.of.outcomes;
    const auto found = std::find_if(outcomes.begin(), outcomes.end(),
                                    [&event](const auto& one) { return one.event == event.name; });
    if (found == outcomes.end()) return std::nullopt;
    Given given{.outcome = static_cast<int>(found - outcomes.begin()), .outputs = {}};
    given.outputs.resize(work.of.outputs.size());
    size_t at = 0;
    for (const size_t output : found->outputs) {
        const BusValue& as = work.of.outputs[output];
        const size_t end = at + static_cast<size_t>(as.words);
        if (end > event.arguments.size()) {
            throw CodeError(
                fmt::format("the event \"{}\" came with {} words after its token, too "
                            "few for its outputs; look at the script of the node",
                            event.name, event.arguments.size()));
        }
        given.outputs[output] =
            decode(*work.of.declared.outputs[output].type, as, event.arguments.data() + at);
        at = end;
    }
    return given;
}

std::vector<std::string> answers_of(const BusTemplate& of) {
    std::vector<std::string> answers;
    if (!of.stopped.empty()) answers.push_back(of.stopped);
    for (const BusOutcome& outcome : of.outcomes) answers.push_back(outcome.event);
    return answers;
}

class BusActor final : public run::Actor {
public:
    explicit BusActor(const Work& work) : work_(work) {}

    void run(ActorContext& context) override {
        const BusTemplate& of = work_.of;
        BusTalk talk(context, work_.parts, {of.nodes}, answers_of(of), of.ended);
        std::vector<Value> in;
        for (size_t i = 0; i < of.inputs.size(); ++i) in.push_back(context.in(i));
        talk.say(of.start, words_of(work_, in));
        try {
            await_end(context, talk);
        } catch (const run::Stop&) {
            if (!of.stop.empty())
                talk.stop(of.stop, of.stopped, Duration{of.declared.grace_ms * 1000});
            throw;
        } catch (const CodeError&) {
            if (!of.stop.empty()) talk.say(of.stop);
            throw;
        }
    }

private:
    // Until an event of this activation ends it; meanwhile the node is told that somebody cares.
    void await_end(ActorContext& context, BusTalk& talk) const {
        const std::string& alive = work_.of.alive;
        Time next_alive = context.now() + kAlivePeriod;
        for (;;) {
            const Duration rest = alive.empty() ? run::kNever : next_alive - context.now();
            const std::optional<BusEvent> event = talk.hear(rest);
            if (event && end_with(context, *event)) return;
            if (alive.empty() || context.now() < next_alive) continue;
            talk.say(alive);
            next_alive = context.now() + kAlivePeriod;
        }
    }

    bool end_with(ActorContext& context, const BusEvent& event) const {
        const std::optional<Given> given = outcome_of(work_, event);
        if (!given) return false;
        for (size_t i = 0; i < given->outputs.size(); ++i) {
            if (given->outputs[i]) context.out(i, *given->outputs[i]);
        }
        context.end(given->outcome);
        return true;
    }

    const Work& work_;
};

class BusSupervisor final : public run::Supervisor {
public:
    explicit BusSupervisor(const Work& work) : work_(work) {}

    void started(const std::vector<Value>& in, run::SupervisorContext& context) override {
        token_ = token_of(context.number());
        node_ = find_node(work_.of.nodes, work_.parts);
        BusEvent start{work_.of.start, {token_}};
        const std::vector<int16_t> words = words_of(work_, in);
        start.arguments.insert(start.arguments.end(), words.begin(), words.end());
        context.emit(std::move(start));
        watches_ = true;
    }

    std::optional<Given> check(const run::Check& check) override {
        if (check.event->name == node_left(node_)) throw CodeError(has_left(node_));
        if (check.event->arguments.empty() || check.event->arguments.front() != token_) {
            return std::nullopt;
        }
        BusEvent event = *check.event;
        event.arguments.erase(event.arguments.begin());
        return outcome_of(work_, event);
    }

    void stopped(run::SupervisorContext& context) noexcept override {
        if (watches_ && !work_.of.stop.empty()) context.emit({work_.of.stop, {token_}});
    }

private:
    const Work& work_;
    int16_t token_ = 0;
    std::string node_;
    bool watches_ = false;
};

}  // namespace

std::vector<run::Coded> code_of(const ToolboxFile& file, const Parts& parts) {
    std::vector<run::Coded> all;
    for (const BusTemplate& one : file.templates) {
        // Owners: the makers in the library, which outlive the code that they make.
        const auto work = std::make_shared<const Work>(Work{one, parts});
        run::Coded coded{.declared = one.declared};
        coded.declared.bus = {events_of(one), {one.start}, {one.nodes}};
        if (!one.stop.empty()) coded.declared.bus.stops.push_back(one.stop);
        if (one.declared.kind == plan::Kind::Supervisor) {
            coded.supervisor = [work] { return std::make_unique<BusSupervisor>(*work); };
        } else {
            coded.actor = [work] { return std::make_unique<BusActor>(*work); };
        }
        all.push_back(std::move(coded));
    }
    return all;
}

std::vector<std::string> events_of(const BusTemplate& of) {
    std::vector<std::string> events;
    for (const std::string& name : {of.start, of.stop, of.alive}) {
        if (!name.empty()) events.push_back(name);
    }
    for (std::string& name : answers_of(of)) events.push_back(std::move(name));
    return events;
}

}  // namespace vagus::toolbox
