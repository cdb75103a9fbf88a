// What a chain of why.hpp tells of a real bus: as far as frames tell. Nobody has seen the scripts
// of its nodes run; where a script has only one place from which something can have come, that is
// told, and marked as guessed.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "aesl/mentions.hpp"
#include "aesl/project.hpp"
#include "record/past_bus.hpp"
#include "record/why_walk.hpp"

namespace vagus::record {

namespace {

using aesl::Mention;
using aesl::MentionKind;

// A part of a script: what is before the first handler, a handler, or a sub.
struct Section {
    enum class Kind { Init, Handler, Sub };
    Kind kind = Kind::Init;
    std::string name;
    int line = 1;
    auto operator<=>(const Section&) const = default;
};

struct Emitters {
    std::set<int> lines;         // of the script, that emit it
    std::set<Section> sections;  // handlers, or the beginning, from which one is reached
};

// From which handlers of a script an event can come, through its subs.
Emitters emitters_of(const aesl::Script& script, const aesl::CommonDefinitions& common,
                     const std::string& event) {
    Emitters found;
    std::map<std::string, std::set<Section>> callers;  // by sub
    std::set<Section> open;
    Section here;
    for (const Mention& one : aesl::mentions(script.source, common)) {
        const bool sub = one.kind == MentionKind::Sub;
        if (one.kind == MentionKind::Event && one.handles) {
            here = {Section::Kind::Handler, one.name, one.at.line};
        } else if (sub && one.declares) {
            here = {Section::Kind::Sub, one.name, one.at.line};
        } else if (sub) {
            callers[one.name].insert(here);
        } else if (one.kind == MentionKind::Event && one.name == event) {
            found.lines.insert(one.at.line);
            open.insert(here);
        }
    }
    std::set<Section> seen;
    while (!open.empty()) {
        const Section one = open.extract(open.begin()).value();
        if (!seen.insert(one).second) continue;
        if (one.kind == Section::Kind::Sub) {
            open.insert(callers[one.name].begin(), callers[one.name].end());
        } else {
            found.sections.insert(one);
        }
    }
    return found;
}

bool is_global(const aesl::CommonDefinitions& common, const std::string& event) {
    return std::ranges::any_of(common.events,
                               [&event](const auto& one) { return one.name == event; });
}

}  // namespace

void Walk::frame_of_bus_node(uint32_t number, const BusCauses::Frame& frame) {
    const PastBus& past = *rerun_.past_bus();
    const std::string node = past.name_of(frame.source);
    const std::string value = words_text(frame.arguments);
    const aesl::Script* const script = past.script_of(frame.source);
    const Emitters from =
        script != nullptr ? emitters_of(*script, past.project().common, frame.event) : Emitters{};
    const auto place = [&](int line) {
        return fmt::format("{}:{}", rerun_.about().project, script->first_line + line - 1);
    };
    Link link{frame.at, fmt::format("{} sent {}", node, frame.event), "", value};
    if (from.lines.size() == 1) {
        link.what += ", probably from here";
        link.place = place(*from.lines.begin());
        link.guessed = true;
    }
    if (!add(std::move(link)) || from.sections.size() != 1) return;
    const Section& section = *from.sections.begin();
    Link before{frame.at, fmt::format("the script of {} probably began", node), "", ""};
    before.guessed = true;
    if (section.kind == Section::Kind::Init) {
        add(std::move(before));
        return;
    }
    before.place = place(section.line);
    if (!is_global(past.project().common, section.name)) {
        before.what = fmt::format("{} probably felt {}", node, section.name);
        add(std::move(before));
        return;
    }
    const uint32_t heard = bus_->last_event(section.name, number);
    const BusCauses::Frame* const cause = bus_->frame(heard);
    if (cause == nullptr) return;
    before.at = cause->at;
    before.what = fmt::format("{} probably heard {}", node, section.name);
    before.value = words_text(cause->arguments);
    if (add(std::move(before))) this->frame(heard);
}

// What no frame tells; nothing if one may.
std::optional<Error> Walk::not_in_frames(const Question& question) const {
    const PastBus* const past = rerun_.past_bus();
    if (past == nullptr) return std::nullopt;
    if (question.about == About::Motor) {
        return Error{Code::Refused,
                     "this is a recording of a real bus: what commanded the wheels of a robot is "
                     "in no frame; ask for the event that its nodes heard, as event NAME, or for "
                     "an actor of the plan"};
    }
    if (question.about != About::Variable) return std::nullopt;
    for (const auto& [id, name] : past->node_names()) {
        if (!question.name.starts_with(name + ".")) continue;
        return Error{Code::Refused,
                     fmt::format("this is a recording of a real bus: what wrote {} is in no frame; "
                                 "its values, as far as {} told them, are in the channel "
                                 "/node/{}/variables; ask for an event, as event NAME",
                                 question.name, name, name)};
    }
    return std::nullopt;
}

}  // namespace vagus::record
