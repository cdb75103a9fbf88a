// What exploration found, as lines for people and as JSON.
#include <fmt/format.h>

#include "plan/explore.hpp"

namespace vagus::plan {

std::string_view name_of(ExploreKind kind) {
    switch (kind) {
        case ExploreKind::Unreached:
            return "unreached";
        case ExploreKind::NoEnd:
            return "no-end";
        case ExploreKind::NoTime:
            return "no-time";
        case ExploreKind::NeverWins:
            return "never-wins";
        case ExploreKind::Unwritten:
            return "unwritten";
        case ExploreKind::EndlessCalls:
            return "endless-calls";
    }
    return {};
}

std::string_view name_of(ExploreStep::Kind kind) {
    switch (kind) {
        case ExploreStep::Kind::End:
            return "end";
        case ExploreStep::Kind::Return:
            return "return";
        case ExploreStep::Kind::Event:
            return "event";
        case ExploreStep::Kind::Call:
            return "call";
        case ExploreStep::Kind::Error:
            return "error";
        case ExploreStep::Kind::Skip:
            return "skip";
    }
    return {};
}

std::string format_text(const ExploreStep& step) {
    switch (step.kind) {
        case ExploreStep::Kind::End:
            return fmt::format("{} ends in {}: on to {}", step.element, step.outcome, step.target);
        case ExploreStep::Kind::Return:
            return fmt::format("{}'s sub-plan has ended with {}: on to {}", step.element,
                               step.outcome, step.target);
        case ExploreStep::Kind::Event:
            return fmt::format("{} raises {}: on to {}", step.element, step.outcome, step.target);
        case ExploreStep::Kind::Call:
            return fmt::format("{} begins its sub-plan with {}", step.element, step.target);
        case ExploreStep::Kind::Error:
            return fmt::format("{} fails, which ends its plan", step.element);
        case ExploreStep::Kind::Skip:
            return fmt::format("{} runs a sub-plan beyond the depth, which ends with {}",
                               step.element, step.outcome);
    }
    return {};
}

std::string format_text(const ExploreFinding& finding) {
    std::string text = fmt::format("{}: {}: {} [{}]\n", at_file(finding.file, finding.at),
                                   finding.element, finding.message, name_of(finding.kind));
    for (const ExploreStep& step : finding.path) {
        text += fmt::format("    {}: {}\n", step.plan, format_text(step));
    }
    return text;
}

std::string format_summary(const Exploration& exploration) {
    const auto count = [](size_t number, std::string_view one) {
        return fmt::format("{} {}{}", number, one, number == 1 ? "" : "s");
    };
    std::string text = fmt::format("{} seen, {} found", count(exploration.situations, "situation"),
                                   count(exploration.findings.size(), "thing"));
    if (!exploration.complete) {
        text +=
            "; there are more, and a limit was reached: what can never be reached, never end "
            "and never win is not told, and what is told may not be all";
    } else if (exploration.skipped) {
        text += fmt::format(
            "; sub-plans more than {} deep were taken as one step that may end in "
            "each of its states (--depth looks deeper)",
            exploration.depth);
    } else {
        text += "; these are all that there are";
    }
    return text + "\n";
}

namespace {

std::string json_of(const ExploreStep& step) {
    return fmt::format(
        "{{\"plan\": {}, \"kind\": \"{}\", \"element\": {}, \"outcome\": {}, \"target\": {}}}",
        json_quote(step.plan), name_of(step.kind), json_quote(step.element),
        json_quote(step.outcome), json_quote(step.target));
}

std::string json_of(const ExploreFinding& finding) {
    std::string text = fmt::format(
        "{{\"kind\": \"{}\", \"file\": {}, \"plan\": {}, \"element\": {}, \"line\": {}, "
        "\"column\": {}, \"message\": {}, \"path\": [",
        name_of(finding.kind), json_quote(finding.file), json_quote(finding.plan),
        json_quote(finding.element), finding.at.line, finding.at.column,
        json_quote(finding.message));
    for (const ExploreStep& step : finding.path) {
        text +=
            fmt::format("{}\n      {}", &step == &finding.path.front() ? "" : ",", json_of(step));
    }
    return text + "]}";
}

}  // namespace

std::string format_json(const Exploration& exploration) {
    std::string text = fmt::format(
        "{{\n  \"situations\": {},\n  \"trapped\": {},\n  \"complete\": {},\n  \"depth\": {},\n  "
        "\"skipped\": {},\n  \"findings\": [",
        exploration.situations, exploration.trapped, exploration.complete, exploration.depth,
        exploration.skipped);
    for (const ExploreFinding& finding : exploration.findings) {
        text += fmt::format("{}\n    {}", &finding == &exploration.findings.front() ? "" : ",",
                            json_of(finding));
    }
    return text + (exploration.findings.empty() ? "]\n}\n" : "\n  ]\n}\n");
}

}  // namespace vagus::plan
