#include "serve/edit/event_names.hpp"

#include <algorithm>
#include <array>

#include "serve/edit/edited_project.hpp"

namespace vagus::serve {

namespace {

using Path = std::vector<JsonStep::Key>;

constexpr std::array<std::string_view, 3> kBusTemplates = {"Send", "Receive", "OnEvent"};
constexpr std::array<std::string_view, 5> kWorkEvents = {"start", "stop", "stopped", "alive",
                                                         "ended"};

Path below(Path path, JsonStep::Key key) {
    path.push_back(std::move(key));
    return path;
}

const std::vector<JsonMember>& members_of(const JsonValue& json, std::string_view key) {
    static const std::vector<JsonMember> kNone;
    const JsonValue* found = json.find(key);
    return found && found->kind == JsonKind::Object ? found->members : kNone;
}

bool is_text(const JsonValue* json, std::string_view text) {
    return json && json->kind == JsonKind::String && json->text == text;
}

class Renaming {
public:
    explicit Renaming(const EventName& name) : name_(name) {}

    void plan(const JsonValue& json) {
        if (const JsonValue* start = json.find("start")) supervisors(*start, {"start"});
        for (const JsonMember& actor : members_of(json, "actors")) {
            const Path path = {"actors", actor.key};
            element(actor.value, path);
            supervisors(actor.value, path);
        }
    }
    void toolbox(const JsonValue& json) {
        for (const JsonMember& one : members_of(json, "templates")) {
            const Path path = {"templates", one.key};
            for (const std::string_view key : kWorkEvents) {
                name_at(one.value, std::string(key), path);
            }
            for (const char* list : {"states", "events"}) {
                for (const JsonMember& outcome : members_of(one.value, list)) {
                    name_at(outcome.value, "event", below(below(path, list), outcome.key));
                }
            }
        }
    }
    std::vector<JsonStep> take() { return std::move(steps_); }

private:
    void supervisors(const JsonValue& owner, const Path& path) {
        for (const JsonMember& one : members_of(owner, "supervisors")) {
            element(one.value, below(below(path, "supervisors"), one.key));
        }
    }
    // A formula: its text is in quotes of either kind.
    void element(const JsonValue& json, const Path& path) {
        const JsonValue* of = json.find("template");
        const JsonValue* in = json.find("in");
        const bool bus = std::any_of(kBusTemplates.begin(), kBusTemplates.end(),
                                     [&](std::string_view one) { return is_text(of, one); });
        if (!bus || !in) return;
        for (const char* quote : {"'", "\""}) {
            if (is_text(in->find("event"), quote + name_.from + quote)) {
                set(below(below(path, "in"), "event"), quote + name_.to + quote);
            }
        }
    }
    void name_at(const JsonValue& json, const std::string& key, const Path& path) {
        if (is_text(json.find(key), name_.from)) set(below(path, key), name_.to);
    }
    void set(Path path, const std::string& text) {
        steps_.push_back({JsonStep::Do::Set, std::move(path), json_string(text)});
    }

    const EventName& name_;
    std::vector<JsonStep> steps_;
};

}  // namespace

std::vector<JsonStep> renamed_event(std::string_view text, std::string_view kind,
                                    const EventName& name) {
    const auto read = read_json(text);
    const JsonValue* json = std::get_if<JsonValue>(&read);
    if (!json) return {};
    Renaming renaming(name);
    if (kind == "plan") renaming.plan(*json);
    if (kind == "toolbox") renaming.toolbox(*json);
    return renaming.take();
}

bool is_toolbox_of(const std::string& toolbox, std::string_view text, const std::string& script) {
    const auto read = read_json(text);
    const JsonValue* json = std::get_if<JsonValue>(&read);
    const JsonValue* project = json ? json->find("project") : nullptr;
    return project && project->kind == JsonKind::String &&
           path_from(toolbox, project->text) == script;
}

}  // namespace vagus::serve
