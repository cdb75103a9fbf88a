// A recorded real bus as what a plan in virtual time has around it: the plan hears again what it
// heard, at the same times and in the same order among its own decisions (decision 0234). No node
// is there, and what the plan emits goes nowhere.
//
//     auto past = TRY(PastBus::read(reader, project));
//     options.surroundings = past.get();
//     options.on_trace = [&](const plan::TraceEvent& event) { for (told : past->take(event)) … };
//     options.passes_over = [&](const auto& raising) { return past->passes_over(raising); };
//     run::VirtualTime run(graph, library, options);
//     past->join(run, nodes);
//
// The clock of the run that was recorded was real: what fell due was taken a little later. As long
// as the plan decides what it decided then, it is *in step*: each decision is at the time that was
// recorded, so that lateness does not add up.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aesl/project.hpp"
#include "mcap/reader.hpp"
#include "record/bus_messages.hpp"
#include "record/inputs.hpp"
#include "run/surroundings.hpp"
#include "run/virtual_time.hpp"
#include "toolbox/bus.hpp"

namespace vagus::record {

// A decision that lies so much beside the one recorded is the same: the computer was late.
constexpr Duration kInStepWithin = std::chrono::milliseconds(250);
// What was heard and what fell due so close to each other came in the order that was recorded.
constexpr Duration kOrderWithin = std::chrono::milliseconds(20);

class PastBus final : public run::Surroundings {
public:
    // A user event that was on the bus.
    struct Event {
        RecordedEvent event;
        uint32_t cause = 0;  // number of the frame that the plan's code had heard last
        size_t lines = 0;    // that the trace had then
    };

    // The project, of that file, gives events their names. Events of later than `until` are left
    // out. The Error is of an input that cannot be read.
    static Result<std::unique_ptr<PastBus>> read(const mcap::Reader& reader, aesl::Project project,
                                                 const std::string& file = "",
                                                 Time until = Time::max());

    // By the number of the frame.
    const std::map<uint32_t, Event>& events() const { return events_; }
    // What channels and files of nodes are called, by their ids: the name, or NAME-ID.
    const std::map<uint16_t, std::string>& labels() const { return labels_; }
    // "drive", or "node 3" where nobody knows; "drive (node 3)" where another has that name.
    std::string name_of(uint16_t node) const;
    const aesl::Project& project() const { return project_; }
    // What a node had at an instant.
    struct ScriptThen {
        const aesl::Script* script = nullptr;             // nullptr: nobody knows
        const aesl::CommonDefinitions* common = nullptr;  // that it was compiled with
        std::string file = {};
        bool is_attached = false;  // as it was when the recording began
    };
    // What it was loaded with by then, as far as that was recorded, or that of the project.
    ScriptThen script_of(uint16_t node, Time at) const;
    // It was ended before it had begun, or nothing of it was written.
    bool never_began() const { return lines_.empty(); }
    // The run went on when its recording ended: nothing is known of what came then.
    bool is_cut() const { return cut_; }
    // Who ended the run.
    const std::optional<std::string>& ended_by() const { return ended_by_; }

    // Plan files were saved then, and a new version of the plan made of them.
    void on_saved(std::function<void(const PlanFiles&)> saved) { saved_ = std::move(saved); }
    // What the run begins with. Both are borrowed for the run.
    void join(run::VirtualTime& run, toolbox::BusNodes& nodes);

    struct Told {
        Time at{};
        std::string text;
    };
    // A line of the run, as it is to be compared with what was recorded: as it was, if only its
    // time is another one. Lines that tell of lateness come again with those after them. Behind
    // the end of one that is cut there is nothing to compare: none.
    std::vector<Told> take(const plan::TraceEvent& event);
    // Those after the last line of the run.
    std::vector<Told> rest();
    // Of two events at one instant that one is taken that was taken then.
    bool passes_over(const run::Raising& raising) const;
    // Since when it decides otherwise than it did.
    std::optional<Time> parted() const { return parted_; }

    // ---- run::Surroundings ----
    Time next() const override;
    Time late(Time due) override;
    std::vector<run::BusEvent> begin() override;
    void emit(Time at, const run::BusEvent& event) override;
    void end() override {}

private:
    struct Item {
        Time at{};
        size_t place = 0;  // in the recording, among lines and items
        InputWhat what;
    };
    struct Line {
        Time at{};
        size_t place = 0;
        std::string text;
    };
    // What the plan sent, as far as it is on the bus.
    struct Emission {
        size_t place = 0;
        uint32_t frame = 0;
    };
    void see_trace(Time at, std::string_view text);
    Status see_input(Time at, std::string_view text, const mcap::Reader& reader);
    void see_frame(Time at, std::string_view data);
    void see_event(Time at, std::string_view text);
    void see_node(std::string_view text);
    void place_scripts();
    void see_script(Time at, const ScriptLoaded& loaded, const mcap::Reader& reader);
    const Line* next_line() const;
    bool comes_before_line(const Item& item) const;
    bool comes_before_all(const Item& item) const;
    bool comes_now(const Item& item) const;
    void apply(const Item& item, std::vector<run::BusEvent>& heard);
    void skip_late(std::vector<Told>& told);

    aesl::Project project_;
    std::string file_;  // of it
    std::optional<std::string> ended_by_;
    bool cut_ = false;
    std::function<void(const PlanFiles&)> saved_ = [](const PlanFiles&) {};
    std::vector<Item> items_;
    std::vector<Line> lines_;
    std::vector<Emission> emissions_;
    std::map<size_t, std::vector<Told>> late_;  // before the line with that index
    std::map<uint32_t, Event> events_;
    std::map<uint16_t, std::string> names_;  // of nodes, as they described themselves
    std::map<uint16_t, std::string> labels_;
    struct Loaded {
        Time at{};
        uint16_t node = 0;
        std::string file;
        aesl::Project project;
        int script = -1;  // of it, that is for the node; -1: none
        bool is_attached = false;
    };
    std::vector<Loaded> loaded_;       // the last one of a node counts
    std::map<uint16_t, int> scripts_;  // of the project, by nodes that it has one for
    size_t places_ = 0;
    size_t item_ = 0;  // the next
    size_t line_ = 0;
    size_t emission_ = 0;
    Time last_{-1};  // instant that was begun
    std::optional<Time> parted_;
    Time parted_at_{};  // of its first other line, if that is near one that was recorded
    run::VirtualTime* run_ = nullptr;
    toolbox::BusNodes* nodes_ = nullptr;
};

}  // namespace vagus::record
