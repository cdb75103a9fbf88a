#include "record/ties.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "record/plan_places.hpp"

namespace vagus::record {

namespace {

// Where that bus is among those of another rerun, which has the same.
size_t place_of(Rerun& rerun, const BusCauses& bus) {
    const std::vector<RunBus> buses = rerun.buses();
    const auto found = std::ranges::find(buses, bus.bus().robot, &RunBus::robot);
    return static_cast<size_t>(found - buses.begin());
}

// Follows a rerun in which the event of one line is passed over.
class Tie final : private embed::RobotsWatcher {
public:
    Tie(Rerun& rerun, const BusCauses& bus, size_t index)
        : rerun_(rerun),
          bus_(place_of(rerun, bus)),
          places_(rerun, rerun.buses()[bus_].plan),
          lines_(bus.lines()),
          index_(index) {
        if (bus_ > 0) {
            rerun.watch_robots(this);
            return;
        }
        rerun.pass_over([this](const run::Raising& raising) { return passes(raising); });
        rerun.listen([this](const plan::TraceEvent& event) { see(event); });
    }
    ~Tie() override { rerun_.watch_robots(nullptr); }

    std::vector<Loser> take() { return std::move(losers_); }

private:
    // ---- embed::RobotsWatcher; the first bus is that of no robot ----
    bool passes_over(size_t robot, const run::Raising& raising) override {
        return robot + 1 == bus_ && passes(raising);
    }
    void line(size_t robot, const plan::TraceEvent& event) override {
        if (robot + 1 == bus_) see(event);
    }

    Time at() const { return lines_[index_].event.at; }
    bool looks() const { return passed_ && !over_; }

    bool passes(const run::Raising& raising) {
        if (!passed_ && seen_ == index_) return passed_ = true;
        if (!looks() || raising.ignored || raising.at != at()) return false;
        if (!was_taken_later(raising)) {
            losers_.push_back({std::string(raising.supervisor), std::string(raising.event), false,
                               places_.element(raising.plan, raising.supervisor)});
        }
        return true;
    }

    void see(const plan::TraceEvent& event) {
        ++seen_;
        const auto* const started = std::get_if<plan::ActorStarted>(&event.what);
        if (!passed_ && started != nullptr) started_.insert(started->activation);
        if (!looks()) return;
        const auto* const ended = std::get_if<plan::ActorEnded>(&event.what);
        if (event.at == at() && ended != nullptr && started_.contains(ended->activation)) {
            losers_.push_back({std::string(ended->actor), std::string(ended->state), true,
                               places_.element(event.plan, ended->actor)});
        }
        // What follows from that is another activation.
        if (event.at > at() || ended != nullptr || started != nullptr) {
            over_ = true;
            rerun_.stop();
        }
    }

    // A global supervisor that was still due: its turn came against the next activation.
    bool was_taken_later(const run::Raising& raising) const {
        for (size_t i = index_ + 1; i < lines_.size() && lines_[i].event.at == at(); ++i) {
            const auto* const raised = std::get_if<plan::EventRaised>(&lines_[i].event.what);
            if (raised != nullptr && raised->supervisor == raising.supervisor &&
                lines_[i].event.plan == raising.plan) {
                return true;
            }
        }
        return false;
    }

    Rerun& rerun_;
    size_t bus_;  // whose plan it is; 0: the common one
    PlanPlaces places_;
    const std::vector<BusCauses::Line>& lines_;
    size_t index_;
    size_t seen_ = 0;  // lines
    bool passed_ = false;
    bool over_ = false;
    std::set<uint64_t> started_;  // activations
    std::vector<Loser> losers_;
};

}  // namespace

Result<std::vector<Loser>> losers(const mcap::Reader& reader, const BusCauses& bus, size_t index) {
    std::unique_ptr<Rerun> rerun = TRY(Rerun::open(reader, {.until = bus.lines()[index].event.at}));
    Tie tie(*rerun, bus, index);
    NullTape tape;
    (void)TRY(rerun->run(tape));
    return tie.take();
}

std::string won_against(const std::vector<Loser>& losers) {
    std::string text = "won against ";
    for (size_t i = 0; i < losers.size(); ++i) {
        const Loser& one = losers[i];
        if (i > 0) text += i + 1 < losers.size() ? ", " : ", and ";
        text += one.actor ? fmt::format("the actor {}, which ended with {}", one.name, one.outcome)
                          : fmt::format("{}, which raised {}", one.name, one.outcome);
    }
    return text + (losers.size() > 1 ? ", all at the same instant" : " at the same instant");
}

}  // namespace vagus::record
