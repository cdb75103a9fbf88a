#include "serve/edit/script_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "aesl/limits.hpp"
#include "aesl/listing.hpp"
#include "aesl/mentions.hpp"
#include "base/text.hpp"
#include "serve/edit/doc_finding.hpp"
#include "serve/edit/edited_project.hpp"
#include "serve/edit/seen.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kItemsMax = 2000;
constexpr size_t kHandlersMax = 1000;
constexpr size_t kPartsMax = 1000;
constexpr size_t kFilesShownMax = 200;
constexpr size_t kDefinitionsMax = 65536;
constexpr size_t kChangedMax = 2000;
constexpr int kArguments = aesl::kEventArgumentsMax;

// An event cannot have any number of arguments.
bool is_too_long(const Call& call) {
    const int value = call.in["value"];
    if (call.in["kind"] != "event" || (value >= 0 && value <= kArguments)) return false;
    call.fail("bad_input", fmt::format("an event has 0 to {} arguments", kArguments));
    return true;
}

Json suggestion_json(const Suggestion& one) {
    return {{"label", line_of(one.label, 200)},
            {"kind", one.kind},
            {"detail", line_of(one.detail, 300)},
            {"help", utf8_prefix(one.help, 1000)},
            {"insert", line_of(one.insert, 400)}};
}

Json definition_json(const std::string& name, int32_t value) {
    return {{"name", line_of(name, 128)}, {"value", std::clamp(value, -32768, 65535)}};
}

Json meter(size_t used, size_t of) {
    return {{"used", std::min<size_t>(used, 65535)}, {"of", std::min<size_t>(of, 65535)}};
}

// The line of each handler and sub, by name.
std::map<std::pair<aesl::MentionKind, std::string>, int> heads_of(const CompiledScript& script) {
    std::map<std::pair<aesl::MentionKind, std::string>, int> lines;
    for (const auto& mention : aesl::mentions(script.source, script.common)) {
        const bool sub = mention.kind == aesl::MentionKind::Sub && mention.declares;
        if (sub || mention.handles)
            lines.emplace(std::pair(mention.kind, mention.name), mention.at.line);
    }
    return lines;
}

Json handlers_of(const CompiledScript& script) {
    Json list = Json::array();
    const auto heads = heads_of(script);
    for (const aesl::Part& part :
         aesl::parts_of(script.result.program, script.target, script.common)) {
        if (list.size() >= kHandlersMax) break;
        const bool sub = part.kind == aesl::Part::Kind::Sub;
        const auto head =
            heads.find({sub ? aesl::MentionKind::Sub : aesl::MentionKind::Event, part.name});
        const bool init = part.kind == aesl::Part::Kind::Init;
        list.push_back({{"kind", init  ? "init"
                                 : sub ? "sub"
                                       : "event"},
                        {"name", line_of(part.name, 128)},
                        {"line", init || head == heads.end() ? 0 : head->second},
                        {"words", part.words}});
    }
    return list;
}

std::set<int> code_lines_of(const aesl::Program& program) {
    std::set<int> lines(program.lines.begin(), program.lines.end());
    lines.erase(0);
    return lines;
}

std::string stem_of(const std::string& path) {
    const size_t slash = path.rfind('/');
    const std::string name = path.substr(slash == path.npos ? 0 : slash + 1);
    return name.substr(0, name.find('.'));
}

}  // namespace

ScriptDesk::ScriptDesk(Desk& desk, Files& files, Scripts& scripts, std::string epoch,
                       FilesOfProject files_of_project)
    : desk_(desk),
      files_(files),
      scripts_(scripts),
      epoch_(std::move(epoch)),
      files_of_project_(std::move(files_of_project)) {
    desk_.topics().document("script", [this](const Json& of) { return script_document(of); });
    desk_.topics().document("scripts", [this](const Json&) { return scripts_document(); });
    declare_questions();
    declare_changes();
}

void ScriptDesk::declare_questions() {
    desk_.command("script.complete", [this](const Call& call) { complete(call); });
    desk_.command("script.hover", [this](const Call& call) { hover(call); });
    desk_.command("script.definition", [this](const Call& call) { definition(call); });
    desk_.command("script.references", [this](const Call& call) { references(call); });
    desk_.command("script.listing", [this](const Call& call) { listing(call); });
    desk_.command("script.format_name", [this](const Call& call) { format_name(call); });
}

// A command that changes texts.
void ScriptDesk::on_change(const std::string& name, std::function<void(const Call&)> obey) {
    desk_.command(name, [this, obey = std::move(obey)](const Call& call) {
        if (seen_all(call, files_, epoch_)) obey(call);
    });
}

void ScriptDesk::declare_changes() {
    on_change("script.rename", [this](const Call& call) { rename(call); });
    on_change("define.add", [this](const Call& call) {
        if (is_too_long(call)) return;
        call.answer(scripts_.add(call.in["file"], call.in["kind"], call.in["name"],
                                 call.in["value"], made_for(call.member)));
    });
    on_change("define.change", [this](const Call& call) { change(call); });
    on_change("define.remove", [this](const Call& call) {
        call.answer(scripts_.remove(call.in["file"], call.in["kind"], call.in["name"],
                                    made_for(call.member)));
    });
    on_change("define.move", [this](const Call& call) {
        call.answer(scripts_.move(call.in["file"], call.in["kind"], call.in["name"], call.in["to"],
                                  made_for(call.member)));
    });
}

void ScriptDesk::text_changed(const std::string& path) {
    desk_.topics().touch("script");
    if (kind_of_file(path) == "script" || kind_of_file(path) == "other") {
        desk_.topics().touch("scripts");
    }
}

void ScriptDesk::project_changed() {
    desk_.topics().touch("script");
    desk_.topics().touch("scripts");
}

void ScriptDesk::tick() {
    if (targets_ == scripts_.generation()) return;
    targets_ = scripts_.generation();
    desk_.topics().touch("script");
}

// ---- questions ----

const CompiledScript* ScriptDesk::script_of(const Call& call) {
    const std::string doc = call.in["doc"];
    const CompiledScript* script = scripts_.compiled(doc);
    if (!script) call.fail("not_found", doc + ": there is no such script");
    return script;
}

void ScriptDesk::complete(const Call& call) {
    const CompiledScript* script = script_of(call);
    if (!script) return;
    const TextPlaces places(script->source);
    const Suggestions found =
        serve::complete(script->view(), places.byte_of(position_of(call.in["at"])));
    Json items = Json::array();
    for (const Suggestion& one : found.items) {
        if (items.size() < kItemsMax) items.push_back(suggestion_json(one));
    }
    call.done(
        {{"from", serve::json_of(places.position_of(found.from))}, {"items", std::move(items)}});
}

void ScriptDesk::hover(const Call& call) {
    const CompiledScript* script = script_of(call);
    if (!script) return;
    const auto found = serve::hover(script->view(), position_of(call.in["at"]));
    if (!found) return call.done({{"found", false}});
    call.done({{"found", true},
               {"at", serve::json_of(found->at)},
               {"end", serve::json_of(found->end)},
               {"title", line_of(found->title, 300)},
               {"help", utf8_prefix(found->help, 2000)}});
}

Json ScriptDesk::spots_of(const std::vector<Spot>& spots, size_t most) {
    Json list = Json::array();
    std::map<std::string, std::string> texts;
    for (const Spot& spot : spots) {
        if (list.size() >= most) break;
        if (!texts.contains(spot.doc)) {
            const auto opened = files_.open(spot.doc);
            texts[spot.doc] = opened.ok() ? opened.value().text : "";
        }
        const std::string_view line =
            line_at(texts[spot.doc], static_cast<size_t>(std::max(spot.at.line, 1)));
        list.push_back({{"doc", spot.doc},
                        {"at", serve::json_of(spot.at)},
                        {"end", serve::json_of(spot.end)},
                        {"line_text", line_of(line, 400)}});
    }
    return list;
}

void ScriptDesk::definition(const Call& call) {
    if (!script_of(call)) return;
    const auto spots = scripts_.definition(call.in["doc"], position_of(call.in["at"]));
    call.done({{"spots", spots_of(spots, 16)}});
}

void ScriptDesk::references(const Call& call) {
    if (!script_of(call)) return;
    const auto found = scripts_.references(call.in["doc"], position_of(call.in["at"]));
    if (!found) return call.done({{"name", ""}, {"spots", Json::array()}});
    call.done({{"name", line_of(found->name, 200)}, {"spots", spots_of(found->spots, 5000)}});
}

void ScriptDesk::listing(const Call& call) {
    const CompiledScript* script = script_of(call);
    if (!script) return;
    Json lines = Json::array();
    for (const aesl::ListedInstruction& one :
         aesl::instructions(script->result.program, script->target, script->common)) {
        lines.push_back({{"line", one.line},
                         {"address", one.address},
                         {"words", one.words},
                         {"text", line_of(one.text, 200)}});
    }
    call.done({{"lines", std::move(lines)}});
}

void ScriptDesk::format_name(const Call& call) {
    const aesl::Target nothing;
    const aesl::CommonDefinitions none;
    const std::string fault = fault_of_name({"", nothing, none}, call.in["name"]);
    if (fault.empty()) return call.done({{"good", true}});
    call.done({{"good", false}, {"why", line_of(fault, 300)}});
}

// ---- changes ----

void ScriptDesk::rename(const Call& call) {
    if (!script_of(call)) return;
    const std::string doc = call.in["doc"];
    const auto at = position_of(call.in["at"]);
    const std::string by = made_for(call.member);
    std::set<std::string> docs;
    std::optional<EventName> event;  // of the project
    const std::string file = doc.substr(0, doc.rfind('#'));
    if (const auto found = scripts_.references(doc, at)) {
        for (const Spot& spot : found->spots) docs.insert(spot.doc);
        const bool shared = found->owner == Owner::Project;
        if (shared && file != doc) docs.insert(file);
        if (shared && found->kind == aesl::MentionKind::Event) event = {found->name, call.in["to"]};
    }
    const auto renamed = scripts_.rename(doc, at, call.in["to"], by);
    if (!renamed.ok()) return call.fail(renamed.error());
    size_t places = renamed.value();
    if (event) {
        for (const std::string& one : rename_elsewhere(file, *event, by, places)) docs.insert(one);
    }
    Json changed = Json::array();
    for (const std::string& one : docs) {
        if (changed.size() < kChangedMax) changed.push_back(one);
    }
    call.done({{"changed", std::move(changed)}, {"places", places}});
}

// Plans and toolboxes name events, too. Gives the files that were changed.
std::vector<std::string> ScriptDesk::rename_elsewhere(const std::string& file,
                                                      const EventName& name, const std::string& by,
                                                      size_t& places) {
    const std::set<std::string> project = files_of_project_();
    const bool still_there = is_declared_elsewhere(file, name.from, project);
    std::vector<std::string> changed;
    for (const std::string& path : project) {
        const std::string kind = kind_of_file(path);
        if (kind != "plan" && kind != "toolbox") continue;
        const auto text = files_.text(path);
        if (!text.ok()) continue;
        const bool meant = kind == "plan" ? !still_there : is_toolbox_of(path, text.value(), file);
        const auto steps = renamed_event(text.value(), kind, name);
        if (!meant || steps.empty()) continue;
        auto after = patched(text.value(), {kind, path}, steps);
        if (!after.ok() || !files_.replace(path, std::move(after.value()), by).ok()) continue;
        places += steps.size();
        changed.push_back(path);
    }
    return changed;
}

// Plans that name it may mean the event of those other scripts.
bool ScriptDesk::is_declared_elsewhere(const std::string& file, const std::string& event,
                                       const std::set<std::string>& project) {
    for (const ScriptPart& part : scripts_.parts()) {
        if (part.file == file || !project.contains(part.file)) continue;
        const CompiledScript* script = scripts_.compiled(part.doc);
        if (!script) continue;
        const auto& events = script->common.events;
        const bool declared = std::any_of(events.begin(), events.end(),
                                          [&](const auto& one) { return one.name == event; });
        if (declared) return true;
    }
    return false;
}

void ScriptDesk::change(const Call& call) {
    if (is_too_long(call)) return;
    const std::string file = call.in["file"];
    const EventName name = {call.in["name"], call.in["to"]};
    const std::string by = made_for(call.member);
    const auto changed =
        scripts_.change(file, call.in["kind"], name.from, name.to, call.in["value"], by);
    if (!changed.ok()) return call.fail(changed.error());
    size_t places = changed.value();
    std::vector<std::string> others;
    if (call.in["kind"] == "event" && name.from != name.to) {
        others = rename_elsewhere(file, name, by, places);
    }
    if (others.size() > kChangedMax) others.resize(kChangedMax);
    call.done({{"places", places}, {"others", others}});
}

// ---- topics ----

Json ScriptDesk::script_document(const Json& of) {
    const std::string doc = of["doc"];
    const CompiledScript* script = scripts_.compiled(doc);
    if (!script) {
        return {{"version", 0},
                {"good", false},
                {"node", ""},
                {"for", ""},
                {"bytecode", meter(0, 0)},
                {"variables", meter(0, 0)},
                {"stack", meter(0, 0)},
                {"handlers", Json::array()},
                {"code_lines", Json::array()}};
    }
    const auto part = std::find_if(scripts_.parts().begin(), scripts_.parts().end(),
                                   [&](const ScriptPart& one) { return one.doc == doc; });
    const aesl::Target& target = script->target;
    const aesl::Used& used = script->result.program.used;
    return {{"version", script->version},
            {"good", script->result.ok()},
            {"node", line_of(part == scripts_.parts().end() ? "" : part->node, 128)},
            {"for", line_of(target.name, 200)},
            {"bytecode", meter(used.bytecode, target.bytecode_size)},
            {"variables", meter(used.variables, target.variables_size)},
            {"stack", meter(used.stack, target.stack_size)},
            {"handlers", handlers_of(*script)},
            {"code_lines", code_lines_of(script->result.program)}};
}

Json ScriptDesk::scripts_document() {
    Json parts = Json::array();
    std::vector<std::string> paths;
    for (const ScriptPart& part : scripts_.parts()) {
        if (parts.size() >= kPartsMax) break;
        const std::string name = part.node.empty() ? stem_of(part.file) : part.node;
        parts.push_back({{"doc", part.doc},
                         {"name", line_of(name, 128)},
                         {"node", std::min<int>(part.node_id, 65534)},
                         {"file", part.file}});
        if (part.doc != part.file && (paths.empty() || paths.back() != part.file)) {
            paths.push_back(part.file);
        }
    }
    Json files = Json::array();
    for (const std::string& path : paths) {
        const aesl::CommonDefinitions* common = scripts_.common(path);
        if (!common || files.size() >= kFilesShownMax) continue;
        Json events = Json::array();
        Json constants = Json::array();
        for (const auto& event : common->events) {
            if (events.size() < kDefinitionsMax) {
                events.push_back(definition_json(event.name, event.size.value_or(0)));
            }
        }
        for (const auto& constant : common->constants) {
            if (constants.size() < kDefinitionsMax) {
                constants.push_back(definition_json(constant.name, constant.value));
            }
        }
        files.push_back(
            {{"path", path}, {"events", std::move(events)}, {"constants", std::move(constants)}});
    }
    return {{"parts", std::move(parts)}, {"files", std::move(files)}};
}

}  // namespace vagus::serve
