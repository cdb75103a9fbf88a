// Log points: what variables hold each time a line of a script or an element of the plan is
// reached, told while a run goes on or is run again, without changing it.
//
//     auto points = TRY(LogPoints::set({{"drive:42", "token, patience"}}, {bus}, show));
//     rerun->listen([&](const plan::TraceEvent& event) { points->see(0, event); });
//     rerun->each_instant([&](Time) { points->instant(); });
//     TRY(rerun->run(tape));
//     TRY(points->check());                       // a place that there is not
//
// Where: NODE:LINE, a line of the file of its script, reached as by a breakpoint there: before its
// first instruction; in a world of several robots the node of each, or of one as ROBOT/NODE:LINE.
// @ACTOR.enter, @ACTOR.leave (ended or interrupted, what was written by that included) and
// @SUPERVISOR.raise of a plan; @PLAN/ACTOR.enter where several plans have the name. Where robots
// have projects of their own, a place is that of each whose project has it; of one as
// ROBOT/NODE:LINE and ROBOT/@ACTOR.enter. Values are separated by commas: of a node, expressions as
// in conditions of breakpoints (debug/condition.hpp) and whole arrays; of a plan, formulas.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "aesl/program.hpp"
#include "base/result.hpp"
#include "debug/condition.hpp"
#include "embed/robots_watcher.hpp"
#include "plan/graph.hpp"
#include "plan/trace.hpp"
#include "run/expression.hpp"
#include "run/traced_variables.hpp"
#include "session/sim_session.hpp"
#include "sim/witness.hpp"

namespace vagus::record {

constexpr size_t kLogPointsMax = 100;
constexpr size_t kLogValuesMax = 16;  // of one point
constexpr size_t kLogListShown = 32;  // words of an array in a line for people

struct LogWish {
    std::string where;
    std::string values;
    // The last part of the path of the script; sentences then count its lines as an editor does
    // that shows one script of several. Empty: whichever, and sentences count lines of the file.
    std::string file = {};
};

struct LoggedValue {
    std::string name;  // as it was asked
    std::string text;  // for people
    std::string json;  // an Error as {"error":"…"}
};

struct LogHit {
    Time at{};
    std::string where;
    std::vector<LoggedValue> values;
};

// "     20.000 s  drive:42  token = 18, patience = 3"
std::string format_hit(const LogHit& hit);
// {"t":20.000000,"at":"drive:42","values":{"token":18,"patience":3}}
std::string format_hit_json(const LogHit& hit);

class LogPoints final : public sim::Witness, public embed::RobotsWatcher {
public:
    // What the points are of: the common bus, then those of robots with projects of their own, in
    // the order of the file. Borrowed; nullptr: none.
    struct Bus {
        session::SimSession* session = nullptr;
        const plan::Graph* graph = nullptr;
        std::string robot = {};  // whose project it is; empty: the common one
        uint32_t number = 0;     // of that robot
    };
    using Told = std::function<void(const LogHit&)>;

    // Watches the world from now on. The Error says what is not there, and what there is: of
    // elements and, where all scripts have their nodes, of lines and variables; else check() does.
    static Result<std::unique_ptr<LogPoints>> set(const std::vector<LogWish>& wishes,
                                                  std::vector<Bus> buses, Told told);
    ~LogPoints() override;

    // Of the trace of the plan on that bus, in its order.
    void see(size_t bus, const plan::TraceEvent& event);
    // The end of an instant.
    void instant() { tell_waiting(); }
    // Nothing is told any more: what follows belongs to the end of the run alone.
    void close();
    // Whether all lines and variables of scripts are there, once their nodes have them.
    Status check() const;
    // By now check() says all there is to say.
    bool settled() const;
    // Where nothing has come so far.
    std::vector<std::string> not_reached() const;

    // ---- sim::Witness ----
    void executes(const sim::WitnessedNode& node, uint16_t pc) override;
    // ---- embed::RobotsWatcher ----
    void line(size_t robot, const plan::TraceEvent& event) override { see(robot + 1, event); }

private:
    struct OfNode {
        size_t number = 0;  // of the wish
        LogWish wish;
        std::string node;
        int line = 0;
        std::vector<std::string> values;
    };
    struct Shown {  // one value of a point
        std::string name;
        std::optional<aesl::VariablePlace> list;  // a whole array
        std::optional<debug::Condition> expression;
    };
    struct Point {
        size_t wish = 0;  // in of_nodes_
        uint16_t pc = 0;
        std::string where;
        std::vector<Shown> values;
    };
    struct Program {  // that runs on a node, with its points
        const aesl::Program* known = nullptr;
        std::vector<bool> here;  // by pc: there is one
        std::vector<Point> points;
    };
    enum class When : uint8_t { Enter, Leave, Raise };
    struct OfElement {
        size_t number = 0;  // of the wish
        LogWish wish;
        size_t bus = 0;
        std::string where;  // as hits tell it
        When when = When::Enter;
        std::string plan;  // its file
        std::string element;
        std::vector<std::pair<std::string, run::Expression>> values;
    };
    struct Waiting {  // for what is written by what was told
        OfElement* point = nullptr;
        Time at{};
        int level = 0;
    };

    LogPoints(std::vector<Bus> buses, Told told);
    bool is_fleet() const { return buses_.size() > 1; }
    session::SimSession* world_session() const { return buses_.front().session; }
    Status add(size_t number, const LogWish& wish);
    Status add_element(size_t number, const LogWish& wish);
    Status check_robot(const LogWish& wish, const std::string& robot) const;
    Result<OfElement> element(const LogWish& wish, std::string_view place, size_t bus) const;
    Result<const plan::GraphPlan*> plan_with(const OfElement& point,
                                             const std::string& of_plan) const;
    static Result<run::Expression> formula(const LogWish& wish, const std::string& text,
                                           const plan::GraphPlan& plan);
    std::string label_of(const Bus& bus, const session::NodeState& node) const;
    Status check(const OfNode& wish) const;
    Result<bool> has_place(const OfNode& wish, const Bus& bus,
                           std::vector<std::string>& known) const;
    Result<Point> place(const OfNode& wish, const Bus& bus, const session::NodeState& node,
                        const aesl::Program& program) const;
    Result<Shown> show(const OfNode& wish, const Bus& bus, const std::string& text,
                       const aesl::Program& program) const;
    void learn(Program& program, const sim::WitnessedNode& node, const aesl::Program* now) const;
    void tell(const Point& point, const sim::WitnessedNode& node);
    void tell(OfElement& point, Time at, int level);
    template <typename Is>
    void tell_waiting(const Is& is);
    void tell_waiting();
    const Bus& bus_of(const sim::WitnessedNode& node) const {
        return buses_[bus_of_robot_[node.robot]];
    }

    std::vector<Bus> buses_;
    std::vector<size_t> bus_of_robot_;  // by its number
    Told told_;
    bool watching_ = false;
    std::vector<std::string> wishes_;  // where
    std::vector<uint64_t> hits_;       // of each
    std::vector<OfNode> of_nodes_;
    std::vector<std::unique_ptr<OfElement>> of_elements_;
    std::unordered_map<uint64_t, Program> programs_;              // by robot and node
    std::vector<std::optional<run::TracedVariables>> variables_;  // by bus
    std::vector<Waiting> waiting_;
};

// Whether all that log points name is there: asked once, as soon as it can be known.
class LogPlaces {
public:
    // Borrowed. `then` comes behind a check that finds all, and may find something else missing.
    explicit LogPlaces(const LogPoints& points, std::function<Status()> then = {})
        : points_(points), then_(std::move(then)) {}

    // At each instant.
    void look() {
        if (!known_ && points_.settled()) (void)ask();
    }
    // Now, if it was not before.
    const Status& ask() {
        if (!known_) {
            known_ = points_.check();
            if (known_->ok() && then_) known_ = then_();
        }
        return *known_;
    }
    // So far.
    bool are_missing() const { return known_ && !known_->ok(); }

private:
    const LogPoints& points_;
    std::function<Status()> then_;
    std::optional<Status> known_;
};

}  // namespace vagus::record
