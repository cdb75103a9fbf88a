// What the plan of a robot asks of its fleet, while the robot serves itself: over a link of its own
// beside that of the member, which is in another process. It asks only while the broker says that
// this member has the name; so of two robots of one name the one that stays out takes no tasks.
//
//     const auto fleet = TRY(RunFleet::open(member, order, clock));
//     parts.fleet = fleet.get();
//     if (fleet->turn()) prepared.hear({std::string(toolbox::kFleetNews), {}});
//     for (const auto& told : fleet->take_told()) {
//         teller.tell(talk::ToldFleet{told.name, told.values});
//     }
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "fleet/link.hpp"
#include "serve/talk/orders.hpp"
#include "session/member_fleet.hpp"
#include "toolbox/fleet/fleet.hpp"

namespace vagus::serve {

class RunFleet final : public toolbox::Fleet {
public:
    struct Member {
        std::string fleet = {}, robot = {}, instance = {};
        int64_t epoch = 0;  // of what is asked, unlike that of any other run
    };
    using Clock = std::function<Time()>;

    // The run of that order. The Error says what is wrong with the member's files.
    static Result<std::unique_ptr<RunFleet>> open(const talk::MemberOf& member, uint64_t order,
                                                  Clock clock);
    // Over any link.
    RunFleet(Member member, std::unique_ptr<fleet::Link> link, Clock clock);

    // Hears and sends what there is; often. True: there is news for the plan.
    bool turn();
    using Told = session::MemberFleet::Told;
    std::vector<Told> take_told();

    // ---- toolbox::Fleet, on any thread ----
    uint64_t ask(keeper::Request request) override;
    std::optional<keeper::Over> answer(uint64_t number) override;
    void cancel(uint64_t number) override;
    bool holds(keeper::Term term) const override;
    std::optional<keeper::Shared> shared(const std::string& key) const override;
    std::vector<std::string> online() const override;
    std::string me() const override { return member_.robot; }
    void tell(const std::string& name, std::vector<int16_t> values) override;

private:
    void hear(const fleet::LinkEvent& event);
    void send();

    const Member member_;
    const Clock clock_;
    mutable std::mutex guard_;  // of what follows
    mutable session::MemberFleet fleet_;
    bool has_name_ = false;
    const std::unique_ptr<fleet::Link> link_;
};

}  // namespace vagus::serve
