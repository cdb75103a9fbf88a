#include "serve/edit/template_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/json.hpp"
#include "plan/formula.hpp"
#include "serve/edit/doc_finding.hpp"
#include "serve/edit/json_patch.hpp"
#include "serve/edit/own_script.hpp"
#include "serve/edit/seen.hpp"
#include "toolbox/toolbox_file.hpp"

namespace vagus::serve {

namespace {

constexpr int kToolboxesTried = 100;

Error refused(std::string what) {
    return Error{Code::Refused, std::move(what)};
}

// A member of a JSON text that is a string; empty if there is none.
std::string text_at(const std::string& text, std::string_view key) {
    const auto json = read_json(text);
    const auto* root = std::get_if<JsonValue>(&json);
    const JsonValue* found = root ? root->find(key) : nullptr;
    return found && found->kind == JsonKind::String ? found->text : "";
}

}  // namespace

TemplateDesk::TemplateDesk(Desk& desk, Files& files, Scripts& scripts, Findings& findings,
                           const EditedProject& project, const EditListeners& listeners,
                           std::string epoch)
    : files_(files),
      scripts_(scripts),
      findings_(findings),
      project_(project),
      listeners_(listeners),
      epoch_(std::move(epoch)) {
    desk.command("template.new", [this](const Call& call) { make(call); });
}

void TemplateDesk::make(const Call& call) {
    if (!seen_all(call, files_, epoch_)) return;
    const std::string doc = call.in["script"];
    const auto part = std::ranges::find_if(scripts_.parts(),
                                           [&](const ScriptPart& one) { return one.doc == doc; });
    if (part == scripts_.parts().end()) {
        return call.fail("not_found",
                         fmt::format("{}: there is no such script in the project", doc));
    }
    OwnTemplate of{call.in["name"], call.in["kind"] == "supervisor", call.in["help"], part->node};
    const Status good = check_name(of);
    if (!good.ok()) return call.fail(good.error());
    const ScriptPart chosen = *part;
    const auto change = change_of(chosen, of);
    if (!change.ok()) return call.fail(change.error());
    const Status written = write(change.value(), made_for(call.member));
    if (!written.ok()) return call.fail(written.error());
    call.done({{"toolbox", change.value().toolbox},
               {"at", json_of(aesl::Position{change.value().line, 1})}});
}

Status TemplateDesk::check_name(const OwnTemplate& of) {
    if (!plan::is_name(of.name)) {
        return Error{Code::BadInput,
                     fmt::format("“{}” cannot be the name of a template: letters, digits and _ "
                                 "only, not beginning with a digit",
                                 of.name)};
    }
    for (const plan::Toolbox& toolbox : findings_.toolboxes().library->templates().toolboxes()) {
        for (const plan::Template& one : toolbox.templates) {
            if (one.name != of.name) continue;
            return refused(
                fmt::format("the toolbox {} has a template “{}” already; take another "
                            "name",
                            toolbox.name, of.name));
        }
    }
    return Status::done();
}

Result<TemplateDesk::Change> TemplateDesk::change_of(const ScriptPart& part,
                                                     const OwnTemplate& of) {
    if (project_.project_file.empty()) {
        return refused(
            "a template of one's own needs a project, and this file was opened alone; open a "
            "folder with a vagus.json");
    }
    Change change;
    TRY(add_script(part, of, change));
    const std::string toolbox = toolbox_for(part.file);
    if (toolbox.empty()) {
        TRY(make_toolbox(part.file, of, change));
        TRY(list_toolbox(change));
    } else {
        change.new_file.clear();
        TRY(add_to_toolbox(toolbox, of, change));
    }
    return change;
}

Status TemplateDesk::add_script(const ScriptPart& part, const OwnTemplate& of, Change& change) {
    OwnScript made = TRY(own_script(part, of, files_, scripts_));
    change.texts[part.file] = std::move(made.text);
    change.line = made.line;
    return Status::done();
}

// The project's own toolbox file whose events that file declares; empty: there is none.
std::string TemplateDesk::toolbox_for(const std::string& script_file) {
    for (const std::string& path : project_.toolboxes) {
        const auto text = files_.text(path);
        if (!text.ok() || path.ends_with(".so")) continue;
        if (path_from(path, text_at(text.value(), "project")) == script_file) return path;
    }
    return "";
}

Status TemplateDesk::add_to_toolbox(const std::string& path, const OwnTemplate& of,
                                    Change& change) {
    const std::string text = TRY(files_.text(path));
    change.toolbox = text_at(text, "name");
    change.texts[path] =
        TRY(patched(text, {"toolbox", path},
                    {{JsonStep::Do::Set, {std::string("templates"), of.name}, toolbox_entry(of)}}));
    return Status::done();
}

Status TemplateDesk::make_toolbox(const std::string& script_file, const OwnTemplate& of,
                                  Change& change) {
    const std::string folder = folder_of_path(project_.project_file);
    const plan::Library& library = findings_.toolboxes().library->templates();
    for (int number = 1; number <= kToolboxesTried; ++number) {
        const std::string name = number == 1 ? "own" : fmt::format("own{}", number);
        const std::string path = (folder.empty() ? "" : folder + "/") + name + ".toolbox.json";
        if (files_.exists(path) || library.find(name)) continue;
        change.toolbox = name;
        change.new_file = path;
        change.texts[path] = new_toolbox_file(name, name_from(path, script_file), of);
        return Status::done();
    }
    return Error{Code::Limit,
                 fmt::format("there are {} toolboxes own….toolbox.json already; delete "
                             "those that no plan uses",
                             kToolboxesTried)};
}

Status TemplateDesk::list_toolbox(Change& change) {
    const std::string& file = project_.project_file;
    const std::string text = TRY(files_.text(file));
    const auto json = read_json(text);
    const auto* root = std::get_if<JsonValue>(&json);
    if (!root) return refused(fmt::format("{} is not JSON; fix it first", file));
    const JsonValue* listed = root->find("toolboxes");
    const bool is_list = listed && listed->kind == JsonKind::Array;
    const JsonValue value = json_string(name_from(file, change.new_file));
    const JsonStep step =
        is_list ? JsonStep{JsonStep::Do::Insert,
                           {std::string("toolboxes"), listed->items.size()},
                           value}
                : JsonStep{JsonStep::Do::Set, {std::string("toolboxes")}, json_array({value})};
    change.texts[file] = TRY(patched(text, {"project", file}, {step}));
    return Status::done();
}

// A file that had nothing unsaved is saved, so that the folder is whole for others, too. What
// cannot be changed takes everything back that was.
Status TemplateDesk::write(const Change& change, const std::string& by) {
    if (!change.new_file.empty()) {
        TRY(files_.make(change.new_file, change.texts.at(change.new_file)));
    }
    std::map<std::string, std::string> before;
    std::vector<std::string> to_save;
    const auto replace = [&](const std::string& path, const std::string& text) -> Status {
        const DocumentView view = TRY(files_.open(path));
        (void)TRY(files_.replace(path, text, by));
        before[path] = view.text;
        if (!view.unsaved) {
            to_save.push_back(path);
            TRY(files_.save(path));
        }
        return Status::done();
    };
    for (const auto& [path, text] : change.texts) {
        if (path == change.new_file) continue;
        const Status done = replace(path, text);
        if (done.ok()) continue;
        for (const auto& [changed, old] : before) {
            (void)files_.replace(changed, old, by);
            if (std::ranges::count(to_save, changed) > 0) (void)files_.save(changed);
        }
        if (!change.new_file.empty()) (void)files_.remove(change.new_file);
        return done;
    }
    for (const std::string& path : to_save) listeners_.saved(path);
    return Status::done();
}

}  // namespace vagus::serve
