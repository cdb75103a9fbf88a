#include "serve/edit/named_paths.hpp"

#include "serve/project/files.hpp"
#include "trial/test_file.hpp"

namespace vagus::serve {

namespace {

// As kind_of_file(), which has no word for tests: they are texts to everybody else.
std::string kind_of(const std::string& file) {
    return file.ends_with(trial::kTestEnding) ? "test" : kind_of_file(file);
}

class Collector {
public:
    explicit Collector(std::vector<NamedPath>& paths) : paths_(paths) {}

    void member(const JsonValue& object, const char* key, bool folder = false) {
        const JsonValue* json = object.find(key);
        if (!json) return;
        at_.emplace_back(key);
        if (json->kind == JsonKind::String && !json->text.empty()) {
            paths_.push_back({at_, json->text, {json->at.line, json->at.column}, folder});
        }
        at_.pop_back();
    }
    // Calls `look` with each item or member of a part of the object.
    template <typename Look>
    void each(const JsonValue& object, const char* key, const Look& look) {
        const JsonValue* json = object.find(key);
        if (!json) return;
        at_.emplace_back(key);
        for (size_t i = 0; i < json->items.size(); ++i) {
            at_.emplace_back(i);
            look(json->items[i]);
            at_.pop_back();
        }
        for (const JsonMember& one : json->members) {
            at_.emplace_back(one.key);
            look(one.value);
            at_.pop_back();
        }
        at_.pop_back();
    }
    void inside(const JsonValue& object, const char* key, const char* inner) {
        const JsonValue* json = object.find(key);
        if (!json) return;
        at_.emplace_back(key);
        member(*json, inner);
        at_.pop_back();
    }
    void list(const JsonValue& object, const char* key) {
        each(object, key, [this](const JsonValue& item) {
            if (item.kind == JsonKind::String && !item.text.empty()) {
                paths_.push_back({at_, item.text, {item.at.line, item.at.column}});
            }
        });
    }

private:
    std::vector<NamedPath>& paths_;
    std::vector<JsonStep::Key> at_;
};

}  // namespace

bool may_name_others(const std::string& file) {
    const std::string kind = kind_of(file);
    return kind == "project" || kind == "plan" || kind == "world" || kind == "toolbox" ||
           kind == "test";
}

std::vector<NamedPath> named_paths(const std::string& file, std::string_view text) {
    std::vector<NamedPath> paths;
    if (!may_name_others(file)) return paths;
    const auto read = read_json(text);
    const JsonValue* json = std::get_if<JsonValue>(&read);
    if (!json) return paths;
    Collector collect(paths);
    const std::string kind = kind_of(file);
    if (kind == "project") {
        for (const char* key : {"plan", "world"}) collect.member(*json, key);
        for (const char* key : {"scripts", "toolboxes"}) collect.list(*json, key);
    } else if (kind == "plan") {
        collect.each(*json, "actors",
                     [&](const JsonValue& actor) { collect.member(actor, "plan"); });
    } else if (kind == "world") {
        collect.each(*json, "robots", [&](const JsonValue& robot) {
            collect.member(robot, "script");
            collect.member(robot, "project", true);
        });
        collect.inside(*json, "ground", "image");
    } else if (kind == "test") {
        for (const char* key : {"plan", "world"}) collect.member(*json, key);
        for (const char* key : {"scripts", "toolboxes"}) collect.list(*json, key);
    } else {
        collect.member(*json, "project");
    }
    return paths;
}

}  // namespace vagus::serve
