// A plan that runs as pages see it: the document of the topic plan, made of the lines of the trace.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "plan/trace.hpp"
#include "run/debugger.hpp"
#include "serve/follow/plan_counts.hpp"
#include "serve/follow/plan_outline.hpp"

namespace vagus::serve {

constexpr size_t kStoryKept = 200;      // lines of what happened
constexpr size_t kShownTextMax = 1000;  // bytes of a value or sentence; the rest is left out

class PlanFollower {
public:
    // What the run was made of, the outermost plan first. Owners: all copies of this follower.
    // `doc_of` is the document of a plan's file.
    using Plans = std::shared_ptr<const PlanOutlines>;
    PlanFollower(Plans plans, std::function<std::string(const std::string& file)> doc_of);

    void see(const plan::TraceEvent& event);
    // A new version has taken over (P31): what it was made of.
    void change(Plans plans);
    // A debugger holds the plan there: before an actor that the trace does not know yet.
    void stand_at(const run::Where& where);
    nlohmann::json document(double now, bool paused) const;
    bool over() const { return result_.has_value(); }
    // Supervisors that watch now, of all levels.
    struct Watching {
        std::string path, name;
        bool global = false;
    };
    std::vector<Watching> watching() const;

private:
    struct Level {
        std::string path;
        const PlanOutline* plan = nullptr;
        const PlanOutline::Actor* actor = nullptr;
        uint64_t activation = 0;
        double since = 0;
        nlohmann::json inputs = nlohmann::json::object();
        std::map<std::string, nlohmann::json> values;
        std::map<std::string, int> resting;  // global supervisors
    };

    void enter(Level& level, std::string_view actor, uint64_t activation, double t);
    void happen(double t, const char* kind, const std::string& text);
    Level& level_at(const std::string& path);
    const PlanOutline* plan_inside(const Level* outer) const;
    nlohmann::json level_json(const Level& level) const;

    Plans plans_;
    std::function<std::string(const std::string&)> doc_of_;
    PlanCounts counts_;
    std::vector<Level> levels_;
    std::deque<nlohmann::json> story_;
    uint64_t lines_ = 0;
    std::optional<std::string> result_;
    std::string message_;
};

}  // namespace vagus::serve
