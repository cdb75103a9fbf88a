// What a chain of why.hpp tells of a real bus: as far as frames tell. Nobody has seen the scripts
// of its nodes run; where a script has only one place from which something can have come, that is
// told, and marked as guessed.
#include <fmt/format.h>

#include <algorithm>

#include "aesl/project.hpp"
#include "record/emitters.hpp"
#include "record/past_bus.hpp"
#include "record/why_walk.hpp"

namespace vagus::record {

namespace {

bool is_global(const aesl::CommonDefinitions& common, const std::string& event) {
    return std::ranges::any_of(common.events,
                               [&event](const auto& one) { return one.name == event; });
}

}  // namespace

void Walk::frame_of_bus_node(uint32_t number, const BusCauses::Frame& frame) {
    const PastBus& past = *rerun_.past_bus();
    const std::string node = past.name_of(frame.source);
    const std::string value = words_text(frame.arguments);
    const auto [script, common, file, is_attached] = past.script_of(frame.source, frame.at);
    const Emitters from =
        script != nullptr ? emitters_of(*script, *common, frame.event) : Emitters{};
    const auto place = [&file = file, script = script](int line) {
        return fmt::format("{}:{}", file, script->first_line + line - 1);
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
    if (!is_global(*common, section.name)) {
        before.what = fmt::format("{} probably felt {}", node, section.name);
        add(std::move(before));
        return;
    }
    const uint32_t heard = bus_->last_event_heard(section.name, number);
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
    for (const auto& [id, name] : past->labels()) {
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
