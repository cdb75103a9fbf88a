#include "record/why.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/json.hpp"
#include "base/nearest.hpp"
#include "base/seconds.hpp"
#include "base/text.hpp"
#include "embed/loaded_plan.hpp"
#include "record/plan_places.hpp"
#include "wire/protocol.hpp"

namespace vagus::record {

namespace {

using About = Question::About;

// Local events of nodes that come when what a native began is done.
const std::set<std::string_view> kDone = {"arrived", "turned", "halted", "sound.finished"};

bool is_timer(std::string_view event) {
    return event == "tick" || event.starts_with("timer");
}

// Variables by which scripts command wheels; robots of other kinds do it by natives.
constexpr std::string_view kMotors[] = {"motor.left.target", "motor.right.target", "speed.left",
                                        "speed.right"};
constexpr std::string_view kDriving = "drive.";

// Who has written what a person set while the plan ran, or before it began.
constexpr std::string_view kOutside = "outside";

std::string words_of(const std::vector<int16_t>& words) {
    std::string text;
    for (const int16_t word : words) text += (text.empty() ? "" : " ") + std::to_string(word);
    return text;
}

std::string value_text(const plan::Value& value) {
    switch (value.type()) {
        case plan::Type::String:
            return json_quote(value.string());
        case plan::Type::Bool:
            return value.boolean() ? "true" : "false";
        case plan::Type::Int:
            return std::to_string(value.integer());
        case plan::Type::Float:
            return fmt::format("{:g}", value.number());
        case plan::Type::Object:
            break;
    }
    return "an object";
}

// Builds one chain.
class Walk {
public:
    explicit Walk(const Causes& causes)
        : causes_(causes), rerun_(causes.rerun()), places_(causes.rerun()) {}

    Result<Chain> answer(const Question& question) {
        Status asked = Status::done();
        switch (question.about) {
            case About::Actor:
                asked = actor(question.name);
                break;
            case About::Variable:
                asked = variable(question.name);
                break;
            case About::Motor:
                asked = motor(question.name);
                break;
            case About::Event:
                asked = event(question.name);
                break;
            case About::End:
                asked = end();
                break;
        }
        TRY(asked);
        chaos();
        if (!chain_.empty()) chain_.back().root = true;
        return chain_;
    }

private:
    // ---- questions ----
    Status actor(const std::string& name);
    Status variable(const std::string& name);
    Status variable_of_node(const std::string& node, const std::string& name);
    Status motor(const std::string& robot);
    Status event(const std::string& name);
    Status end();

    // ---- links, each followed by what it came from ----
    void frame(uint32_t number);
    void frame_of_plan(const Causes::Frame& frame);
    void run(uint32_t number);
    void local_event(const Causes::HandlerRun& run);
    void call(uint32_t number);
    void happening(uint32_t number);
    void chaos();
    void line(size_t index);
    void before_started(size_t index, const plan::ActorStarted& started);
    void before_ended(size_t index, const plan::ActorEnded& ended);

    // A link at an element of the plan with that instance path.
    bool add_element(Time at, std::string what, const std::string& plan, std::string_view name,
                     std::string value = {}) {
        return add({.at = at,
                    .what = std::move(what),
                    .place = places_.element(plan, name),
                    .value = std::move(value),
                    .element = std::string(name)});
    }
    bool add(Link link) {
        if (chain_.size() >= kLinksMax) return false;
        chain_.push_back(std::move(link));
        return true;
    }
    const std::vector<Causes::Line>& lines() const { return causes_.lines(); }
    template <typename What>
    const What* what(size_t index) const {
        return std::get_if<What>(&lines()[index].event.what);
    }
    bool same_plan(size_t a, size_t b) const {
        return lines()[a].event.plan == lines()[b].event.plan;
    }
    std::string node_name(const sim::WitnessedNode& node) const;
    std::string place_of(const sim::WitnessedNode& node, uint16_t pc) const;
    std::string local_name(const sim::WitnessedNode& node, int event) const;
    std::string local_help(const sim::WitnessedNode& node, int event) const;

    const Causes& causes_;
    Rerun& rerun_;
    PlanPlaces places_;
    Chain chain_;
};

std::string Walk::node_name(const sim::WitnessedNode& node) const {
    for (const session::NodeState& one : rerun_.session()->nodes()) {
        if (one.id == node.id && one.robot.number == node.robot) return one.name;
    }
    return "node " + std::to_string(node.id);
}

std::string Walk::place_of(const sim::WitnessedNode& node, uint16_t pc) const {
    const aesl::Program* const program = rerun_.session()->program(node.id);
    if (program == nullptr || pc >= program->lines.size()) return "";
    const auto place = rerun_.session()->place_of(node.id, program->lines[pc]);
    if (!place) return "";
    return fmt::format("{}:{}", rerun_.name_of(place->first), place->second);
}

std::string Walk::local_name(const sim::WitnessedNode& node, int event) const {
    const aesl::Target* const target = rerun_.session()->target(node.id);
    const auto index = static_cast<size_t>(event);
    return target != nullptr && index < target->local_events.size()
               ? target->local_events[index].name
               : std::to_string(event);
}

std::string Walk::local_help(const sim::WitnessedNode& node, int event) const {
    const aesl::Target* const target = rerun_.session()->target(node.id);
    const auto index = static_cast<size_t>(event);
    return target != nullptr && index < target->local_events.size()
               ? target->local_events[index].doc
               : "";
}

// ---- frames, handlers, the world ----

void Walk::frame(uint32_t number) {
    const Causes::Frame* const one = causes_.frame(number);
    if (one == nullptr) return;
    if (one->node.robot == 0) return frame_of_plan(*one);
    const bool more = add({one->at,
                           fmt::format("the script of {} emitted {}", node_name(one->node),
                                       one->event.empty() ? "a message" : one->event),
                           place_of(one->node, one->deed.pc), words_of(one->arguments)});
    if (more) run(one->deed.run);
}

void Walk::frame_of_plan(const Causes::Frame& frame) {
    if (frame.by.empty()) {
        const char* const who = rerun_.about().verb == kStudioVerb ? "the studio" : "a host";
        add({frame.at, fmt::format("{} sent {}", who, frame.event), "", words_of(frame.arguments)});
        return;
    }
    // The element whose code it was: where it began, or what raised it.
    for (size_t i = std::min(frame.line, lines().size()); i-- > 0;) {
        const auto* const started = what<plan::ActorStarted>(i);
        const bool is_it = started != nullptr && started->actor == frame.by;
        if (!is_it) continue;
        const bool more = add_element(
            frame.at, fmt::format("the actor {} of the plan sent {}", frame.by, frame.event),
            lines()[i].event.plan, frame.by, words_of(frame.arguments));
        if (!more) return;
        const Causes::Frame* const heard = causes_.frame(frame.cause);
        if (heard != nullptr && heard->at >= lines()[i].event.at) return this->frame(frame.cause);
        return line(i);
    }
    add_element(frame.at,
                fmt::format("the supervisor {} of the plan sent {}", frame.by, frame.event), "",
                frame.by, words_of(frame.arguments));
    this->frame(frame.cause);
}

void Walk::run(uint32_t number) {
    const Causes::HandlerRun* const one = causes_.run(number);
    if (one == nullptr) return;
    if (one->event >= 0) return local_event(*one);
    const Causes::Frame* const by = causes_.frame(one->frame);
    const std::string event = by != nullptr ? by->event : "an event of a host";
    const bool more =
        add({one->at, fmt::format("{} heard {}", node_name(one->node), event),
             place_of(one->node, one->pc), by != nullptr ? words_of(by->arguments) : ""});
    if (more) frame(one->frame);
}

void Walk::local_event(const Causes::HandlerRun& run) {
    const std::string event = local_name(run.node, run.event);
    const std::string node = node_name(run.node);
    const std::string place = place_of(run.node, run.pc);
    const std::string felt = is_timer(event) ? fmt::format("a timer of {} ran out: {}", node, event)
                                             : fmt::format("{} felt {}", node, event);
    const std::string about = local_help(run.node, run.event);
    if (!kDone.contains(event) || run.call == 0) {
        if (add({run.at, felt, place, about})) happening(run.happening);
        return;
    }
    if (add({run.at, fmt::format("{} was done with it: {}", node, event), place, about})) {
        call(run.call);
    }
}

void Walk::call(uint32_t number) {
    const Causes::Call* const one = causes_.call(number);
    if (one == nullptr) return;
    const aesl::Target* const target = rerun_.session()->target(one->node.id);
    const std::string native = target->natives[one->native].name;
    const bool more =
        add({one->deed.at, fmt::format("the script of {} called {}", node_name(one->node), native),
             place_of(one->node, one->deed.pc), ""});
    if (more) run(one->deed.run);
}

void Walk::happening(uint32_t number) {
    if (number == 0) return;
    const Causes::Happening& one = causes_.happenings()[number - 1];
    std::string place;
    if (one.kind == Causes::Happening::Kind::Timeline) place = places_.timeline(one.entry);
    if (add({one.at, one.what, place, ""})) happening(one.before);
}

// What was broken when it happened, or shortly before. Nothing tells that it follows from that.
void Walk::chaos() {
    constexpr Duration kFeltFor = std::chrono::seconds(4);  // a node is missed after three
    const auto& happenings = causes_.happenings();
    for (size_t i = happenings.size(); i-- > 0 && !chain_.empty();) {
        const Causes::Happening& one = happenings[i];
        const Time at = chain_.front().at;
        if (one.kind != Causes::Happening::Kind::Chaos || one.at > at) continue;
        const auto end = sim::end_of(rerun_.session()->world().chaos()[one.entry]);
        if (end && *end + kFeltFor < at) continue;
        add({one.at, "perhaps " + one.what, "", ""});
        return;
    }
}

// ---- the plan ----

void Walk::line(size_t index) {
    const plan::TraceEvent& event = lines()[index].event;
    if (const auto* started = what<plan::ActorStarted>(index)) {
        if (add_element(event.at, fmt::format("the actor {} began", started->actor), event.plan,
                        started->actor)) {
            before_started(index, *started);
        }
    } else if (const auto* ended = what<plan::ActorEnded>(index)) {
        if (add_element(event.at,
                        fmt::format("the actor {} ended with {}", ended->actor, ended->state),
                        event.plan, ended->actor)) {
            before_ended(index, *ended);
        }
    } else if (const auto* raised = what<plan::EventRaised>(index)) {
        const bool more = add_element(
            event.at, fmt::format("the supervisor {} raised {}", raised->supervisor, raised->event),
            event.plan, raised->supervisor);
        if (more && event.frame != 0) frame(event.frame);
    } else if (std::holds_alternative<plan::PlanStarted>(event.what)) {
        add({event.at, fmt::format("the plan {} began", event.plan), places_.plan(event.plan), ""});
    }
}

// An actor begins by an event that interrupted another, by the state of another, or at the start.
void Walk::before_started(size_t index, const plan::ActorStarted& started) {
    for (size_t i = index; i-- > 0;) {
        const auto* const raised = what<plan::EventRaised>(i);
        const auto* const ended = what<plan::ActorEnded>(i);
        const bool begins = std::holds_alternative<plan::PlanStarted>(lines()[i].event.what);
        if (!same_plan(i, index)) continue;
        if (raised != nullptr && raised->target == started.actor) return line(i);
        if (ended != nullptr && ended->target == started.actor) return line(i);
        if (begins) return line(i);
    }
}

void Walk::before_ended(size_t index, const plan::ActorEnded& ended) {
    size_t begin = index;
    for (size_t i = index; i-- > 0;) {
        const auto* const started = what<plan::ActorStarted>(i);
        if (started == nullptr || !same_plan(i, index) || started->actor != ended.actor) continue;
        begin = i;
        break;
    }
    const plan::TraceEvent& event = lines()[index].event;
    const Causes::Frame* const heard = causes_.frame(event.frame);
    if (heard != nullptr && heard->at >= lines()[begin].event.at) return frame(event.frame);
    if (begin != index) line(begin);
}

// ---- questions ----

Error nothing_of(std::string_view kind, const std::string& name, std::vector<std::string> known) {
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    const std::string near = nearest(name, known);
    const std::string hint =
        !near.empty() ? "; did you mean " + near + "?"
        : known.empty()
            ? ""
            : "; there is " + list_of(std::vector<std::string_view>(known.begin(), known.end()));
    return {Code::NotFound, fmt::format("by then there was no {} \"{}\"{}", kind, name, hint)};
}

Status Walk::actor(const std::string& name) {
    std::vector<std::string> known;
    for (size_t i = lines().size(); i-- > 0;) {
        const auto* const started = what<plan::ActorStarted>(i);
        const auto* const ended = what<plan::ActorEnded>(i);
        const auto* const broken = what<plan::ActorInterrupted>(i);
        if (started != nullptr) known.emplace_back(started->actor);
        if ((started != nullptr && started->actor == name) ||
            (ended != nullptr && ended->actor == name)) {
            line(i);
            return Status::done();
        }
        if (broken == nullptr || broken->actor != name) continue;
        add_element(lines()[i].event.at, fmt::format("the actor {} was interrupted", name),
                    lines()[i].event.plan, name);
        for (size_t j = i; j-- > 0;) {
            if (what<plan::EventRaised>(j) == nullptr) continue;
            line(j);
            break;
        }
        return Status::done();
    }
    return nothing_of("actor", name, std::move(known));
}

Status Walk::variable(const std::string& name) {
    const size_t dot = name.find('.');
    if (dot != std::string::npos) {
        const std::string node = name.substr(0, dot);
        for (const session::NodeState& one :
             rerun_.session() ? rerun_.session()->nodes() : std::vector<session::NodeState>()) {
            if (one.name == node) return variable_of_node(node, name.substr(dot + 1));
        }
    }
    std::vector<std::string> known;
    for (size_t i = lines().size(); i-- > 0;) {
        const auto* const written = what<plan::VariableWritten>(i);
        if (written == nullptr) continue;
        known.emplace_back(written->variable);
        if (written->variable != name) continue;
        const plan::TraceEvent& event = lines()[i].event;
        if (written->by == kOutside) {
            add({event.at, fmt::format("a person gave the variable {} its value", name), "",
                 value_text(written->value)});
            return Status::done();
        }
        add_element(event.at, fmt::format("{} wrote the variable {}", written->by, name),
                    event.plan, written->by, value_text(written->value));
        for (size_t j = i; j-- > 0;) {
            const auto* const ended = what<plan::ActorEnded>(j);
            const auto* const raised = what<plan::EventRaised>(j);
            const bool is_it = (ended != nullptr && ended->actor == written->by) ||
                               (raised != nullptr && raised->supervisor == written->by);
            if (!is_it || lines()[j].event.at != event.at) continue;
            line(j);
            break;
        }
        return Status::done();
    }
    return nothing_of("variable", name, std::move(known));
}

Status Walk::variable_of_node(const std::string& node, const std::string& name) {
    const session::SimSession& session = *rerun_.session();
    std::vector<std::string> known;
    for (const session::NodeState& one : session.nodes()) {
        const aesl::Program* const program = session.program(one.id);
        if (one.name != node || program == nullptr) continue;
        const sim::WitnessedNode witnessed{one.robot.number, one.id};
        for (const aesl::VariablePlace& place : program->variables) {
            known.push_back(place.name);
            if (place.name != name) continue;
            const auto deed = causes_.last_write(witnessed, place.address, place.size);
            if (!deed) {
                add({Time{}, fmt::format("no script has written {} of {} yet", name, node), "",
                     ""});
                return Status::done();
            }
            add({deed->at, fmt::format("the script of {} wrote {}", node, name),
                 place_of(witnessed, deed->pc), std::to_string(deed->value)});
            run(deed->run);
            return Status::done();
        }
    }
    return nothing_of("variable of " + node, name, std::move(known));
}

Status Walk::motor(const std::string& name) {
    const session::SimSession* const session = rerun_.session();
    std::vector<std::string> known;
    if (session == nullptr) return nothing_of("robot", name, known);
    for (const sim::RobotView& robot : session->world().robots()) {
        known.emplace_back(robot.name);
        if (robot.name != name) continue;
        std::optional<Causes::Deed> last;
        std::string variable;
        sim::WitnessedNode witnessed{robot.id.number, robot.node};
        if (const aesl::Program* const program = session->program(robot.node)) {
            for (const aesl::VariablePlace& place : program->variables) {
                if (std::find(std::begin(kMotors), std::end(kMotors), place.name) ==
                    std::end(kMotors)) {
                    continue;
                }
                const auto deed = causes_.last_write(witnessed, place.address, place.size);
                if (!deed || (last && deed->at < last->at)) continue;
                last = deed;
                variable = place.name;
            }
        }
        const uint32_t called = causes_.last_call(robot.id.number, kDriving);
        if (last && (called == 0 || causes_.call(called)->deed.at < last->at)) {
            add({last->at, fmt::format("the script of {} wrote {}", name, variable),
                 place_of(witnessed, last->pc), std::to_string(last->value)});
            run(last->run);
        } else if (called != 0) {
            call(called);
        } else {
            add({Time{}, fmt::format("no script has told the wheels of {} to turn", name), "", ""});
        }
        return Status::done();
    }
    return nothing_of("robot", name, std::move(known));
}

Status Walk::event(const std::string& name) {
    const uint32_t number = causes_.last_event(name);
    if (number != 0) {
        frame(number);
        return Status::done();
    }
    std::vector<std::string> known;
    if (rerun_.session() != nullptr) {
        for (const aesl::GlobalEvent& one : rerun_.session()->common().events) {
            known.push_back(one.name);
        }
    }
    return nothing_of("event", name, std::move(known));
}

Status Walk::end() {
    for (size_t i = lines().size(); i-- > 0;) {
        const auto* const ended = what<plan::PlanEnded>(i);
        if (ended == nullptr || lines()[i].event.plan.find('/') != std::string::npos) continue;
        const plan::TraceEvent& event = lines()[i].event;
        add({event.at, fmt::format("the plan {} ended: {}", event.plan, name_of(ended->result)),
             places_.plan(event.plan), ended->message});
        for (size_t j = i; j-- > 0;) {
            const auto* const raised = what<plan::EventRaised>(j);
            const auto* const over = what<plan::ActorEnded>(j);
            if (raised == nullptr && over == nullptr) continue;
            const std::string_view target = raised != nullptr ? raised->target : over->target;
            if (!target.starts_with('@')) break;
            line(j);
            return Status::done();
        }
        add({event.at, "somebody ended the run, or its time was over", "", ""});
        return Status::done();
    }
    return Error{Code::NotFound, "by then no plan had ended"};
}

}  // namespace

Result<Question> read_question(const std::vector<std::string>& words) {
    const auto fails = [](const std::string& found) {
        return Error{Code::BadInput,
                     "expected a question: actor NAME, variable NODE.NAME, variable NAME, motor "
                     "ROBOT, event NAME, or end; found " +
                         found};
    };
    if (words.empty()) return fails("nothing");
    static const std::vector<std::pair<std::string_view, About>> kWords = {
        {"actor", About::Actor},
        {"variable", About::Variable},
        {"motor", About::Motor},
        {"event", About::Event}};
    if (words.size() == 1 && words[0] == "end") return Question{About::End};
    for (const auto& [word, about] : kWords) {
        if (words[0] == word && words.size() == 2) return Question{about, words[1]};
    }
    std::string all;
    for (const std::string& word : words) all += (all.empty() ? "" : " ") + word;
    return fails("\"" + all + "\"");
}

Result<Chain> why(const mcap::Reader& reader, const Question& question, std::optional<Time> at) {
    // Of a run that goes on there is what was written by now.
    if (!reader.is_complete()) at = std::min(at.value_or(Time::max()), end_of(reader));
    std::unique_ptr<Rerun> rerun = TRY(Rerun::open(reader, {.until = at}));
    Causes causes(*rerun);
    NullTape tape;
    std::optional<Result<Chain>> answer;
    // At its instant, before the run is ended for it.
    if (at) {
        rerun->each_instant([&](Time now) {
            if (now >= *at && !answer) answer = Walk(causes).answer(question);
        });
    }
    (void)TRY(rerun->run(tape));
    if (!answer) answer = Walk(causes).answer(question);
    return *answer;
}

std::string format_link(const Link& link) {
    std::string text =
        fmt::format("{:>11} s  {}", fmt::format("{:.3f}", seconds_of(link.at)), link.what);
    if (!link.value.empty()) text += " (" + link.value + ")";
    if (!link.place.empty()) text += "  " + link.place;
    return text;
}

std::string format_chain_json(const Chain& chain) {
    std::string text = "[";
    for (const Link& link : chain) {
        text += fmt::format(
            R"({}{{"t":{},"what":{},"place":{},"value":{},"root":{},"element":{}}})",
            text.size() > 1 ? ",\n" : "\n", seconds_text(link.at), json_quote(link.what),
            json_quote(link.place), json_quote(link.value), link.root, json_quote(link.element));
    }
    return text + "\n]\n";
}

}  // namespace vagus::record
