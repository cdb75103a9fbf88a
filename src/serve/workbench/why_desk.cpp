#include "serve/workbench/why_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "serve/edit/text_places.hpp"
#include "serve/project/paths.hpp"
#include "serve/runner/why_host.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kTextMax = 1000, kPlaceMax = 1200, kElementMax = 256;

std::string text_in(const Json& link, const char* key, size_t most) {
    return line_of(link.value(key, ""), most);
}

}  // namespace

WhyDesk::WhyDesk(Desk& desk, Files& files, Scripts& scripts, std::string program, ShownRun run)
    : files_(files),
      scripts_(scripts),
      questions_({.program = std::move(program),
                  .verb = "why-host",
                  .kind = kWhyAsked,
                  .memory_max = kWhyMemoryMax,
                  .within = kWhyWithin,
                  .look_every = kWhyLookEvery,
                  .refused = "not_found",
                  .died = "the run could not be run again",
                  .late = fmt::format("to run this run again takes longer than {} s; ask "
                                      "`vagus why` in a terminal",
                                      seconds_of(kWhyWithin))},
                 kWhysAtOnce, std::move(run)) {
    desk.command("why.ask", [this](const Call& call) { ask(call); });
}

void WhyDesk::ask(const Call& call) {
    const bool needs_name = call.in["about"] != "end";
    if (needs_name && call.in.value("name", "").empty()) {
        return call.fail("bad_input",
                         "in.name: expected the name of what is asked about, found "
                         "none");
    }
    Json question = Json::array({call.in["about"]});
    if (call.in["about"] != "end") question.push_back(call.in["name"]);
    Json asked = {{"question", std::move(question)}};
    if (call.in.contains("t")) asked["at"] = call.in["t"];
    if (call.in.contains("robot")) asked["robot"] = call.in["robot"];
    questions_.ask(call, std::move(asked),
                   [this, call](const Json& answer) { tell(call, answer); });
}

void WhyDesk::tell(const Call& call, const Json& answered) {
    call.done({{"chain", shown_chain(answered.value("chain", Json::array()))}});
}

Json WhyDesk::shown_chain(const Json& links) {
    Json chain = Json::array();
    for (const Json& link : links) {
        const std::string place = text_in(link, "place", kPlaceMax);
        const std::string robot = link.value("robot", "");
        const std::string what = (robot.empty() ? "" : robot + ": ") + link.value("what", "");
        Json shown = {{"t", link["t"]},
                      {"what", line_of(what, kTextMax)},
                      {"value", text_in(link, "value", kTextMax)},
                      {"place", place},
                      {"root", link["root"]}};
        if (const auto spot = spot_of(place)) {
            shown["doc"] = spot->doc;
            if (spot->line > 0) shown["line"] = spot->line;
        }
        const std::string element = text_in(link, "element", kElementMax);
        if (!element.empty()) shown["element"] = element;
        chain.push_back(std::move(shown));
    }
    return chain;
}

// ---- places ----

// Names of a recording count from the folder around all that its run read, which may be another
// than that of the project.
std::string WhyDesk::path_of(const std::string& name) {
    bool more = false;
    std::string best;
    for (const FileInfo& file : files_.list(more)) {
        if (file.kind == "folder") continue;
        if (!is_end_of(file.path, name) && !is_end_of(name, file.path)) continue;
        if (file.path.size() > best.size()) best = file.path;
    }
    return best;
}

std::optional<WhyDesk::Spot> WhyDesk::spot_of(const std::string& place) {
    const size_t colon = place.rfind(':');
    const bool has_line = colon != std::string::npos;
    const std::string path = path_of(place.substr(0, colon));
    if (path.empty()) return std::nullopt;
    Spot spot{path};
    if (has_line) {
        (void)std::from_chars(place.data() + colon + 1, place.data() + place.size(), spot.line);
    }
    if (!path.ends_with(".aesl")) return spot;
    for (const Scripts::LinesOf& lines : scripts_.lines_in(path)) {
        if (spot.line < lines.first || spot.line > lines.last) continue;
        return Spot{lines.doc, spot.line - lines.first + 1};
    }
    return spot;
}

}  // namespace vagus::serve
