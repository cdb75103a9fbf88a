#include "serve/workbench/why_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "serve/edit/text_places.hpp"
#include "serve/runner/why_host.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kTextMax = 1000, kPlaceMax = 1200, kElementMax = 256;

std::string text_in(const Json& link, const char* key, size_t most) {
    return line_of(link.value(key, ""), most);
}

// One path is the end of the other, from a folder on.
bool is_end_of(const std::string& end, const std::string& path) {
    return path == end || path.ends_with("/" + end);
}

}  // namespace

WhyDesk::WhyDesk(Desk& desk, Files& files, Scripts& scripts, std::string program, Run run)
    : files_(files), scripts_(scripts), program_(std::move(program)), run_(std::move(run)) {
    desk.command("why.ask", [this](const Call& call) { ask(call); });
}

void WhyDesk::ask(const Call& call) {
    const bool needs_name = call.in["about"] != "end";
    if (needs_name && call.in.value("name", "").empty()) {
        return call.fail("bad_input",
                         "in.name: expected the name of what is asked about, found "
                         "none");
    }
    if (asked_.size() + flushing_ >= kWhysAtOnce) {
        return call.fail(
            "limit", fmt::format("{} questions are being answered; wait for them", kWhysAtOnce));
    }
    const auto file = run_.file();
    if (!file.ok()) return call.fail(file.error());
    ++flushing_;
    run_.flush([this, call, path = file.value()] {
        --flushing_;
        start(call, path);
    });
}

void WhyDesk::start(const Call& call, const std::string& file) {
    auto child = Child::start({.program = program_,
                               .arguments = {"why-host"},
                               .name = "vagus",
                               .memory_max = kWhyMemoryMax});
    if (!child.ok()) return call.fail(child.error());
    Json question = Json::array({call.in["about"]});
    if (call.in["about"] != "end") question.push_back(call.in["name"]);
    Json asked = {{"file", file}, {"question", std::move(question)}};
    if (call.in.contains("t")) asked["at"] = call.in["t"];
    child.value().pipe().send(kWhyAsked, asked.dump());
    asked_.push_back({call, std::move(child.value()), std::nullopt});
}

void WhyDesk::tick(Time now) {
    now_ = now;
    std::erase_if(asked_, [&](Asked& one) { return look(one, now); });
}

Time WhyDesk::next_tick() const {
    return asked_.empty() ? Time::max() : now_ + kWhyLookEvery;
}

// True: it is answered, or waited for no longer.
bool WhyDesk::look(Asked& asked, Time now) {
    if (!asked.until) asked.until = now + kWhyWithin;
    Pipe& pipe = asked.child.pipe();
    pipe.flush();
    for (const Packet& packet : pipe.receive()) {
        answer(asked.call, packet.bytes);
        return true;
    }
    if (const auto ended = asked.child.ended(); ended || pipe.closed()) {
        const std::string what = ended ? ended->what : "has gone";
        asked.call.fail("failed", "the run could not be run again: its process " + what);
        return true;
    }
    if (now < *asked.until) return false;
    constexpr auto kSeconds = std::chrono::duration_cast<std::chrono::seconds>(kWhyWithin).count();
    asked.call.fail("timeout", fmt::format("to run this run again takes longer than {} s; ask "
                                           "`vagus why` in a terminal",
                                           kSeconds));
    return true;
}

void WhyDesk::answer(const Call& call, const std::string& text) {
    const Json answered = Json::parse(text, nullptr, false);
    if (!answered.is_object()) return call.fail("failed", "the answer cannot be read");
    if (answered.contains("error")) {
        return call.fail("not_found", answered["error"].get<std::string>());
    }
    Json chain = Json::array();
    for (const Json& link : answered.value("chain", Json::array())) {
        const std::string place = text_in(link, "place", kPlaceMax);
        Json shown = {{"t", link["t"]},
                      {"what", text_in(link, "what", kTextMax)},
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
    call.done({{"chain", std::move(chain)}});
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
