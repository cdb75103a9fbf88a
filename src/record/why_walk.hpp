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

// A link that others may have lost against: its index in the chain, the line of the trace on which
// bus.
struct TiedLink {
    size_t link = 0;
    size_t bus = 0;
    size_t line = 0;
};

class Walk {
public:
    explicit Walk(const Causes& causes)
        : all_(causes), rerun_(causes.rerun()), bus_(&causes.bus(0)) {}

    Result<Chain> answer(const Question& question) {
        if (auto beyond = not_in_frames(question)) return *beyond;
        TRY(all_.is_fleet() ? ask_fleet(question) : ask_one_bus(question));
        chaos();
        if (!chain_.empty()) chain_.back().root = true;
        return chain_;
    }
    Chain moment(Time after, Time by, const std::string& robot);  // of why.hpp
    const std::vector<TiedLink>& ties() const { return ties_; }

private:
    // ---- which bus a question is about (why_fleet.cpp) ----
    Status ask(const Question& question);
    Status ask_one_bus(const Question& question);
    Status ask_fleet(Question question);
    Status ask_robot(Question question);
    Status ask_all(const Question& question);
    std::vector<std::string> robots_on(size_t bus) const;
    Error several_have(const Question& question, const std::vector<size_t>& buses) const;

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
    Error nothing_of(std::string_view kind, const std::string& name);

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
    void frame_of_plan(const BusCauses::Frame& frame);
    void frame_of_supervisor(const BusCauses::Frame& frame);
    void frame_of_bus_node(uint32_t number, const BusCauses::Frame& frame);
    // ---- what the fleet brought and told (why_keeper.cpp) ----
    void message(const BusCauses::Message& message);
    void news(const BusCauses::News& news);
    void answer_of_keeper(Time at, const keeper::Over& over);
    void value_of_keeper(Time at, const keeper::Shared& value);
    void question_of(const DecidedQuestion& asked);
    std::optional<size_t> started_before(size_t line) const;
    void run(uint32_t number);
    void local_event(const BusCauses::HandlerRun& run);
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
    void wrote(const sim::WitnessedNode& node, const BusCauses::Deed& deed,
               const std::string& name);

    // A link at an element of the plan with that instance path.
    bool add_element(Time at, std::string what, const std::string& plan, std::string_view name,
                     std::string value = {}) {
        return add({.at = at,
                    .what = std::move(what),
                    .place = places().element(plan, name),
                    .value = std::move(value),
                    .element = std::string(name)});
    }
    bool add(Link link) {
        if (chain_.size() >= kLinksMax) return false;
        if (link.robot.empty()) link.robot = bus_->bus().robot;
        chain_.push_back(std::move(link));
        return true;
    }
    bool add_of(const sim::WitnessedNode& node, Link link) {
        link.robot = robot_of(node.robot);
        return add(std::move(link));
    }
    // Of a fleet: its name. Empty for 0.
    std::string robot_of(uint32_t number) const;
    // What is told meanwhile is of another bus.
    template <typename Tell>
    void on_bus(size_t index, const Tell& tell) {
        const size_t before = std::exchange(index_, index);
        bus_ = &all_.bus(index);
        tell();
        index_ = before;
        bus_ = &all_.bus(before);
    }
    session::SimSession* session() const { return bus_->bus().session; }
    PlanPlaces places() const { return {rerun_, bus_->bus().plan}; }
    const std::vector<BusCauses::Line>& lines() const { return bus_->lines(); }
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

    const Causes& all_;
    Rerun& rerun_;
    const BusCauses* bus_;  // of what is told now
    size_t index_ = 0;      // of that bus
    Chain chain_;
    std::vector<TiedLink> ties_;
    std::vector<std::string> known_;  // what there was instead of what was asked for
    std::string whose_;               // which robot was asked for; empty: none
};

// As a link tells it.
std::string value_text(const plan::Value& value);
std::string words_text(const std::vector<int16_t>& words);

}  // namespace vagus::record
