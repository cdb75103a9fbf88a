// Builds one chain of `vagus why` (why.hpp): from what is asked about, link by link, to its root.
//
//     Walk walk(causes);
//     const Chain chain = TRY(walk.answer(question));
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "record/plan_places.hpp"
#include "record/why.hpp"
#include "session/sim_session.hpp"

namespace vagus::record {

using About = Question::About;

class Walk {
public:
    explicit Walk(const Causes& causes)
        : causes_(causes), rerun_(causes.rerun()), places_(causes.rerun()) {}

    Result<Chain> answer(const Question& question) {
        if (auto beyond = not_in_frames(question)) return *beyond;
        Status asked = Status::done();
        switch (question.about) {
            case About::Actor:
                asked = actor(question.name);
                break;
            case About::Variable:
                asked = variable(question.name);
                break;
            case About::Motor:
                asked = motor(question.name);
                break;
            case About::Event:
                asked = event(question.name);
                break;
            case About::End:
                asked = end();
                break;
        }
        TRY(asked);
        chaos();
        if (!chain_.empty()) chain_.back().root = true;
        return chain_;
    }
    Chain moment(Time after, Time by);  // of why.hpp
    // Of links that others may have lost against: the index in the chain, the line of the trace.
    const std::vector<std::pair<size_t, size_t>>& ties() const { return ties_; }

private:
    // ---- questions ----
    std::optional<Error> not_in_frames(const Question& question) const;
    Status actor(const std::string& name);
    Status variable(const std::string& name);
    Status variable_of_node(const session::NodeState& node, const std::string& name);
    std::optional<session::NodeState> node_of(const std::string& variable) const;
    void variable_written(size_t index, const plan::VariableWritten& written);
    Status motor(const std::string& robot);
    Status event(const std::string& name);
    Status end();

    // ---- what happened at a moment ----
    void active_actors(Time after);
    void draws(Time after, Time by);
    void decisions(Time after, Time by);
    void happened(Time after, Time by);
    void handlers(Time after, Time by);
    template <typename Tell>
    void tell_alone(const Tell& tell);

    // ---- links, each followed by what it came from ----
    void frame(uint32_t number);
    void frame_of_plan(const Causes::Frame& frame);
    void frame_of_supervisor(const Causes::Frame& frame);
    void frame_of_bus_node(uint32_t number, const Causes::Frame& frame);
    void run(uint32_t number);
    void local_event(const Causes::HandlerRun& run);
    void call(uint32_t number);
    void happening(uint32_t number);
    void chaos();
    void line(size_t index);
    void before_started(size_t index, const plan::ActorStarted& started);
    void before_ended(size_t index, const plan::ActorEnded& ended);
    void raised(size_t index, const plan::EventRaised& raised);
    void interrupted(size_t index, const plan::ActorInterrupted& broken);
    void before_plan_began(size_t index);
    void before_plan_ended(size_t index, const plan::PlanEnded& ended);
    void failed(size_t index, const plan::ErrorFound& error);
    void ended_from_outside(Time at);
    void wrote(const sim::WitnessedNode& node, const Causes::Deed& deed, const std::string& name);

    // A link at an element of the plan with that instance path.
    bool add_element(Time at, std::string what, const std::string& plan, std::string_view name,
                     std::string value = {}) {
        return add({.at = at,
                    .what = std::move(what),
                    .place = places_.element(plan, name),
                    .value = std::move(value),
                    .element = std::string(name)});
    }
    bool add(Link link) {
        if (chain_.size() >= kLinksMax) return false;
        chain_.push_back(std::move(link));
        return true;
    }
    const std::vector<Causes::Line>& lines() const { return causes_.lines(); }
    template <typename What>
    const What* what(size_t index) const {
        return std::get_if<What>(&lines()[index].event.what);
    }
    bool same_plan(size_t a, size_t b) const {
        return lines()[a].event.plan == lines()[b].event.plan;
    }
    std::string node_name(const sim::WitnessedNode& node) const;
    std::string place_of(const sim::WitnessedNode& node, uint16_t pc) const;
    std::string local_name(const sim::WitnessedNode& node, int event) const;
    std::string local_help(const sim::WitnessedNode& node, int event) const;
    bool leads_on(size_t index) const;
    // The last line before that one of which it is true.
    template <typename Is>
    std::optional<size_t> last_line(size_t before, const Is& is) const {
        for (size_t i = before; i-- > 0;) {
            if (is(i)) return i;
        }
        return std::nullopt;
    }

    const Causes& causes_;
    Rerun& rerun_;
    PlanPlaces places_;
    Chain chain_;
    std::vector<std::pair<size_t, size_t>> ties_;
};

// As a link tells it.
std::string value_text(const plan::Value& value);
std::string words_text(const std::vector<int16_t>& words);

}  // namespace vagus::record
