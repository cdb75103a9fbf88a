#include "serve/edit/own_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace vagus::serve {

namespace {

// An actor counts signs of life of the plan, ten a second: no node lacks them, and no other handler
// of the script is in the way.
constexpr std::string_view kActor = R"(
# ---- {0}: the work of a plan's actor. A plan gives each start a token, and takes only answers
# with it.
onevent {1}.start
    {1}_token = {2}[0]
    {1}_signs = 0
    # The work begins here: switch something on, start a motor.

# The plan says ten times a second that it still wants this. If that stays away, the plan is gone.
onevent {1}.alive
    if {1}_token == {2}[0] then
        {1}_signs += 1
        # This one waits for half a second and ends. Write instead when yours is done.
        if {1}_signs == 5 then
            emit {1}.done {1}_token
        end
    end

# The plan wants it to end: stop what moves, then say so.
onevent {1}.stop
    {1}_token = 0
    emit {1}.stopped [{2}[0]]
)";

constexpr std::string_view kSupervisor = R"(
# ---- {0}: what a plan's supervisor sees. A plan gives each watch a token, and takes only events
# with it.
onevent {1}.watch
    {1}_token = {2}[0]
    # It only counts how often it was asked to watch. Yours looks at something, and says so:
    #     emit {1}.raised {1}_token
    {1}_watches += 1

onevent {1}.unwatch
    if {1}_token == {2}[0] then
        {1}_token = 0
    end
)";

std::string variables_of(const OwnTemplate& of) {
    const std::string stem = stem_of(of);
    return fmt::format("var {0}_token = 0\nvar {0}_{1} = 0\n", stem,
                       of.is_supervisor ? "watches" : "signs");
}

// The beginning of the first line that declares a variable; of the text, if none does.
size_t first_variable(std::string_view script) {
    for (size_t at = 0; at < script.size();) {
        const std::string_view rest = script.substr(at);
        const size_t word = rest.find_first_not_of(" \t");
        if (word != rest.npos && rest.substr(word).starts_with("var ")) return at;
        const size_t end = rest.find('\n');
        if (end == rest.npos) break;
        at += end + 1;
    }
    return 0;
}

int line_of_text(std::string_view script, std::string_view wanted) {
    const size_t at = script.rfind(wanted);
    const auto before = script.substr(0, at == script.npos ? 0 : at);
    return static_cast<int>(std::count(before.begin(), before.end(), '\n')) + 1;
}

}  // namespace

std::string stem_of(const OwnTemplate& of) {
    std::string stem = of.name;
    if (!stem.empty())
        stem[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(stem[0])));
    return stem;
}

std::vector<aesl::GlobalEvent> events_of(const OwnTemplate& of) {
    const std::string stem = stem_of(of);
    std::vector<aesl::GlobalEvent> events;
    const std::vector<const char*> names =
        of.is_supervisor ? std::vector<const char*>{"watch", "unwatch", "raised"}
                         : std::vector<const char*>{"start", "alive", "stop", "stopped", "done"};
    for (const char* name : names) events.push_back({stem + "." + name, 1});
    return events;
}

JsonValue toolbox_entry(const OwnTemplate& of) {
    const std::string stem = stem_of(of);
    if (of.is_supervisor) {
        return json_object(
            {json_member("kind", "supervisor"), json_member("help", of.help),
             json_member("node", of.node), json_member("start", stem + ".watch"),
             json_member("stop", stem + ".unwatch"),
             json_member("events",
                         {json_member("Raised", {json_member("event", stem + ".raised")})})});
    }
    return json_object(
        {json_member("kind", "actor"), json_member("help", of.help), json_member("node", of.node),
         json_member("start", stem + ".start"), json_member("stop", stem + ".stop"),
         json_member("stopped", stem + ".stopped"), json_member("alive", stem + ".alive"),
         json_member("states", {json_member("Done", {json_member("event", stem + ".done")})})});
}

std::string new_toolbox_file(const std::string& toolbox, const std::string& script,
                             const OwnTemplate& of) {
    return format_json(json_object(
        {json_member("format", "vagus-toolbox/1"), json_member("name", toolbox),
         json_member("help", "Templates of this project."), json_member("project", script),
         json_member("templates", {json_member(of.name, toolbox_entry(of))})}));
}

FilledIn script_with(const std::string& script, const OwnTemplate& of) {
    const size_t at = first_variable(script);
    std::string whole = script.substr(0, at) + variables_of(of) + script.substr(at);
    if (!whole.ends_with('\n')) whole += '\n';
    const std::string_view handlers = of.is_supervisor ? kSupervisor : kActor;
    whole += fmt::format(fmt::runtime(handlers), of.name, stem_of(of), of.args);
    const int line =
        line_of_text(whole, of.is_supervisor ? "# It only counts" : "# The work begins here");
    return {std::move(whole), line};
}

}  // namespace vagus::serve
