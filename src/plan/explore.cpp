#include "plan/explore.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <tuple>

#include "plan/explore_walk.hpp"

namespace vagus::plan {

namespace {

// An actor of a plan file, in whichever instance.
struct ActorPlace {
    int plan = 0;
    int actor = 0;
    friend auto operator<=>(const ActorPlace&, const ActorPlace&) = default;
};

bool is_event(WalkKind kind) {
    return kind == WalkKind::OwnEvent || kind == WalkKind::GlobalEvent;
}

ActorPlace innermost(const Stack& stack) {
    return {stack.back().plan, stack.back().actor};
}

class Finder {
public:
    explicit Finder(const Walk& walk) : walk_(walk) {}

    Exploration find(const ExploreOptions& options) {
        found_.depth = options.depth;
        found_.complete = walk_.complete();
        found_.skipped = walk_.skipped();
        note_all();
        if (walk_.complete()) {
            find_unreached();
            find_no_end();
        }
        find_no_time();
        if (walk_.complete()) find_never_wins();
        find_unwritten();
        find_endless_calls();
        sort();
        return std::move(found_);
    }

private:
    // ---- what was met ----

    void note_all() {
        const size_t plans = walk_.graph().plans.size();
        entered_.resize(plans);
        reached_.resize(plans);
        for (size_t i = 0; i < plans; ++i) {
            reached_[i].resize(walk_.graph().plans[i].actors.size());
        }
        for (SituationId i = 0; i < walk_.count(); ++i) {
            if (walk_.is_over(i)) continue;
            ++found_.situations;
            const Stack stack = walk_.stack(i);
            const ActorPlace at = innermost(stack);
            entered_[static_cast<size_t>(at.plan)] = true;
            reached_[static_cast<size_t>(at.plan)][static_cast<size_t>(at.actor)] = true;
            for (size_t s = walk_.first_step(i); s < walk_.last_step(i); ++s) {
                const WalkStep& step = walk_.steps()[s];
                if (is_event(step.kind)) won_.insert(&walk_.supervisor(stack, step));
            }
        }
    }

    const Plan& plan(int index) const { return walk_.plans()[static_cast<size_t>(index)]; }
    const GraphPlan& made(int index) const {
        return walk_.graph().plans[static_cast<size_t>(index)];
    }
    const Actor& actor(ActorPlace place) const {
        return plan(place.plan).actors[static_cast<size_t>(place.actor)];
    }
    bool is_reached(ActorPlace place) const {
        return reached_[static_cast<size_t>(place.plan)][static_cast<size_t>(place.actor)];
    }

    struct Element {
        const Plan& plan;
        const std::string& name;
        Place at;
    };
    Element element_of(ActorPlace place) const {
        return {plan(place.plan), actor(place).name, actor(place).line};
    }

    void say(ExploreKind kind, const Element& element, std::string message,
             const std::vector<size_t>& way) {
        ExploreFinding finding{.kind = kind,
                               .file = element.plan.file,
                               .plan = element.plan.name,
                               .element = element.name,
                               .at = element.at,
                               .message = std::move(message),
                               .path = {}};
        for (const size_t step : way) {
            finding.path.push_back(walk_.in_words(walk_.steps()[step]));
        }
        found_.findings.push_back(std::move(finding));
    }

    // By kind, then as they are in the files, the outermost's first.
    void sort() {
        const auto file_rank = [this](const std::string& file) {
            const auto& plans = walk_.plans();
            return std::find_if(plans.begin(), plans.end(),
                                [&file](const Plan& one) { return one.file == file; }) -
                   plans.begin();
        };
        std::stable_sort(found_.findings.begin(), found_.findings.end(),
                         [&file_rank](const ExploreFinding& a, const ExploreFinding& b) {
                             const auto of_a = std::tuple(a.kind, file_rank(a.file), a.at.line);
                             return of_a < std::tuple(b.kind, file_rank(b.file), b.at.line);
                         });
    }

    // "a", "b" and "c"; of many, the first few.
    static std::string list(const std::vector<std::string>& names) {
        constexpr size_t kNamesMax = 6;
        std::string text;
        const size_t shown = std::min(names.size(), kNamesMax);
        for (size_t i = 0; i < shown; ++i) {
            const bool last = i + 1 == names.size();
            text += fmt::format("{}\"{}\"", i == 0 ? "" : last ? " and " : ", ", names[i]);
        }
        if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
        return text;
    }

    std::vector<std::string> names_of(const std::set<ActorPlace>& places) const {
        std::vector<std::string> names;
        for (const ActorPlace place : places) names.push_back(actor(place).name);
        return names;
    }

    // ---- elements that can never be reached ----

    void find_unreached() {
        for (size_t i = 0; i < entered_.size(); ++i) {
            if (!entered_[i]) continue;  // the actors that name it have the finding
            for (size_t a = 0; a < reached_[i].size(); ++a) {
                const ActorPlace place{static_cast<int>(i), static_cast<int>(a)};
                if (!is_reached(place)) say_unreached(place);
            }
        }
    }

    void say_unreached(ActorPlace place) {
        const std::string& name = actor(place).name;
        const std::vector<std::string> sources = sources_of(place);
        const std::string why = sources.empty() ? "no state or event leads to it"
                                                : fmt::format("what leads to it never happens: {}",
                                                              fmt::join(sources, ", "));
        say(ExploreKind::Unreached, element_of(place),
            fmt::format("\"{}\" can never be reached: {}", name, why), {});
    }

    // "drive's Done" for each arrow that leads there.
    std::vector<std::string> sources_of(ActorPlace place) const {
        std::vector<std::string> sources;
        const std::string& name = actor(place).name;
        const auto add = [&sources, &name](const std::string& of, const std::vector<Rule>& rules) {
            for (const Rule& rule : rules) {
                if (rule.target == name && of != name) {
                    sources.push_back(fmt::format("{}'s {}", of, rule.name));
                }
            }
        };
        for (const Supervisor& one : plan(place.plan).globals) add(one.name, one.events);
        for (const Actor& one : plan(place.plan).actors) {
            add(one.name, one.states);
            if (one.name == name) continue;
            for (const Supervisor& own : one.supervisors) add(own.name, own.events);
        }
        return sources;
    }

    // ---- places from which the end cannot be reached ----

    void find_no_end() {
        const std::vector<bool> ends = ending();
        std::vector<bool> told(walk_.count());
        std::set<ActorPlace> told_places;
        for (SituationId i = 0; i < walk_.count(); ++i) {
            if (ends[i]) continue;
            ++found_.trapped;
            if (told[i]) continue;
            const std::set<ActorPlace> places = trap_around(i, ends, told);
            if (std::includes(told_places.begin(), told_places.end(), places.begin(),
                              places.end())) {
                continue;
            }
            told_places.insert(places.begin(), places.end());
            say_no_end(i, places, ends);
        }
    }

    // By situation, whether some way leads to an end of the run.
    std::vector<bool> ending() const {
        std::vector<bool> ends(walk_.count());
        std::vector<std::vector<SituationId>> sources(walk_.count());
        for (const WalkStep& step : walk_.steps()) {
            if (step.is_way) sources[step.to].push_back(step.from);
        }
        std::vector<SituationId> open;
        for (SituationId i = 0; i < walk_.count(); ++i) {
            if (!walk_.is_over(i)) continue;
            ends[i] = true;
            open.push_back(i);
        }
        while (!open.empty()) {
            const SituationId at = open.back();
            open.pop_back();
            for (const SituationId source : sources[at]) {
                if (ends[source]) continue;
                ends[source] = true;
                open.push_back(source);
            }
        }
        return ends;
    }

    // The actors of the situations without an end that can follow from this one.
    std::set<ActorPlace> trap_around(SituationId first, const std::vector<bool>& ends,
                                     std::vector<bool>& told) const {
        std::set<ActorPlace> places;
        std::vector<SituationId> open = {first};
        told[first] = true;
        while (!open.empty()) {
            const SituationId at = open.back();
            open.pop_back();
            places.insert(innermost(walk_.stack(at)));
            for (size_t i = walk_.first_step(at); i < walk_.last_step(at); ++i) {
                const SituationId to = walk_.steps()[i].to;
                if (ends[to] || told[to]) continue;
                told[to] = true;
                open.push_back(to);
            }
        }
        return places;
    }

    // Whether the end can be reached from the same actor in another situation.
    bool ends_elsewhere(ActorPlace place, const std::vector<bool>& ends) const {
        for (SituationId i = 0; i < walk_.count(); ++i) {
            if (!ends[i] || walk_.is_over(i)) continue;
            if (innermost(walk_.stack(i)) == place) return true;
        }
        return false;
    }

    void say_no_end(SituationId situation, std::set<ActorPlace> places,
                    const std::vector<bool>& ends) {
        const ActorPlace here = innermost(walk_.stack(situation));
        const std::string& name = actor(here).name;
        places.erase(here);
        std::string message;
        if (situation == 0) {
            message = "the plan never ends by itself: no way leads to the end from its start";
        } else {
            message = fmt::format("from \"{}\" the end cannot be reached any more", name);
            const StackLevel level = walk_.stack(situation).back();
            if (!level.resting.empty() && ends_elsewhere(here, ends)) {
                message += resting_words(level);
            }
        }
        if (!places.empty()) {
            message += fmt::format("; nor from what follows: {}", list(names_of(places)));
        }
        say(ExploreKind::NoEnd, element_of(here), std::move(message), walk_.way_to(situation));
    }

    // Why it may not be the end that the drawing shows.
    std::string resting_words(const StackLevel& level) const {
        std::vector<std::string> names;
        for (const int i : level.resting) {
            names.push_back(made(level.plan).globals[static_cast<size_t>(i)].name);
        }
        return fmt::format(" while {} {}", list(names), names.size() == 1 ? "rests" : "rest");
    }

    // ---- loops that take no time ----

    void find_no_time() {
        std::set<std::set<ActorPlace>> told;
        for (const TimelessLoop& loop : timeless_loops(walk_)) {
            std::set<ActorPlace> places;
            for (const size_t step : loop.steps) {
                places.insert(innermost(walk_.stack(walk_.steps()[step].from)));
            }
            if (told.insert(places).second) say_no_time(loop);
        }
    }

    void say_no_time(const TimelessLoop& loop) {
        std::vector<std::string> names;
        for (const size_t step : loop.steps) {
            const WalkStep& one = walk_.steps()[step];
            if (one.kind == WalkKind::End) names.push_back(walk_.in_words(one).element);
        }
        std::vector<size_t> way = walk_.way_to(loop.at);
        way.insert(way.end(), loop.steps.begin(), loop.steps.end());
        say(ExploreKind::NoTime, element_of(innermost(walk_.stack(loop.at))),
            fmt::format("{} can follow {} without end and without time: {}", list(names),
                        names.size() == 1 ? "itself" : "each other",
                        loop.leaves ? "only values can end this loop"
                                    : "no state leads out of this loop; lead one to an actor that "
                                      "waits, or to @terminate"),
            way);
    }

    // ---- supervisors that can never win ----

    void find_never_wins() {
        for (int p = 0; p < static_cast<int>(entered_.size()); ++p) {
            if (!entered_[static_cast<size_t>(p)]) continue;
            find_never_wins(plan(p), plan(p).globals, made(p).globals);
            for (int a = 0; a < static_cast<int>(plan(p).actors.size()); ++a) {
                if (!is_reached({p, a})) continue;
                find_never_wins(plan(p), actor({p, a}).supervisors,
                                made(p).actors[static_cast<size_t>(a)].supervisors);
            }
        }
    }

    void find_never_wins(const Plan& plan, const std::vector<Supervisor>& written,
                         const std::vector<GraphSupervisor>& made) {
        for (size_t i = 0; i < made.size(); ++i) {
            if (won_.contains(&made[i])) continue;
            const bool ignored = std::all_of(made[i].targets.begin(), made[i].targets.end(),
                                             [](int target) { return target == kTargetIgnore; });
            say(ExploreKind::NeverWins, {plan, written[i].name, written[i].line},
                fmt::format("\"{}\" can never win: {}", written[i].name,
                            ignored ? "each of its events is ignored"
                                    : "whenever it would raise an event, one that ranks before it "
                                      "and looks at the same has raised its own"),
                {});
        }
    }

    // ---- variables that are read before anything wrote them ----

    void find_unwritten() {
        for (const UnwrittenRead& read : unwritten_reads(walk_, entered_)) {
            const Plan& of = plan(read.plan);
            const Variable& variable = of.configuration[static_cast<size_t>(read.slot)];
            say(ExploreKind::Unwritten, {of, variable.name, variable.line},
                fmt::format("\"{}\" can be read by \"{}\" before anything wrote it; give it an "
                            "initial value",
                            variable.name, read.reader),
                read.way);
        }
    }

    // ---- sub-plans that call each other ----

    void find_endless_calls() {
        std::set<std::set<int>> told;
        for (size_t i = 0; i < walk_.steps().size(); ++i) {
            const WalkStep& step = walk_.steps()[i];
            if (step.kind != WalkKind::Call) continue;
            const Stack inside = walk_.stack(step.to);
            const int called = inside.back().plan;
            const auto first =
                std::find_if(inside.begin(), inside.end() - 1,
                             [called](const StackLevel& level) { return level.plan == called; });
            if (first == inside.end() - 1) continue;
            std::set<int> plans;
            for (auto level = first; level != inside.end(); ++level) plans.insert(level->plan);
            if (told.insert(plans).second) say_endless_calls(i, {first, inside.end()});
        }
    }

    void say_endless_calls(size_t call, const Stack& circle) {
        const WalkStep& step = walk_.steps()[call];
        std::string names;
        for (const StackLevel& level : circle) {
            names += fmt::format("{}{}", names.empty() ? "" : " -> ", plan(level.plan).name);
        }
        std::vector<size_t> way = walk_.way_to(step.from);
        way.push_back(call);
        say(ExploreKind::EndlessCalls, element_of(innermost(walk_.stack(step.from))),
            fmt::format("plans can call each other without end: {}; a call that would be the "
                        "{}th inside another fails",
                        names, kPlanDepthMax + 1),
            way);
    }

    const Walk& walk_;
    Exploration found_;
    std::vector<bool> entered_;               // by plan
    std::vector<std::vector<bool>> reached_;  // by plan and actor
    std::set<const GraphSupervisor*> won_;
};

}  // namespace

Exploration explore(const std::vector<Plan>& plans, const Graph& graph,
                    const ExploreOptions& options) {
    const Walk walk(plans, graph, options);
    return Finder(walk).find(options);
}

}  // namespace vagus::plan
