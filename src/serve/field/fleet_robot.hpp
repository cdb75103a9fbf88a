// A robot that serves itself, in a fleet: the member (fleet/member.hpp), its link to the broker,
// and the workbench that obeys. All of it is on the thread of the loop, which waits for none of it.
//
//     const auto robot = TRY(FleetRobot::join(bench, options, talk, now));
//     robot->tick(now);
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "base/result.hpp"
#include "fleet/member.hpp"
#include "fleet/tell_list.hpp"
#include "plan/word_formula.hpp"
#include "serve/broker/fleet_options.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

class FleetRobot {
public:
    struct Talk {
        std::function<void()> wake;  // from another thread
        std::function<void(const std::string& kind, const std::string& text)> log;
        std::string studio;  // address of the robot's pages
        // Another version is wanted; it comes again at each connection.
        std::function<void(const fleet::Want& want)> want = [](auto&) {};
    };
    // The Error says what is wrong with the options or the files that they name.
    static Result<std::unique_ptr<FleetRobot>> join(Workbench& bench, const FleetOptions& options,
                                                    Talk talk, Time now);
    ~FleetRobot();

    // Whether it joined for this project, and says of it what its file says now.
    bool is_of(const OpenedProject& project) const;
    void tick(Time now);
    // Why its program does not run; empty: it does, or it is not to. Shown as a fault.
    void does_not_start(const std::string& why) { refused_ = why; }
    // What became of the version that was wanted.
    void deployed(const fleet::Version& version) { member_.deployed(version); }
    // Words of nodes in the project's condition of being well are read from now on, or no longer.
    void read_condition(bool wanted);
    // What a name in that condition stands for now.
    Result<plan::Value> read(const plan::WordFormula::Name& name);
    Time next_tick() const { return std::min(member_.next_tick(), tell_list_.next()); }

private:
    FleetRobot(Workbench& bench, const OpenedProject& project, fleet::MemberOptions options,
               LinkOptions link, Talk talk, Time now);
    void let_plans_ask(talk::MemberOf member);
    fleet::Shown shown() const;
    void perform_all();
    void tell_variables();
    fleet::Answer tell_for_a_minute(const fleet::Command& command);
    void perform(const fleet::Subscribe& one) { link_.subscribe(one.filters); }
    void perform(const fleet::Post& post) { link_.publish(post); }
    void perform(const fleet::EmitOnBus& event);
    void perform(const fleet::Obey& obey);
    void perform(const fleet::StopAlone& stop);
    void perform(const fleet::Fetch& fetch) { talk_.want(fetch.want); }
    void perform(const fleet::Say& said) { talk_.log(said.kind, said.text); }

    Workbench& bench_;
    const Talk talk_;
    const fleet::ProjectPart project_;
    const std::string name_, plan_;  // of the project
    fleet::Member member_;
    fleet::TellList tell_list_;
    std::string refused_;
    bool reads_condition_ = false;
    std::vector<fleet::Tells> condition_words_;          // of nodes
    std::map<fleet::Tells, std::vector<int16_t>> read_;  // of these, as they were told last
    MosquittoLink link_;
    Time now_{};
};

}  // namespace vagus::serve
