#include "serve/edit/documents.hpp"

#include <fmt/format.h>

#include "serve/edit/json_patch.hpp"
#include "serve/edit/seen.hpp"
#include "serve/edit/text_places.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kReasonMax = 1000;  // bytes, as in the protocol

std::vector<TextChange> changes_of(const Json& list) {
    std::vector<TextChange> changes;
    for (const Json& one : list) changes.push_back({one["from"], one["to"], one["text"]});
    return changes;
}

Json json_of(const Update& update) {
    Json changes = Json::array();
    for (const TextChange& one : update.changes) {
        changes.push_back({{"from", one.from}, {"to", one.to}, {"text", one.text}});
    }
    return {{"version", update.version}, {"changes", std::move(changes)}, {"by", update.by}};
}

// Names of those who change texts that are no client's.
bool is_ours(const std::string& by) {
    return by.empty() || by == "server" || by == "disk" || by.starts_with("for:");
}

// "project" for a vagus.json, else the language of the document.
std::string format_name(const std::string& path, const std::string& language) {
    return kind_of_file(path) == "project" ? "project" : language;
}

}  // namespace

Documents::Documents(Desk& desk, Files& files, const EditListeners& listeners, std::string epoch)
    : desk_(desk), files_(files), listeners_(listeners), epoch_(std::move(epoch)) {
    desk_.topics().document("doc", [this](const Json& of) { return doc_document(of); });
    desk_.topics().document("files", [this](const Json&) { return files_document(); });
    declare_commands();
}

void Documents::declare_commands() {
    desk_.command("doc.open", [this](const Call& call) { open(call); });
    desk_.command("doc.edit", [this](const Call& call) { edit(call); });
    desk_.command("doc.pull", [this](const Call& call) { pull(call); });
    desk_.command("doc.disk", [this](const Call& call) { disk(call); });
    desk_.command("doc.patch", [this](const Call& call) { patch(call); });
    desk_.command("doc.save", [this](const Call& call) { save(call); });
    desk_.command("doc.save_all", [this](const Call& call) { save_all(call); });
    desk_.command("doc.revert", [this](const Call& call) {
        if (!seen_all(call, files_, epoch_)) return;
        answer_version(call, files_.revert(call.in["doc"], made_for(call.member)));
    });
    desk_.command("doc.keep", [this](const Call& call) {
        if (seen_all(call, files_, epoch_)) keep(call);
    });
}

// Nobody keeps or overwrites what nobody has seen.
void Documents::keep(const Call& call) {
    const std::string doc = call.in["doc"];
    const std::string which = call.in["which"];
    const auto state = files_.state_now(doc);
    if (!state.ok()) return call.fail(state.error());
    const bool nothing_to_lose = which == "mine" && !state.value().conflict;
    if (!nothing_to_lose && state.value().disk_hash != call.in.value("disk_hash", "")) {
        return call.fail("behind", doc +
                                       ": the file on disk is another one by now than disk_hash "
                                       "says; look at it again, then choose");
    }
    if (which == "mine") return answer_version(call, files_.keep_mine(doc));
    const std::string by = made_for(call.member);
    answer_version(call, which == "both" ? files_.keep_both(doc, by) : files_.revert(doc, by));
}

void Documents::open(const Call& call) {
    const auto opened = files_.open(call.in["doc"]);
    if (!opened.ok()) return call.fail(opened.error());
    const DocumentView& view = opened.value();
    call.done({{"epoch", epoch_},
               {"text", view.text},
               {"version", view.version},
               {"language", view.language},
               {"unsaved", view.unsaved},
               {"ends", view.ends}});
}

// Whether an edit is for another text than the one there is.
bool Documents::is_behind(const Call& call, const std::string& doc) const {
    return call.in["epoch"] != epoch_ || call.in["version"] != files_.version(doc);
}

// What leads from the text that the call names to the one there is.
void Documents::answer_missing(const Call& call, const std::string& doc) const {
    // Versions of another life of this server say nothing; none of ours is 0.
    const bool ours = call.in["epoch"] == epoch_;
    const auto missing = files_.since(doc, ours ? call.in["version"].get<uint32_t>() : 0);
    if (!missing.ok()) return call.fail(missing.error());
    Json out = {{"version", missing.value().version}};
    if (missing.value().text) {
        out["text"] = *missing.value().text;
        out["epoch"] = epoch_;
    } else {
        out["behind"] = Json::array();
        for (const Update& one : missing.value().updates) out["behind"].push_back(json_of(one));
    }
    call.done(std::move(out));
}

void Documents::edit(const Call& call) {
    const std::string doc = call.in["doc"];
    const auto opened = files_.state(doc);
    if (!opened.ok()) return call.fail(opened.error());
    if (is_ours(call.in["by"])) {
        return call.fail("bad_input",
                         "by: expected the client's name for itself; for:N, disk, "
                         "server and an empty one are the server's");
    }
    if (is_behind(call, doc)) return answer_missing(call, doc);
    const auto edited =
        files_.edit(doc, opened.value().version, changes_of(call.in["changes"]), call.in["by"]);
    if (!edited.ok()) return call.fail(edited.error());
    call.done({{"version", edited.value()}});
}

void Documents::pull(const Call& call) {
    answer_missing(call, call.in["doc"]);
}

void Documents::disk(const Call& call) {
    const auto text = files_.disk_text(call.in["doc"]);
    if (!text.ok()) return call.fail(text.error());
    call.done({{"text", text.value()}});
}

void Documents::patch(const Call& call) {
    const std::string doc = call.in["doc"];
    const auto opened = files_.open(doc);
    if (!opened.ok()) return call.fail(opened.error());
    const bool ours = !call.in.contains("epoch") || call.in["epoch"] == epoch_;
    if (!ours || call.in["version"] != opened.value().version) {
        return call.fail(
            "behind", fmt::format("{}: the text is at version {} by now, the steps are for {}; "
                                  "take the new text and change that",
                                  doc, opened.value().version, call.in["version"].get<uint32_t>()));
    }
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
    const auto version = files_.replace(doc, text.value(), made_for(call.member));
    if (!version.ok()) return call.fail(version.error());
    call.done({{"version", version.value()}, {"text", text.value()}});
}

void Documents::save(const Call& call) {
    const std::string named = call.in["doc"];
    const std::string doc = files_.moved_to(named).value_or(named);
    const auto before = files_.state(doc);
    const bool unsaved = before.ok() && (before.value().unsaved || before.value().gone);
    const Status saved = files_.save(doc);
    if (!saved.ok() && files_.has_conflict(doc)) return call.fail("conflict", saved.error().what);
    if (!saved.ok()) return call.fail(saved.error());
    if (unsaved) listeners_.saved(doc.substr(0, doc.rfind('#')));
    done_on_disk(call, {{"version", files_.version(doc)}});
}

// "Saved" is said when a power cut cannot take it back.
void Documents::done_on_disk(const Call& call, Json out) {
    files_.when_on_disk([call, out = std::move(out)](const Status& written) {
        written.ok() ? call.done(out) : call.fail(written.error());
    });
}

void Documents::save_all(const Call& call) {
    std::vector<std::string> saved;
    const Status all = files_.save_all(saved);
    for (const std::string& path : saved) listeners_.saved(path);
    if (all.ok()) return done_on_disk(call, {{"saved", saved}});
    if (all.error().code == Code::Refused) return call.fail("conflict", all.error().what);
    call.fail(all.error());
}

void Documents::answer_version(const Call& call, const Status& status) {
    if (!status.ok()) return call.fail(status.error());
    const auto opened = files_.open(call.in["doc"]);
    if (!opened.ok()) return call.fail(opened.error());
    call.done({{"version", opened.value().version}});
}

Json Documents::doc_document(const Json& of) {
    const std::string doc = of["doc"];
    const auto moved = files_.moved_to(doc);
    const auto found = files_.state(doc);
    DocumentState state;
    state.gone = !found.ok();
    if (found.ok()) state = found.value();
    Json json = {{"epoch", epoch_},
                 {"version", state.version},
                 {"language", found.ok() ? state.language : "text"},
                 {"ends", found.ok() ? state.ends : "lf"},
                 {"unsaved", state.unsaved},
                 {"by", state.by},
                 {"gone", state.gone},
                 {"disk", state.conflict}};
    if (state.conflict) json["disk_hash"] = state.disk_hash;
    if (!state.no_text.empty()) json["disk_no_text"] = line_of(state.no_text, kReasonMax);
    if (moved) json["moved"] = *moved;
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
    desk_.topics().touch("doc");
    const auto listed = unsaved_.find(path);
    const bool same = listed != unsaved_.end() && listed->second && files_.is_unsaved(path) &&
                      files_.exists(path);
    if (same) return;
    desk_.topics().touch("files");
    desk_.topics().touch("studio");  // it names the texts of an earlier session that are not saved
}

void Documents::project_changed() {
    unsaved_.clear();
    sizes_ = sizes();
    desk_.topics().touch("doc");
    desk_.topics().touch("files");
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
    const bool watched = desk_.topics().watched("files") || desk_.topics().watched("findings");
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
    desk_.topics().touch("files");
    return changed;
}

}  // namespace vagus::serve
