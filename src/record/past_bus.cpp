#include "record/past_bus.hpp"

#include <algorithm>
#include <filesystem>
#include <ranges>
#include <utility>

#include "base/json.hpp"
#include "debug/user_event.hpp"
#include "record/compare_tape.hpp"
#include "record/damage.hpp"
#include "record/topics.hpp"
#include "wire/protocol.hpp"

namespace vagus::record {

namespace {

// A line without what hangs on the clock: when it was, and how long a stop took.
std::string without_times(const std::string& line) {
    auto json = read_json(line);
    auto* const tree = std::get_if<JsonValue>(&json);
    if (tree == nullptr) return line;
    std::erase_if(tree->members, [](const JsonMember& member) {
        return member.key == "t" || member.key == "stop_us";
    });
    return json_line(*tree);
}

bool is_near(Time a, Time b) {
    return (a > b ? a - b : b - a) <= kInStepWithin;
}

}  // namespace

// ---- reading ----

Result<std::unique_ptr<PastBus>> PastBus::read(const mcap::Reader& reader, aesl::Project project,
                                               const std::string& file, Time until) {
    auto past = std::make_unique<PastBus>();
    past->file_ = file;
    past->project_ = std::move(project);
    mcap::Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        const mcap::Channel* const channel = reader.channel(message->channel);
        if (channel == nullptr) continue;
        const Time at = time_of(message->log_time);
        if (channel->topic == kTraceTopic) {
            past->see_trace(at, message->data);
        } else if (channel->topic == kInputTopic) {
            TRY(past->see_input(at, message->data, reader));
        } else if (channel->topic == kFramesTopic && at <= until) {
            past->see_frame(at, message->data);
        } else if (channel->topic == kEventsTopic && at <= until) {
            past->see_event(at, message->data);
        } else if (channel->topic == kNodesTopic) {
            past->see_node(message->data);
        }
    }
    TRY(check_read(cursor, reader));
    past->place_scripts();
    return past;
}

// Once the names of all nodes are known.
void PastBus::place_scripts() {
    std::vector<aesl::NodeName> nodes;
    for (const auto& [id, name] : names_) nodes.push_back({name, id});
    const auto by_node = [&nodes](const aesl::Project& project) {
        std::map<uint16_t, int> found;
        const std::vector<int> scripts = aesl::scripts_for(project, nodes);
        for (size_t i = 0; i < nodes.size(); ++i) {
            if (scripts[i] >= 0) found[nodes[i].id] = scripts[i];
        }
        return found;
    };
    scripts_ = by_node(project_);
    for (Loaded& one : loaded_) {
        const auto found = by_node(one.project);
        if (const auto script = found.find(one.node); script != found.end()) {
            one.script = script->second;
        }
    }
}

void PastBus::see_trace(Time at, std::string_view text) {
    const auto json = read_json(text);
    const auto* const tree = std::get_if<JsonValue>(&json);
    if (tree != nullptr && text_in(*tree, "kind") == "late") {
        late_[lines_.size()].push_back({at, std::string(text)});
        return;
    }
    lines_.push_back({at, ++places_, std::string(text)});
}

Status PastBus::see_input(Time at, std::string_view text, const mcap::Reader& reader) {
    Input input = TRY(read_input(text, at, reader.name()));
    if (const auto* const aborted = std::get_if<Aborted>(&input.what)) ended_by_ = aborted->by;
    const auto* const asked = std::get_if<run::Request>(&input.what);
    if (asked != nullptr && std::holds_alternative<run::Abort>(*asked)) ended_by_ = "";
    if (const auto* const loaded = std::get_if<ScriptLoaded>(&input.what)) {
        see_script(at, *loaded, reader);
    } else if (const auto* const end = std::get_if<RecordingEnds>(&input.what)) {
        cut_ = !end->why.empty();
    } else {
        items_.push_back({at, ++places_, std::move(input.what)});
    }
    return Status::done();
}

void PastBus::see_frame(Time at, std::string_view data) {
    const auto recorded = read_frame(data);
    if (!recorded || !wire::is_user_event(recorded->frame.type)) return;
    debug::UserEvent event = debug::user_event_of(recorded->frame, project_.common);
    events_[recorded->number] = {
        .event = recorded_event(at, recorded->number, recorded->frame.source, std::move(event)),
        .cause = recorded->cause,
        .lines = lines_.size()};
}

// Tells who in the plan sent it.
void PastBus::see_event(Time at, std::string_view text) {
    if (text.find("\"by\":") == std::string_view::npos) return;
    const auto event = read_event(at, text);
    const auto found = event ? events_.find(event->frame) : events_.end();
    if (found == events_.end()) return;
    found->second.event.by = event->by;
    emissions_.push_back({++places_, found->first});
}

void PastBus::see_node(std::string_view text) {
    const auto told = read_node(text);
    if (!told || told->file.empty()) return;
    names_[told->node] = told->name;
    labels_[told->node] = std::filesystem::path(told->file).stem().string();
}

std::string PastBus::name_of(uint16_t node) const {
    const std::string number = "node " + std::to_string(node);
    const auto found = names_.find(node);
    if (found == names_.end()) return number;
    const std::string& name = found->second;
    const bool shared = std::ranges::count(names_ | std::views::values, name) > 1;
    return shared ? name + " (" + number + ")" : name;
}

// A file that is none, or has mistakes, was not what the node was loaded with.
void PastBus::see_script(Time at, const ScriptLoaded& loaded, const mcap::Reader& reader) {
    auto project = aesl::parse_project(loaded.text, loaded.file);
    if (!project.ok()) return;
    const mcap::Attachment* const file = reader.attachment(file_);
    const bool same = loaded.file == file_ && file != nullptr && file->data == loaded.text;
    loaded_.push_back({.at = at,
                       .node = loaded.node,
                       .file = loaded.file,
                       .project = std::move(project.value()),
                       .is_attached = same});
}

PastBus::ScriptThen PastBus::script_of(uint16_t node, Time at) const {
    const auto last = std::ranges::find_if(loaded_ | std::views::reverse, [&](const Loaded& one) {
        return one.node == node && one.at <= at;
    });
    const bool is_loaded = last != loaded_.rend();
    const auto own = scripts_.find(node);
    const int script = is_loaded ? last->script : own == scripts_.end() ? -1 : own->second;
    if (script < 0) return {};
    const aesl::Project& project = is_loaded ? last->project : project_;
    return {&project.scripts[static_cast<size_t>(script)], &project.common,
            is_loaded ? last->file : file_, !is_loaded || last->is_attached};
}

// ---- the run ----

void PastBus::join(run::VirtualTime& run, toolbox::BusNodes& nodes) {
    run_ = &run;
    run_->keep_unheard();
    nodes_ = &nodes;
    std::vector<run::BusEvent> too_early;
    while (item_ < items_.size() && comes_before_line(items_[item_])) {
        apply(items_[item_++], too_early);
    }
}

const PastBus::Line* PastBus::next_line() const {
    return parted_ || line_ >= lines_.size() ? nullptr : &lines_[line_];
}

bool PastBus::comes_before_line(const Item& item) const {
    const Line* const line = next_line();
    return line != nullptr && item.place < line->place;
}

// And before what the plan sent, which its code has yet to send.
bool PastBus::comes_before_all(const Item& item) const {
    const bool sends_first =
        emission_ < emissions_.size() && emissions_[emission_].place < item.place;
    return comes_before_line(item) && !sends_first;
}

// What it sends otherwise than it did has no place here.
void PastBus::emit(Time, const run::BusEvent& event) {
    if (emission_ >= emissions_.size()) return;
    const bool is_it = events_.at(emissions_[emission_].frame).event.name == event.name;
    emission_ = is_it ? emission_ + 1 : emissions_.size();
}

Time PastBus::next() const {
    if (item_ >= items_.size()) return run::kNever;
    const Item& item = items_[item_];
    Time at = item.at;
    const Line* const line = next_line();
    // While a debugger paused the plan, its clock stood, and that of the bus did not.
    if (line != nullptr) {
        at =
            comes_before_line(item) ? std::min(at, line->at) : std::max(at, line->at + Duration(1));
    }
    return std::max(at, last_ + Duration(1));
}

// A little is waited for what was heard before the next decision.
Time PastBus::late(Time due) {
    const Time heard = next();
    const Line* const line = next_line();
    const bool close = due < heard && heard - due <= kOrderWithin && line != nullptr &&
                       line->at - due <= kOrderWithin;
    return close && comes_before_all(items_[item_]) ? heard : due;
}

// With what was heard last, before the plan decided.
bool PastBus::comes_now(const Item& item) const {
    const Line* const line = next_line();
    if (line == nullptr) return item.at <= last_;
    if (!comes_before_all(item)) return false;
    return item.at <= last_ ||
           (item.at - last_ <= kOrderWithin && line->at - last_ <= kOrderWithin);
}

std::vector<run::BusEvent> PastBus::begin() {
    last_ = next();
    std::vector<run::BusEvent> heard;
    do {
        apply(items_[item_++], heard);
    } while (item_ < items_.size() && comes_now(items_[item_]));
    return heard;
}

void PastBus::apply(const Item& item, std::vector<run::BusEvent>& heard) {
    if (const auto* const one = std::get_if<Heard>(&item.what)) {
        const auto found = events_.find(one->frame);
        if (one->frame == 0) {
            heard.push_back({.name = one->name, .arguments = {}, .from = one->from});
        } else if (found != events_.end()) {
            const RecordedEvent& event = found->second.event;
            heard.push_back({event.name, event.arguments, event.node, event.frame});
        }
    } else if (const auto* const node = std::get_if<NodeChanged>(&item.what)) {
        using Change = toolbox::BusNodes::Change;
        if (node->change == Change::Appeared) nodes_->appeared(node->name);
        if (node->change == Change::Left) (void)nodes_->left(node->name);
        if (node->change == Change::Stopped) nodes_->stopped(node->name);
        if (node->change == Change::Runs) nodes_->runs(node->name);
    } else if (const auto* const moved = std::get_if<TokensMoved>(&item.what)) {
        run_->move_tokens(moved->token);
    } else if (const auto* const failed = std::get_if<RunFailed>(&item.what)) {
        run_->fail(failed->why);
    } else if (std::holds_alternative<Aborted>(item.what)) {
        run_->abort();
    } else if (const auto* const files = std::get_if<PlanFiles>(&item.what)) {
        saved_(*files);
    } else if (const auto* const asked = std::get_if<run::Request>(&item.what)) {
        // What only paused it is in the times of all others.
        (void)run_->do_as_asked(*asked).ok();
    }
}

void PastBus::skip_late(std::vector<Told>& told) {
    const auto late = late_.extract(line_);
    if (late.empty()) return;
    told.insert(told.end(), late.mapped().begin(), late.mapped().end());
}

std::vector<PastBus::Told> PastBus::take(const plan::TraceEvent& event) {
    std::vector<Told> told;
    std::string text = plan::format_trace(event);
    if (!parted_) skip_late(told);
    const Line* const line = next_line();
    if (line == nullptr) {
        if (cut_ && !parted_) return told;
        if (!parted_) parted_ = event.at;
        // Lines of the decision with which it parted come with that one, not before it.
        plan::TraceEvent now = event;
        now.at = std::max(event.at, parted_at_);
        told.push_back({now.at, plan::format_trace(now)});
        return told;
    }
    const bool near = is_near(line->at, event.at);
    if (near && without_times(text) == without_times(line->text)) {
        told.push_back({line->at, line->text});
        run_->move_clock(line->at);
        ++line_;
        return told;
    }
    parted_ = std::min(event.at, line->at);
    plan::TraceEvent then = event;
    if (near) {
        then.at = parted_at_ = line->at;
        run_->move_clock(line->at);  // all that follows comes later
    }
    told.push_back({then.at, plan::format_trace(then)});
    return told;
}

std::vector<PastBus::Told> PastBus::rest() {
    std::vector<Told> told;
    if (!parted_) skip_late(told);
    return told;
}

bool PastBus::passes_over(const run::Raising& raising) const {
    const Line* const line = next_line();
    if (!raising.tied || raising.ignored || line == nullptr) return false;
    if (line->at - raising.at > kOrderWithin) return false;
    const auto json = read_json(line->text);
    const auto* const tree = std::get_if<JsonValue>(&json);
    if (tree == nullptr) return false;
    const bool is_it = text_in(*tree, "kind") == "event" &&
                       text_in(*tree, "supervisor") == raising.supervisor &&
                       text_in(*tree, "event") == raising.event;
    const bool decides = text_in(*tree, "kind") == "event" || text_in(*tree, "kind") == "actor-end";
    return decides && !is_it;
}

}  // namespace vagus::record
