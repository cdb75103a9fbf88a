// What the plan of a member of a fleet asks of it (toolbox/fleet/fleet.hpp), over the member's own
// link: the keeper's answers, shared values, who is online. Told the time; pure beside that.
//
//     MemberFleet fleet({.fleet = "lab", .robot = "r1", .epoch = 1});
//     link.subscribe(fleet.filters());                       // at each connection
//     fleet.hear(event, now);                                // each event of the link
//     fleet.tick(now);
//     for (const fleet::Post& post : fleet.take()) link.publish(post);
//     if (fleet.take_news()) wake(plan);                     // kFleetNews
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "fleet/keeper_client.hpp"
#include "fleet/link.hpp"
#include "session/fleet_news.hpp"
#include "toolbox/fleet/fleet.hpp"

namespace vagus::session {

constexpr size_t kToldMax = 64;  // values that wait for the member

class MemberFleet final : public toolbox::Fleet {
public:
    explicit MemberFleet(fleet::KeeperClient::Options options)
        : fleet_(options.fleet), me_(options.robot), client_(std::move(options)) {}

    std::vector<fleet::Filter> filters() const;
    void hear(const fleet::LinkEvent& event, Time now);
    void tick(Time now);
    std::vector<fleet::Post> take() { return client_.take(); }
    bool take_news() { return std::exchange(news_, false); }
    // From now on take_what_is_new() tells what the news are, and each question is told.
    using Asked = std::function<void(uint64_t number, const keeper::Request& request)>;
    void tell_more(Asked asked) { told_of_question_ = std::move(asked); }
    std::vector<FleetNews> take_what_is_new() { return std::exchange(new_, {}); }
    // Values that tell() was given, for the member.
    struct Told {
        std::string name;
        std::vector<int16_t> values;
    };
    std::vector<Told> take_told() { return std::exchange(told_, {}); }

    // ---- toolbox::Fleet ----
    uint64_t ask(keeper::Request request) override;
    std::optional<keeper::Over> answer(uint64_t number) override;
    void cancel(uint64_t number) override { client_.leases().cancel(number); }
    bool holds(keeper::Term term) const override { return client_.leases().holds(term, now_); }
    std::optional<keeper::Shared> shared(const std::string& key) const override;
    std::vector<std::string> online() const override;
    std::string me() const override { return me_; }
    void tell(const std::string& name, std::vector<int16_t> values) override;

private:
    void is_new(FleetNews what) {
        news_ = true;
        if (told_of_question_) new_.push_back(std::move(what));
    }

    const std::string fleet_;
    const std::string me_;
    fleet::KeeperClient client_;
    Time now_{};
    bool news_ = false;
    Asked told_of_question_;
    std::vector<FleetNews> new_;
    std::map<uint64_t, keeper::Over> over_;
    std::map<std::string, keeper::Shared> shared_;
    std::map<std::string, bool> online_;
    std::vector<Told> told_;
};

}  // namespace vagus::session
