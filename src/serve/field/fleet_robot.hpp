// A robot that serves itself, in a fleet: the member (fleet/member.hpp), its link to the broker,
// and the workbench that obeys. All of it is on the thread of the loop, which waits for none of it.
//
//     const auto robot = TRY(FleetRobot::join(bench, options, talk, now));
//     robot->tick(now);
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "base/result.hpp"
#include "fleet/member.hpp"
#include "serve/broker/fleet_options.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

class FleetRobot {
public:
    struct Talk {
        std::function<void()> wake;  // from another thread
        std::function<void(const std::string& kind, const std::string& text)> log;
        std::string studio;  // address of the robot's pages
    };
    // The Error says what is wrong with the options or the files that they name.
    static Result<std::unique_ptr<FleetRobot>> join(Workbench& bench, const FleetOptions& options,
                                                    Talk talk, Time now);
    ~FleetRobot();

    // Whether it joined for this project, as its file says now.
    bool is_of(const OpenedProject& project) const;
    void tick(Time now);
    Time next_tick() const { return member_.next_tick(); }

private:
    FleetRobot(Workbench& bench, fleet::MemberOptions options, LinkOptions link, Talk talk,
               Time now);
    void perform_all();
    void perform(const fleet::Subscribe& one) { link_.subscribe(one.filters); }
    void perform(const fleet::Post& post) { link_.publish(post); }
    void perform(const fleet::EmitOnBus& event);
    void perform(const fleet::Obey& obey);
    void perform(const fleet::StopAlone& stop);
    void perform(const fleet::Say& said) { talk_.log(said.kind, said.text); }

    Workbench& bench_;
    const Talk talk_;
    const fleet::ProjectPart project_;
    fleet::Member member_;
    MosquittoLink link_;
    Time now_{};
};

}  // namespace vagus::serve
