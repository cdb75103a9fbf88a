// Exploration against a slow and obvious search: the machine that runs plans, in every way that it
// can be driven. A situation is reached by running its whole path again from the start, since a
// machine cannot be copied; nothing here knows how explore.cpp works.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "base/rng.hpp"
#include "plan/explore.hpp"
#include "plan/machine.hpp"
#include "plan/test_explore.hpp"

namespace vagus::plan {
namespace {

// ---- random plans ----

class PlanMaker {
public:
    explicit PlanMaker(uint64_t seed) : random_(seed) {}

    ExploreFiles files() {
        return {{"main.plan.json", plan("Main", 0)},
                {"sub1.plan.json", plan("Sub1", 1)},
                {"sub2.plan.json", plan("Sub2", 2)}};
    }

private:
    size_t below(uint64_t bound) { return static_cast<size_t>(random_.below(bound)); }

    std::string plan(const std::string& name, int depth) {
        depth_ = depth;
        actors_ = 1 + below(4);
        supervisors_ = 0;
        std::string actors;
        for (size_t i = 0; i < actors_; ++i) {
            actors += fmt::format("{}\"a{}\": {}", i == 0 ? "" : ",\n", i, actor());
        }
        return plan_text({.name = name,
                          .configuration = variable("v") + ", " + variable("w"),
                          .globals = supervisors(2),
                          .actors = actors});
    }

    std::string variable(const std::string& name) {
        const std::string initial = below(2) == 0 ? ", \"initial\": 0" : "";
        const std::string access = depth_ > 0 && below(2) == 0 ? ", \"access\": \"shared\"" : "";
        return fmt::format(R"("{}": {{"type": "int"{}{}}})", name, initial, access);
    }

    std::string target(bool event) {
        const size_t pick = below(event ? 9 : 7);
        if (pick == 0) return "@terminate";
        if (pick > 6) return "@ignore";
        return fmt::format("a{}", below(actors_));
    }

    std::string number() {
        const char* const numbers[] = {"0", "1", "v", "w"};
        return numbers[below(4)];
    }

    std::string data() {
        return fmt::format(R"("in": {{"n": "{}"}}, "out": {{{}}})", number(),
                           below(2) == 0 ? "" : fmt::format(R"("r": "{}")", "vw"[below(2)]));
    }

    std::string supervisors(size_t most) {
        std::string list;
        for (size_t i = below(most + 1); i > 0; --i) {
            list += fmt::format("{}\"s{}\": {{", list.empty() ? "" : ", ", supervisors_++);
            if (below(2) == 0) {
                list += fmt::format(
                    R"("template": "See", {}, "events": {{"Seen": "{}", "Lost": "{}"}}}})", data(),
                    target(true), target(true));
            } else {
                list += fmt::format(R"("template": "Hear", {}, "events": {{"Heard": "{}"}}}})",
                                    data(), target(true));
            }
        }
        return list;
    }

    std::string actor() {
        switch (below(depth_ < 2 ? 7 : 5)) {
            case 0:
            case 1:
                return fmt::format(R"({{"template": "Go", {}, "states": {{"Done": "{}",
                    "Blocked": "{}"}}, "supervisors": {{{}}}}})",
                                   data(), target(false), target(false), supervisors(2));
            case 2:
            case 3:
                return fmt::format(R"({{"template": "Step", {}, "states": {{"Yes": "{}",
                    "No": "{}"}}}})",
                                   data(), target(false), target(false));
            case 4:
                return fmt::format(R"({{"template": "{}", "supervisors": {{{}}}}})",
                                   below(2) == 0 ? "Sit" : "Break", supervisors(1));
            default:
                return fmt::format(R"({{"plan": "sub{}.plan.json", "states": {{"OK": "{}",
                    "Interrupted": "{}", "Error": "{}"}}, "supervisors": {{{}}}}})",
                                   depth_ + 1, target(false), target(false), target(false),
                                   supervisors(1));
        }
    }

    SplitMix64 random_;
    int depth_ = 0;
    size_t actors_ = 0;
    int supervisors_ = 0;
};

// ---- the machine, driven ----

struct Act {
    enum class Kind : uint8_t { Begin, End, SubPlanOver, Raise, Fail, FailWatch };
    Kind kind;
    WatchPlace place = {};
    int outcome = 0;
};

class Driven {
public:
    Driven(const Checked& checked, const Graph& graph) : checked_(checked), machine_(graph) {
        machine_.start({}, Time{0});
        settle();
    }

    void act(const Act& one) {
        const Time now{0};
        const int top = machine_.depth() - 1;
        const Given given{one.outcome, {Value(int64_t{1})}};
        switch (one.kind) {
            case Act::Kind::Begin:
                machine_.begin(machine_.activation_at(top), now);
                break;
            case Act::Kind::End:
                machine_.end(machine_.activation_at(top), given, now);
                break;
            case Act::Kind::SubPlanOver:
                machine_.end_sub_plan(machine_.activation_at(top), now);
                break;
            case Act::Kind::Raise:
                machine_.raise(machine_.watch_at(one.place), given, now);
                break;
            case Act::Kind::Fail:
                machine_.fail(machine_.activation_at(top), "as it was told to", now);
                break;
            case Act::Kind::FailWatch:
                machine_.fail_watch(machine_.watch_at(one.place), "as it was told to", now);
                break;
        }
        if (!machine_.over() && machine_.phase_at(machine_.depth() - 1) == Phase::Stopping) {
            machine_.stopped(machine_.activation_at(machine_.depth() - 1), now);
        }
        settle();
    }

    const Machine& machine() const { return machine_; }
    bool over() const { return machine_.over(); }
    int top() const { return machine_.depth() - 1; }
    const GraphActor& active() const { return *machine_.actor_at(top()); }

    // All that watch, in the order of P21.
    std::vector<WatchPlace> watching() const {
        std::vector<WatchPlace> places;
        for (int level = 0; level <= top(); ++level) {
            for (const bool global : {true, false}) {
                const size_t count = global ? machine_.plan_at(level).globals.size()
                                            : machine_.actor_at(level)->supervisors.size();
                for (int i = 0; i < static_cast<int>(count); ++i) {
                    if (machine_.watch_at({level, global, i}) != 0) {
                        places.push_back({level, global, i});
                    }
                }
            }
        }
        return places;
    }
    const GraphSupervisor& supervisor(const WatchPlace& place) const {
        const auto& among = place.global ? machine_.plan_at(place.level).globals
                                         : machine_.actor_at(place.level)->supervisors;
        return among[static_cast<size_t>(place.index)];
    }

    // What decides all that follows, but variables. `merged`: an actor that has begun and one that
    // has not are the same.
    std::string control(bool merged) const {
        if (over()) return fmt::format("over {}", name_of(machine_.result()));
        std::string text;
        for (int level = 0; level <= top(); ++level) {
            text += "/" + machine_.actor_at(level)->name;
            for (size_t i = 0; i < machine_.plan_at(level).globals.size(); ++i) {
                const bool watches = machine_.watch_at({level, true, static_cast<int>(i)}) != 0;
                text += watches ? "+" : "-";
            }
        }
        if (machine_.phase_at(top()) == Phase::SubEnded) return text + " ended " + ended_;
        const bool began = machine_.phase_at(top()) == Phase::Running;
        return text + (merged ? "" : began ? " runs" : " is to begin");
    }
    const std::set<std::string>& written() const { return written_; }

    // The variables, as "PLAN VARIABLE", that something reads here before anything wrote them.
    std::set<std::string> unwritten_reads() const {
        std::set<std::string> found;
        if (over() || machine_.phase_at(top()) != Phase::Pending) return found;
        const Plan& plan = plan_named(machine_.plan_at(top()).name);
        const auto look = [this, &found](const std::vector<Entry>& in) {
            for (const Entry& entry : in) {
                for (const std::string& name : entry.formula->names()) look_at(name, found);
            }
        };
        for (const WatchPlace& place : watching()) {
            if (place.level != top()) continue;
            const auto index = static_cast<size_t>(place.index);
            look(place.global ? plan.globals[index].in
                              : actor_in(plan, active().name).supervisors[index].in);
        }
        look(actor_in(plan, active().name).in);
        return found;
    }

private:
    // Takes note of what has been written since.
    void settle() {
        machine_.take_commands();
        for (const TraceEvent& event : machine_.take_trace()) {
            if (std::holds_alternative<PlanStarted>(event.what)) {
                std::erase_if(written_, [&event](const std::string& cell) {
                    return cell.starts_with(event.plan + " ");
                });
            } else if (const auto* end = std::get_if<PlanEnded>(&event.what)) {
                ended_ = name_of(end->result);
            } else if (const auto* write = std::get_if<VariableWritten>(&event.what)) {
                if (write->by == "initial") continue;
                const std::string cell = cell_of(event.plan, std::string(write->variable));
                if (!has_initial(cell)) written_.insert(cell);
            }
        }
    }

    const Plan& plan_named(const std::string& name) const {
        for (const Plan& plan : checked_.plans) {
            if (plan.name == name) return plan;
        }
        throw std::logic_error("no plan " + name);
    }
    static const Actor& actor_in(const Plan& plan, const std::string& name) {
        return plan.actors[static_cast<size_t>(find_actor(plan, name))];
    }
    // The plan at this path may be over already: how deep it was tells its name here.
    static std::string plan_at(const std::string& path) {
        const auto depth = std::count(path.begin(), path.end(), '/');
        return depth == 0 ? "Main" : fmt::format("Sub{}", depth);
    }
    const Variable& variable_at(const std::string& path, const std::string& name) const {
        const Plan& plan = plan_named(plan_at(path));
        return plan.configuration[static_cast<size_t>(find_variable(plan, name))];
    }
    // "PATH VARIABLE" of the plan that it belongs to.
    std::string cell_of(std::string path, const std::string& name) const {
        while (path != "Main" && variable_at(path, name).access == Access::Shared) {
            path.resize(path.rfind('/'));
        }
        return path + " " + name;
    }
    bool has_initial(const std::string& cell) const {
        const size_t space = cell.find(' ');
        return variable_at(cell.substr(0, space), cell.substr(space + 1)).initial.has_value();
    }

    void look_at(const std::string& name, std::set<std::string>& found) const {
        const std::string cell = cell_of(machine_.path_at(top()), name);
        if (written_.contains(cell) || has_initial(cell)) return;
        found.insert(plan_at(cell.substr(0, cell.find(' '))) + " " + name);
    }

    const Checked& checked_;
    Machine machine_;
    std::string ended_;
    std::set<std::string> written_;
};

// ---- the search ----

struct Edge {
    size_t to = 0;
    bool timeless = false;
    bool is_way = true;
};

struct State {
    std::vector<Act> path;
    int distance = 0;
    std::string control;    // merged
    std::string innermost;  // "PLAN ACTOR"; empty: over
    std::set<std::string> unwritten;
    std::vector<Edge> edges;
};

class Search {
public:
    Search(const Checked& checked, const Graph& graph) : checked_(checked), graph_(graph) {
        meet({}, 0);
        while (!open_.empty()) {
            const size_t next = open_.begin()->second;
            open_.erase(open_.begin());
            if (!left_[next]) leave(next);
        }
    }

    const std::vector<State>& states() const { return states_; }
    const std::set<std::string>& entered() const { return entered_; }  // plans
    const std::set<std::string>& reached() const { return reached_; }  // "PLAN ACTOR"
    const std::set<std::string>& won() const { return won_; }          // "PLAN SUPERVISOR"

    // Whether one can be reached from the other along the edges that are asked for.
    template <typename Wanted>
    std::vector<bool> reachable(size_t from, Wanted wanted) const {
        std::vector<bool> met(states_.size());
        std::vector<size_t> open = {from};
        while (!open.empty()) {
            const size_t at = open.back();
            open.pop_back();
            for (const Edge& edge : states_[at].edges) {
                if (!wanted(edge) || met[edge.to]) continue;
                met[edge.to] = true;
                open.push_back(edge.to);
            }
        }
        return met;
    }

private:
    size_t meet(const std::vector<Act>& path, int distance) {
        Driven driven(checked_, graph_);
        for (const Act& act : path) driven.act(act);
        std::string key = driven.control(false);
        for (const std::string& cell : driven.written()) key += "," + cell;
        const auto [at, is_new] = index_.emplace(key, states_.size());
        if (is_new) {
            states_.push_back({});
            left_.push_back(0);
            State& state = states_.back();
            state.control = driven.control(true);
            state.unwritten = driven.unwritten_reads();
            if (!driven.over()) note(driven);
        }
        State& state = states_[at->second];
        if (is_new || distance < state.distance) {
            state.path = path;
            state.distance = distance;
            open_.emplace(distance, at->second);
        }
        return at->second;
    }

    void note(const Driven& driven) {
        const std::string& plan = driven.machine().plan_at(driven.top()).name;
        states_.back().innermost = plan + " " + driven.active().name;
        entered_.insert(plan);
        reached_.insert(states_.back().innermost);
    }

    void leave(size_t from) {
        left_[from] = 1;
        Driven driven(checked_, graph_);
        for (const Act& act : states_[from].path) driven.act(act);
        if (driven.over()) return;
        const GraphActor& actor = driven.active();
        const bool computes = actor.of && actor.of->kind == Kind::Computation;
        switch (driven.machine().phase_at(driven.top())) {
            case Phase::Pending:
                go(from, {Act::Kind::Begin}, {.timeless = true});
                break;
            case Phase::Running:
                for (int state = 0; state < static_cast<int>(actor.states.size()); ++state) {
                    go(from, {Act::Kind::End, {}, state}, {.timeless = computes});
                }
                go(from, {Act::Kind::Fail}, {.is_way = actor.of->only_fails});
                break;
            case Phase::SubEnded:
                go(from, {Act::Kind::SubPlanOver}, {.timeless = true});
                break;
            case Phase::Stopping:
            case Phase::None:
                throw std::logic_error("not settled");
        }
        for (const WatchPlace& place : driven.watching()) leave_by(from, driven, place);
    }

    void leave_by(size_t from, const Driven& driven, const WatchPlace& place) {
        go(from, {Act::Kind::FailWatch, place}, {.is_way = false});
        const GraphSupervisor& by = driven.supervisor(place);
        for (int event = 0; event < static_cast<int>(by.targets.size()); ++event) {
            if (by.targets[static_cast<size_t>(event)] == kTargetIgnore) continue;
            if (!comes_first(from, place, event)) continue;
            won_.insert(driven.machine().plan_at(place.level).name + " " + by.name);
            go(from, {Act::Kind::Raise, place, event}, {});
        }
    }

    // All that look at the same at this instant raise, in their order: is this one still there
    // when it is its turn?
    bool comes_first(size_t from, const WatchPlace& place, int event) {
        Driven driven(checked_, graph_);
        for (const Act& act : states_[from].path) driven.act(act);
        const WatchId watch = driven.machine().watch_at(place);
        std::vector<std::pair<WatchPlace, WatchId>> alike;
        for (const WatchPlace& other : driven.watching()) {
            const WatchId id = driven.machine().watch_at(other);
            if (id == watch) break;
            if (look_alike(driven, place, other)) alike.emplace_back(other, id);
        }
        for (const auto& [other, id] : alike) {
            if (driven.over() || !driven.machine().watching(id)) continue;
            driven.act({Act::Kind::Raise, other, event});
        }
        return !driven.over() && driven.machine().watching(watch);
    }

    static bool look_alike(const Driven& driven, const WatchPlace& a, const WatchPlace& b) {
        const GraphSupervisor& one = driven.supervisor(a);
        const GraphSupervisor& other = driven.supervisor(b);
        if (one.of != other.of) return false;
        // Checks of a period come at the same instants if both have started together.
        const bool together = a.level == b.level && !a.global && !b.global;
        if (one.period_us != 0 && !together) return false;
        for (size_t i = 0; i < one.inputs.size(); ++i) {
            const GraphInput& x = one.inputs[i];
            const GraphInput& y = other.inputs[i];
            if (x.formula.has_value() != y.formula.has_value()) return false;
            if (x.formula && !(together && x.slots == y.slots)) return false;
            if (!x.formula && x.value != y.value) return false;
        }
        return true;
    }

    void go(size_t from, const Act& act, Edge edge) {
        std::vector<Act> path = states_[from].path;
        path.push_back(act);
        // That the code of an actor begins is no step; that a sub-plan begins is one.
        Driven driven(checked_, graph_);
        for (const Act& one : states_[from].path) driven.act(one);
        const bool is_code = act.kind == Act::Kind::Begin && driven.active().of;
        edge.to = meet(path, states_[from].distance + (is_code ? 0 : 1));
        states_[from].edges.push_back(edge);
    }

    const Checked& checked_;
    const Graph& graph_;
    std::map<std::string, size_t> index_;
    std::vector<State> states_;
    std::vector<char> left_;
    std::set<std::pair<int, size_t>> open_;  // the nearest first
    std::set<std::string> entered_;
    std::set<std::string> reached_;
    std::set<std::string> won_;
};

// ---- the comparison ----

std::set<std::string> elements(const Exploration& found, ExploreKind kind) {
    std::set<std::string> names;
    for (const ExploreFinding& finding : found.findings) {
        if (finding.kind == kind) names.insert(finding.plan + " " + finding.element);
    }
    return names;
}

// The fewest steps of a finding of this kind; -1: there is none.
int fewest(const Exploration& found, ExploreKind kind) {
    int least = -1;
    for (const ExploreFinding& finding : found.findings) {
        const int steps = static_cast<int>(finding.path.size());
        if (finding.kind == kind && (least < 0 || steps < least)) least = steps;
    }
    return least;
}

struct Expected {
    std::set<std::string> controls;  // without the ends
    std::set<std::string> trapped;
    std::set<std::string> on_loops;  // "PLAN ACTOR"
    std::set<std::string> unwritten;
    int to_trap = -1;  // fewest steps
    int to_unwritten = -1;
};

Expected expect(const Search& search) {
    Expected expected;
    const auto nearer = [](int& least, int distance) {
        if (least < 0 || distance < least) least = distance;
    };
    for (size_t i = 0; i < search.states().size(); ++i) {
        const State& state = search.states()[i];
        if (state.innermost.empty()) continue;
        expected.controls.insert(state.control);
        bool ends = false;
        const auto met = search.reachable(i, [](const Edge& edge) { return edge.is_way; });
        for (size_t j = 0; j < met.size(); ++j) {
            ends = ends || (met[j] && search.states()[j].innermost.empty());
        }
        if (!ends) {
            expected.trapped.insert(state.control);
            nearer(expected.to_trap, state.distance);
        }
        if (search.reachable(i, [](const Edge& edge) { return edge.timeless; })[i]) {
            expected.on_loops.insert(state.innermost);
        }
        for (const std::string& variable : state.unwritten) {
            expected.unwritten.insert(variable);
            nearer(expected.to_unwritten, state.distance);
        }
    }
    return expected;
}

// In plans that can be entered: actors that were not reached; supervisors of those that were, and
// global ones, that never won.
std::set<std::string> never_reached(const Checked& checked, const Search& search) {
    std::set<std::string> names;
    for (const Plan& plan : checked.plans) {
        if (!search.entered().contains(plan.name)) continue;
        for (const Actor& actor : plan.actors) {
            const std::string name = plan.name + " " + actor.name;
            if (!search.reached().contains(name)) names.insert(name);
        }
    }
    return names;
}

std::set<std::string> never_won(const Checked& checked, const Search& search) {
    std::set<std::string> names;
    for (const Plan& plan : checked.plans) {
        if (!search.entered().contains(plan.name)) continue;
        const auto add = [&plan, &search, &names](const std::vector<Supervisor>& supervisors) {
            for (const Supervisor& one : supervisors) {
                const std::string name = plan.name + " " + one.name;
                if (!search.won().contains(name)) names.insert(name);
            }
        };
        add(plan.globals);
        for (const Actor& actor : plan.actors) {
            if (search.reached().contains(plan.name + " " + actor.name)) add(actor.supervisors);
        }
    }
    return names;
}

TEST(ExploreRandom, TwoHundredPlansAreAsASlowSearchFindsThem) {
    size_t found_of[6] = {};
    size_t situations = 0;
    size_t compared = 0;
    for (uint64_t seed = 1; compared < 200; ++seed) {
        const ExploreFiles files = PlanMaker(seed).files();
        SCOPED_TRACE(fmt::format("seed {}\n{}\n{}\n{}", seed, files.at("main.plan.json"),
                                 files.at("sub1.plan.json"), files.at("sub2.plan.json")));
        const Checked checked = checked_plans(files);
        const Graph graph = make_graph(checked);
        const Exploration found = explore(checked.plans, graph);
        // In a large one the slow search takes minutes.
        if (found.situations > 40) continue;
        ++compared;
        const Search search(checked, graph);
        const Expected expected = expect(search);
        EXPECT_TRUE(found.complete);
        EXPECT_EQ(found.situations, expected.controls.size());
        EXPECT_EQ(found.trapped, expected.trapped.size());
        EXPECT_EQ(elements(found, ExploreKind::Unreached), never_reached(checked, search));
        EXPECT_EQ(elements(found, ExploreKind::NeverWins), never_won(checked, search));
        EXPECT_EQ(elements(found, ExploreKind::Unwritten), expected.unwritten);
        EXPECT_EQ(fewest(found, ExploreKind::NoEnd), expected.to_trap);
        EXPECT_EQ(fewest(found, ExploreKind::Unwritten), expected.to_unwritten);
        const auto loops = elements(found, ExploreKind::NoTime);
        EXPECT_EQ(loops.empty(), expected.on_loops.empty());
        EXPECT_TRUE(std::includes(expected.on_loops.begin(), expected.on_loops.end(), loops.begin(),
                                  loops.end()));
        if (testing::Test::HasFailure()) return;
        situations += found.situations;
        for (const ExploreFinding& finding : found.findings) {
            ++found_of[static_cast<size_t>(finding.kind)];
        }
    }
    // Nothing was compared with nothing: all kinds but calls of each other are there.
    for (size_t kind = 0; kind < 5; ++kind) EXPECT_GT(found_of[kind], 10u) << kind;
    EXPECT_GT(situations, 1500u);
}

}  // namespace
}  // namespace vagus::plan
