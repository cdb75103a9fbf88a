#include "run/played_path.hpp"

#include <algorithm>

namespace vagus::run {

using namespace std::chrono_literals;

namespace {

constexpr Duration kBetweenMoves = 1s;
constexpr Duration kLookEvery = 100ms;

int index_of(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

[[noreturn]] void fail_as_told() {
    throw CodeError("it fails here, as the path says");
}

}  // namespace

class PlayedPath::PlayedActor final : public Actor {
public:
    PlayedActor(PlayedPath& path, const plan::GraphActor& of, Who who)
        : path_(path), of_(of), who_(std::move(who)) {}

    void run(ActorContext& context) override {
        const bool waits = of_.of->kind != plan::Kind::Computation;
        if (path_.over() && path_.end_) path_.end_();
        while (waits && !is_turn(context.now())) context.sleep(kLookEvery);
        const Move* const move = path_.turn_of(who_);
        const std::string outcome = move ? move->outcome : of_.states.front();
        if (move) path_.take(context.now());
        if (outcome.empty()) fail_as_told();
        context.end(index_of(of_.states, outcome));
    }

private:
    bool is_turn(Time now) const { return path_.turn_of(who_) && now >= path_.due_; }

    PlayedPath& path_;
    const plan::GraphActor& of_;
    const Who who_;
};

class PlayedPath::PlayedSupervisor final : public Supervisor {
public:
    PlayedSupervisor(PlayedPath& path, const plan::GraphSupervisor& of, Who who, Time started)
        : path_(path), of_(of), who_(std::move(who)), started_(started) {}

    std::optional<plan::Given> check(const Check& check) override {
        const Time now = started_ + check.since_start;
        const Move* const move = path_.turn_of(who_);
        if (!move || now < path_.due_) return std::nullopt;
        const std::string outcome = move->outcome;
        path_.take(now);
        if (outcome.empty()) fail_as_told();
        return plan::Given{plan::find_outcome(*of_.of, outcome), {}};
    }

private:
    PlayedPath& path_;
    const plan::GraphSupervisor& of_;
    const Who who_;
    const Time started_;
};

PlayedPath::PlayedPath(const std::vector<plan::ExploreStep>& path) : due_(kBetweenMoves) {
    for (const plan::ExploreStep& step : path) {
        switch (step.kind) {
            case plan::ExploreStep::Kind::End:
            case plan::ExploreStep::Kind::Event:
            case plan::ExploreStep::Kind::Error:
                moves_.push_back({{step.plan, step.element}, step.outcome});
                break;
            case plan::ExploreStep::Kind::Call:  // these two follow by themselves
            case plan::ExploreStep::Kind::Return:
            case plan::ExploreStep::Kind::Skip:
                break;
        }
    }
}

const PlayedPath::Move* PlayedPath::turn_of(const Who& who) const {
    return !over() && moves_[next_].who == who ? &moves_[next_] : nullptr;
}

void PlayedPath::take(Time now) {
    ++next_;
    due_ = now + kBetweenMoves;
}

std::unique_ptr<Actor> PlayedPath::make_actor(const plan::GraphActor& of, const std::string& path,
                                              Time) {
    return std::make_unique<PlayedActor>(*this, of, Who{path, of.name});
}

std::unique_ptr<Supervisor> PlayedPath::make_supervisor(const plan::GraphSupervisor& of,
                                                        const std::string& path, Time now) {
    return std::make_unique<PlayedSupervisor>(*this, of, Who{path, of.name}, now);
}

}  // namespace vagus::run
