#include "session/bus_names.hpp"

#include <algorithm>
#include <array>

#include "base/nearest.hpp"

namespace vagus::session {

namespace {

// The templates of `core` that name an event of the bus, each by its input "event".
constexpr std::array<std::string_view, 3> kBusTemplates = {"Send", "Receive", "OnEvent"};
constexpr std::string_view kEventInput = "event";
constexpr std::string_view kRule = "bus";  // of the findings: they belong to no rule of plans.md

bool is_bus_template(std::string_view name) {
    return std::find(kBusTemplates.begin(), kBusTemplates.end(), name) != kBusTemplates.end();
}

// Calls `look(actor or supervisor)` for each that is made of a template.
template <typename Look>
void for_each_template(const plan::Plan& plan, const Look& look) {
    for (const plan::Supervisor& supervisor : plan.globals) look(supervisor);
    for (const plan::Actor& actor : plan.actors) {
        look(actor);
        for (const plan::Supervisor& supervisor : actor.supervisors) look(supervisor);
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

Status BusNames::known(std::string_view event) const {
    if (find(event)) return Status::done();
    std::vector<std::string> names;
    for (const aesl::GlobalEvent& one : common_.events) names.push_back(one.name);
    const std::string near = nearest(event, names);
    const std::string quoted = "\"" + std::string(event) + "\"";
    std::string sentence = "the event " + quoted + " has no number: ";
    sentence += (names.empty() ? "no events are declared by " : "it is not declared by ") + source_;
    sentence += near.empty() ? "; add <event name=" + quoted + " size=\"…\"/> to the project"
                             : "; did you mean \"" + near + "\"?";
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

plan::Findings BusNames::check(const std::vector<plan::Plan>& plans) const {
    plan::Findings findings;
    for (const plan::Plan& plan : plans) {
        for_each_template(plan, [&](const auto& element) {
            if (!element.template_name || !is_bus_template(*element.template_name)) return;
            for (const plan::Entry& entry : element.in) {
                if (entry.name != kEventInput) continue;
                const auto event = constant_text(entry);
                const Status status = event ? known(*event) : Status::done();
                if (status.ok()) continue;
                findings.push_back({plan::Severity::Error, std::string(kRule), plan.file, plan.name,
                                    element.name, entry.line, status.error().what});
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
        for_each_template(plan, [&](const auto& element) {
            if (!element.template_name) return;
            const std::string& name = *element.template_name;
            uses = uses || is_bus_template(name) || !in_core(name);
        });
    }
    return uses;
}

}  // namespace vagus::session
