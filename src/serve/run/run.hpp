// The run host as the server holds it: starts it, speaks with it, carries the frames of its bus,
// keeps what it told last for pages, and says what happened when it dies or hangs.
//
//     Run run(desk, tell);
//     run.open({.world = "hall.world.json", .plan = "WallFollow.plan.json"}, now);
//     robot.connect(run, "sim", …);
//     run.tick(now);
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "serve/process.hpp"
#include "serve/robot/carrier.hpp"
#include "serve/studio/desk.hpp"

namespace vagus::serve {

constexpr Duration kHangingAfter = 2s;  // without a word: shown, with a button that ends it
constexpr Duration kSilentAfter = 300ms;
constexpr size_t kTraceKept = 100'000;  // lines of a run's trace

struct RunOrder {
    std::string world;  // paths of this computer
    std::string plan;   // empty: the world alone
    std::vector<std::string> toolboxes;
    nlohmann::json set = nlohmann::json::object();
    std::string from;  // the actor that the plan begins with; empty: its start
    nlohmann::json breakpoints = nlohmann::json::array();  // as PlanBreakpoints::orders()
    std::string robot;
    std::string bus, project;  // the plan on a bus instead of in a world: target and .aesl
    bool keep_poses = false;   // robots stand where they stood before
    bool paused = true;        // at first
};

class Run final : public Carrier {
public:
    using Json = nlohmann::json;
    enum class State { None, Running, Paused, Hanging, Dead };

    // Declares the topics clock, plan, held, scene, poses, rays, picture. It starts `program`.
    Run(Desk& desk, std::string program);

    void on_say(std::function<void(const std::string& kind, const std::string& text)> say) {
        say_ = std::move(say);
    }
    // The document of a file of this computer, for pages.
    void set_doc_of(std::function<std::string(const std::string& file)> doc_of) {
        doc_of_ = std::move(doc_of);
    }
    // A sentence with paths of this computer, for pages.
    void set_short(std::function<std::string(const std::string& text)> shorten) {
        short_ = std::move(shorten);
    }
    // The world stands and its nodes can be talked to.
    void on_opened(std::function<void()> opened) { opened_ = std::move(opened); }
    // It cannot be opened: a sentence, or several lines of the checker.
    void on_failed(std::function<void(const std::string& why)> failed) {
        failed_ = std::move(failed);
    }
    // What the debugger of the plan says of its breakpoints: [{number, hits, set, why}].
    void on_breakpoints(std::function<void(const Json& list)> told) {
        breakpoints_told_ = std::move(told);
    }
    // What it tells for the history: a line of the trace, or records of the world.
    struct Told {
        std::function<void(const std::string& line)> trace = [](auto&) {};
        std::function<void(const std::string& bytes)> records = [](auto&) {};
    };
    void on_told(Told told) { told_ = std::move(told); }
    // Its process has died, whatever ran in it.
    void on_death(std::function<void()> died) { died_ = std::move(died); }
    // Its process has died while a plan ran, or was about to: the plan can put nothing in order.
    void on_plan_died(std::function<void()> died) { plan_died_ = std::move(died); }

    Status open(const RunOrder& order, Time now);
    void close();
    bool is_open() const { return child_.has_value(); }
    // A simulated world stands and can be talked to.
    bool has_world() const { return has_world_ && is_open(); }
    State state() const { return state_; }
    // To be watched for reading; -1 without a host. Another host may have the same number:
    // generation() tells them apart.
    int descriptor();
    uint64_t generation() const { return generation_; }

    void pace(bool paused, double speed);
    void pause() { pace(true, speed_); }
    void go_on() { pace(false, speed_); }
    void step(int milliseconds);
    void set_speed(double speed) { pace(paused_, speed); }
    // Time stands, and nobody waits for it to go on: before the start, after Stop.
    void rest();
    // Ends the process, as for one that hangs.
    void kill();
    double speed() const { return speed_; }
    bool paused() const { return paused_; }
    bool rests() const { return rests_; }
    // The first start of a run: it goes on, unless its plan has come to a breakpoint already, at
    // the instant 0, while its nodes were made ready.
    void begin();
    bool plan_runs() const;
    // It was opened and has not said yet how it is.
    bool plan_begins() const { return is_open() && opens_plan_ && !plan_.contains("state"); }
    // The plan that runs waits for an event of that name.
    bool plan_hears(const std::string& event) const {
        return plan_runs() && hears_.contains(event);
    }
    // What was opened last has a plan.
    bool opens_plan() const { return opens_plan_; }
    // It has not said a word for longer than one that works would.
    bool is_silent() const { return is_open() && now_ > heard_ + kSilentAfter; }
    void tell(const Json& message);  // to the host
    // A hand from above: `done` gets the number of an object that was put, or why it was not done.
    using HandDone = std::function<void(std::optional<uint32_t> number, const std::string& why)>;
    void lend_hand(const Json& order, HandDone done);
    // Writes a variable of the plan; `done` gets why not, or nothing.
    using SetDone = std::function<void(const std::string& why)>;
    void set_variable(int level, const std::string& name, const Json& value, SetDone done);
    // Raises an event of a supervisor that watches, as if it had done so itself.
    void raise(const std::string& supervisor, const std::string& event, const Json& outputs,
               SetDone done);
    // Of the events that wait while the plan stands: "go", "step" or "drop" (PlanHeld).
    void handle_held(const std::string& act, std::optional<uint64_t> number, SetDone done);

    // Plan files have been saved: what the plan that runs is made of is to take over (P31). What
    // came of it is in the document of the plan, and is said.
    void change_plan(const std::vector<std::string>& files);
    // Whether it could take over now, if files had these texts: `done` gets what stands in its way,
    // or nothing if the plan that runs is not made of them.
    using Reasons = std::optional<std::vector<std::string>>;
    void check_change(const std::map<std::string, std::string>& texts,
                      std::function<void(const Reasons& reasons)> done);

    double time() const { return t_; }
    std::optional<double> load() const { return load_; }
    double measured_speed() const { return real_; }
    uint64_t deaths() const { return deaths_; }  // of run hosts
    // Checks of supervisors that began late, in this run.
    uint64_t late_checks() const { return late_checks_; }
    std::string robot_of(uint16_t node) const;
    size_t node_count() const;
    // Sources that the world has loaded into nodes.
    const std::map<uint16_t, std::string>& programs() const { return programs_; }
    const Json& scene() const { return scene_; }
    const std::deque<std::string>& trace() const { return trace_; }

    void tick(Time now);
    Time next_tick() const;

    // ---- Carrier ----
    void send(const wire::Frame& frame) override;
    std::vector<Carried> take() override { return std::exchange(frames_, {}); }
    Connection connection() const override;
    std::string why() const override { return why_; }
    std::vector<LinkView> links() const override;

private:
    using Answer = std::function<void(const Json& told)>;
    void ask(Json order, Answer answer);
    void hear(const Packet& packet);
    void hear_flow(const Packet& packet);
    void hear_json(const Json& told);
    void hear_beginning(const std::string& what, const Json& told);
    void hear_answer(const Json& told);
    void hear_end(const ChildEnd& end);
    std::string last_actor() const;
    void forget_asked(const std::string& why);
    void forget_held();
    Reasons reasons_in(const Json& told) const;
    void keep_change(const std::vector<std::string>& files, const Json& told);
    void declare_topics();
    void show_what_is_watched();
    Json clock_document() const;
    Json plan_document() const;
    std::vector<std::array<double, 3>> poses_now() const;

    Desk& desk_;
    const std::string program_;
    std::function<void(const std::string&, const std::string&)> say_ = [](auto&, auto&) {};
    std::function<std::string(const std::string&)> doc_of_ = [](const std::string& f) { return f; };
    std::function<std::string(const std::string&)> short_ = [](const std::string& t) { return t; };
    std::function<void()> opened_ = [] {};
    std::function<void(const std::string&)> failed_ = [](const std::string&) {};
    std::function<void()> died_ = [] {};
    std::function<void()> plan_died_ = [] {};
    std::function<void(const Json&)> breakpoints_told_ = [](const Json&) {};
    Told told_;
    uint64_t asked_ = 0;
    std::map<uint64_t, Answer> answers_;  // of the host, by number of what was asked
    std::map<uint16_t, std::string> programs_;
    std::set<std::string> hears_;  // events, by the plan
    uint64_t generation_ = 0;
    uint64_t orders_ = 0;
    bool opening_ = false;  // what the host tells is still of the order before
    bool rests_ = true;
    bool opens_plan_ = false;
    bool has_world_ = false;
    uint64_t deaths_ = 0, late_checks_ = 0;

    std::optional<Child> child_;
    State state_ = State::None;
    std::string why_;
    std::vector<Carried> frames_;
    uint64_t frames_in_ = 0, frames_out_ = 0;
    Json scene_ = Json::object();
    Json plan_ = Json::object();
    Json held_;    // events that wait while the plan stands
    Json change_;  // what came of the last save while the plan ran; null: none
    uint64_t changes_ = 0;
    std::deque<std::string> trace_;
    double t_ = 0, real_ = 0, speed_ = 1;
    bool paused_ = true;
    std::optional<double> load_;
    Time heard_{};
    Time now_{};
    Json shown_ = Json::object();
    struct Flow {
        uint64_t number = 0;
        double t = 0;
        std::string bytes;
    };
    Flow poses_, rays_;
    std::map<std::string, Flow> pictures_;  // by robot, of those that somebody watches
    friend struct FlowWatch;
    friend struct PictureWatch;
};

}  // namespace vagus::serve
