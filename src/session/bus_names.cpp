#include "session/bus_names.hpp"

#include <algorithm>
#include <array>

#include "base/nearest.hpp"
#include "base/text.hpp"
#include "plan/check.hpp"

namespace vagus::session {

namespace {

// The templates of `core` that name an event of the bus, each by its input "event".
constexpr std::string_view kSend = "Send";
constexpr std::array<std::string_view, 3> kBusTemplates = {kSend, "Receive", "OnEvent"};
constexpr std::string_view kEventInput = "event";
constexpr std::string_view kRule = "bus";  // of the findings: they belong to no rule of plans.md

bool is_bus_template(std::string_view name) {
    return std::find(kBusTemplates.begin(), kBusTemplates.end(), name) != kBusTemplates.end();
}

// Calls `look(element, whether it is a supervisor)` for each that is made of a template.
template <typename Look>
void for_each_template(const plan::Plan& plan, const Look& look) {
    for (const plan::Supervisor& supervisor : plan.globals) look(supervisor, true);
    for (const plan::Actor& actor : plan.actors) {
        look(actor, false);
        for (const plan::Supervisor& supervisor : actor.supervisors) look(supervisor, true);
    }
}

// What the entry says if no variable is in it.
std::optional<std::string> constant_text(const plan::Entry& entry) {
    if (!entry.formula || !entry.formula->names().empty()) return std::nullopt;
    const Result<plan::Value> value = entry.formula->evaluate({});
    if (!value.ok()) return std::nullopt;
    const Result<plan::Value> text = plan::convert(value.value(), plan::Type::String);
    return text.ok() ? std::optional(text.value().string()) : std::nullopt;
}

}  // namespace

const aesl::GlobalEvent* BusNames::find(std::string_view event) const {
    for (const aesl::GlobalEvent& one : common_.events) {
        if (one.name == event) return &one;
    }
    return nullptr;
}

std::string BusNames::near(std::string_view event) const {
    std::vector<std::string> names;
    for (const aesl::GlobalEvent& one : common_.events) names.push_back(one.name);
    return nearest(event, names);
}

Status BusNames::known(std::string_view event) const {
    if (find(event)) return Status::done();
    const std::string guess = near(event);
    const std::string quoted = "\"" + std::string(event) + "\"";
    std::string sentence = "the event " + quoted + " has no number: ";
    sentence += (common_.events.empty() ? "no events are declared by " : "it is not declared by ") +
                source_;
    sentence += guess.empty() ? "; add <event name=" + quoted + " size=\"…\"/> to the project"
                              : "; did you mean \"" + guess + "\"?";
    return Error{Code::NotFound, sentence};
}

Status BusNames::may_emit(const run::BusEvent& event) const {
    TRY(known(event.name));
    const aesl::GlobalEvent& declared = *find(event.name);
    if (!declared.size || *declared.size == event.arguments.size()) return Status::done();
    return Error{Code::BadInput, "the event \"" + event.name + "\" takes " +
                                     std::to_string(*declared.size) + " arguments, found " +
                                     std::to_string(event.arguments.size()) +
                                     "; give it as many as the project declares"};
}

// The events by which the template works.
Status BusNames::all_known(const plan::Template& of) const {
    std::vector<std::string> missing;
    for (const std::string& event : of.bus.events) {
        if (!find(event)) missing.push_back(event);
    }
    if (missing.empty()) return Status::done();
    const std::string needs = "the template " + of.name + " works by events, and ";
    if (missing.size() == 1)
        return Error{Code::NotFound, needs + known(missing.front()).error().what};
    for (std::string& event : missing) event = "\"" + event + "\"";
    return Error{Code::NotFound, needs + list_of({missing.begin(), missing.end()}) +
                                     " are not declared by " + source_ +
                                     "; load scripts that declare them, as the project of its "
                                     "toolbox does"};
}

plan::Findings BusNames::check(const std::vector<plan::Plan>& plans,
                               const plan::Library& library) const {
    plan::Findings findings;
    for (const plan::Plan& plan : plans) {
        const auto expect = [&](const Status& status, const std::string& element, Place at,
                                std::optional<plan::Meant> meant = std::nullopt) {
            if (status.ok()) return;
            findings.push_back({plan::Severity::Error, std::string(kRule), plan.file, plan.name,
                                element, at.line, status.error().what, at.column,
                                std::move(meant)});
        };
        const auto guess = [this](const std::string& event) {
            std::string name = near(event);
            return name.empty() ? std::nullopt : std::optional(plan::Meant{event, name});
        };
        for_each_template(plan, [&](const auto& element, bool supervisor) {
            if (!element.template_name) return;
            const plan::Template* of =
                plan::find_template(plan, library, *element.template_name, supervisor);
            if (of) expect(all_known(*of), element.name, element.template_line);
            if (!is_bus_template(*element.template_name)) return;
            for (const plan::Entry& entry : element.in) {
                const auto event = entry.name == kEventInput ? constant_text(entry) : std::nullopt;
                if (!event || known(*event).ok()) continue;
                expect(known(*event), element.name, entry.line, guess(*event));
            }
        });
    }
    return findings;
}

bool uses_bus(const std::vector<plan::Plan>& plans, const plan::Library& library) {
    bool uses = false;
    const plan::Toolbox* core = library.find(plan::kCoreToolbox);
    const auto in_core = [core](const std::string& name) {
        return core && std::any_of(core->templates.begin(), core->templates.end(),
                                   [&name](const plan::Template& one) { return one.name == name; });
    };
    for (const plan::Plan& plan : plans) {
        for_each_template(plan, [&](const auto& element, bool) {
            if (!element.template_name) return;
            const std::string& name = *element.template_name;
            uses = uses || is_bus_template(name) || !in_core(name);
        });
    }
    return uses;
}

bool sends_events(const std::vector<plan::Plan>& plans) {
    bool sends = false;
    for (const plan::Plan& plan : plans) {
        for_each_template(plan, [&](const auto& element, bool) {
            sends = sends || element.template_name == kSend;
        });
    }
    return sends;
}

std::set<std::string> events_heard(const std::vector<plan::Plan>& plans,
                                   const plan::Library& library) {
    std::set<std::string> heard;
    for (const plan::Plan& plan : plans) {
        for_each_template(plan, [&](const auto& element, bool supervisor) {
            if (!element.template_name) return;
            const std::string& name = *element.template_name;
            const plan::Template* of = plan::find_template(plan, library, name, supervisor);
            if (of) heard.insert(of->bus.events.begin(), of->bus.events.end());
            if (!is_bus_template(name) || name == kSend) return;
            for (const plan::Entry& entry : element.in) {
                const auto event = entry.name == kEventInput ? constant_text(entry) : std::nullopt;
                if (event) heard.insert(*event);
            }
        });
    }
    return heard;
}

std::set<std::string> stop_events(const plan::Library& library) {
    std::set<std::string> stops;
    for (const plan::Toolbox& toolbox : library.toolboxes()) {
        for (const plan::Template& one : toolbox.templates) {
            stops.insert(one.bus.stops.begin(), one.bus.stops.end());
        }
    }
    return stops;
}

}  // namespace vagus::session
