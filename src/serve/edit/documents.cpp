#include "serve/edit/documents.hpp"

#include <fmt/format.h>

#include "serve/edit/json_patch.hpp"

namespace vagus::serve {

using Json = nlohmann::json;

namespace {

std::vector<TextChange> changes_of(const Json& list) {
    std::vector<TextChange> changes;
    for (const Json& one : list) changes.push_back({one["from"], one["to"], one["text"]});
    return changes;
}

// An edit that counts in a text that is not the one there is.
bool conflicts(const Call& call, const std::string& doc, const DocumentView& view) {
    const uint32_t version = call.in["version"];
    if (version == view.version) return false;
    call.fail("conflict", fmt::format("{}: the text is at version {} by now, the change is for {}; "
                                      "take the new text and change that",
                                      doc, view.version, version));
    return true;
}

// "project" for a vagus.json, else the language of the document.
std::string format_name(const std::string& path, const std::string& language) {
    return kind_of_file(path) == "project" ? "project" : language;
}

}  // namespace

Documents::Documents(Desk& desk, Files& files, const EditListeners& listeners)
    : desk_(desk), files_(files), listeners_(listeners) {
    desk_.board().document("doc", [this](const Json& of) { return doc_document(of); });
    desk_.board().document("files", [this](const Json&) { return files_document(); });
    declare_commands();
}

void Documents::declare_commands() {
    desk_.command("doc.open", [this](const Call& call) { open(call); });
    desk_.command("doc.edit", [this](const Call& call) { edit(call); });
    desk_.command("doc.patch", [this](const Call& call) { patch(call); });
    desk_.command("doc.save", [this](const Call& call) { save(call); });
    desk_.command("doc.save_all", [this](const Call& call) { save_all(call); });
    desk_.command("doc.revert", [this](const Call& call) {
        answer_version(call, files_.revert(call.in["doc"]));
    });
    desk_.command("doc.keep", [this](const Call& call) {
        const std::string doc = call.in["doc"];
        const bool mine = call.in["which"] == "mine";
        answer_version(call, mine ? files_.keep_mine(doc) : files_.revert(doc));
    });
}

void Documents::open(const Call& call) {
    const auto opened = files_.open(call.in["doc"]);
    if (!opened.ok()) return call.fail(opened.error());
    const DocumentView& view = opened.value();
    call.done({{"text", view.text},
               {"version", view.version},
               {"language", view.language},
               {"unsaved", view.unsaved}});
}

void Documents::edit(const Call& call) {
    const std::string doc = call.in["doc"];
    const auto opened = files_.open(doc);
    if (!opened.ok()) return call.fail(opened.error());
    if (conflicts(call, doc, opened.value())) return;
    const auto edited =
        files_.edit(doc, opened.value().version, changes_of(call.in["changes"]), call.member);
    if (!edited.ok()) return call.fail(edited.error());
    call.done({{"version", edited.value()}});
}

void Documents::patch(const Call& call) {
    const std::string doc = call.in["doc"];
    const auto opened = files_.open(doc);
    if (!opened.ok()) return call.fail(opened.error());
    if (conflicts(call, doc, opened.value())) return;
    const DocumentView& view = opened.value();
    const auto steps = read_steps(call.in["steps"]);
    if (!steps.ok()) return call.fail(steps.error());
    if (!doc.ends_with(".json")) {
        return call.fail("bad_input", doc + ": only JSON files are changed by their members");
    }
    const std::string language = format_name(doc, view.language);
    const auto text = patched(view.text, {language, doc}, steps.value());
    if (!text.ok()) return call.fail(text.error());
    if (text.value() == view.text) {
        return call.done({{"version", view.version}, {"text", view.text}});
    }
    const auto version = files_.replace(doc, text.value(), call.member);
    if (!version.ok()) return call.fail(version.error());
    call.done({{"version", version.value()}, {"text", text.value()}});
}

void Documents::save(const Call& call) {
    const std::string doc = call.in["doc"];
    const bool unsaved = files_.is_unsaved(doc);
    const Status saved = files_.save(doc);
    if (!saved.ok()) return call.fail(saved.error());
    if (unsaved) listeners_.saved(doc.substr(0, doc.rfind('#')));
    call.done();
}

void Documents::save_all(const Call& call) {
    const auto saved = files_.save_all();
    if (!saved.ok()) return call.fail(saved.error());
    for (const std::string& path : saved.value()) listeners_.saved(path);
    call.done({{"saved", saved.value()}});
}

void Documents::answer_version(const Call& call, const Status& status) {
    if (!status.ok()) return call.fail(status.error());
    const auto opened = files_.open(call.in["doc"]);
    if (!opened.ok()) return call.fail(opened.error());
    call.done({{"version", opened.value().version}});
}

Json Documents::doc_document(const Json& of) {
    const auto opened = files_.open(of["doc"]);
    if (!opened.ok()) {
        return {{"version", 0}, {"text", ""}, {"unsaved", false}, {"by", 0}, {"gone", true}};
    }
    const DocumentView& view = opened.value();
    Json json = {{"version", view.version},
                 {"text", view.text},
                 {"unsaved", view.unsaved},
                 {"by", view.by},
                 {"gone", view.gone}};
    if (view.disk) json["disk"] = *view.disk;
    return json;
}

Json Documents::files_document() {
    bool more = false;
    Json list = Json::array();
    unsaved_.clear();
    for (const FileInfo& file : files_.list(more)) {
        unsaved_[file.path] = file.unsaved;
        if (list.size() >= kFilesMax) {
            more = true;
            break;
        }
        list.push_back({{"path", file.path},
                        {"kind", file.kind},
                        {"size", file.size},
                        {"unsaved", file.unsaved}});
    }
    return {{"files", std::move(list)}, {"more", more}};
}

// Typing into one file changes nothing in the list of all, once it is marked there.
void Documents::text_changed(const std::string& path) {
    desk_.board().touch("doc");
    const auto listed = unsaved_.find(path);
    const bool same = listed != unsaved_.end() && listed->second && files_.is_unsaved(path);
    if (!same) desk_.board().touch("files");
}

void Documents::project_changed() {
    unsaved_.clear();
    sizes_ = sizes();
    desk_.board().touch("doc");
    desk_.board().touch("files");
}

std::map<std::string, uintmax_t> Documents::sizes() const {
    bool more = false;
    std::map<std::string, uintmax_t> found;
    for (const FileInfo& file : files_.list(more)) found[file.path] = file.size;
    return found;
}

std::vector<std::string> Documents::tick(Time now) {
    if (now < next_list_) return {};
    next_list_ = now + kListEvery;
    const bool watched = desk_.board().watched("files") || desk_.board().watched("findings");
    if (!watched || !files_.is_open()) return {};
    auto found = sizes();
    if (found == sizes_) return {};
    std::vector<std::string> changed;
    for (const auto& [path, size] : found) {
        if (!sizes_.contains(path)) changed.push_back(path);
    }
    for (const auto& [path, size] : sizes_) {
        if (!found.contains(path)) changed.push_back(path);
    }
    sizes_ = std::move(found);
    desk_.board().touch("files");
    return changed;
}

}  // namespace vagus::serve
