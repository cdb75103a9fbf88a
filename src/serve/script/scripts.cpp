#include "serve/script/scripts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "aesl/project_text.hpp"
#include "serve/project/utf16.hpp"
#include "session/script_file.hpp"

namespace vagus::serve {

using aesl::MentionKind;

namespace {

Error no_such(const std::string& element, const std::string& name, const std::string& file) {
    return {Code::NotFound, fmt::format("{}: there is no {} “{}”", file, element, name)};
}

}  // namespace

Scripts::Scripts(Files& files, TargetOf target_of)
    : files_(files), target_of_(std::move(target_of)) {
    read_all();
}

void Scripts::reread() {
    compiled_.clear();
    ++generation_;
    read_all();
}

void Scripts::prefer(std::vector<std::string> files) {
    preferred_ = std::move(files);
    collect_parts();
}

void Scripts::changed(const std::string& path) {
    const std::string kind = kind_of_file(path);
    if (kind == "script") {
        read_file(path);
    } else if (kind == "other") {
        read_all();  // a folder, perhaps
    }
    collect_parts();
}

void Scripts::targets_changed() {
    compiled_.clear();
    ++generation_;
}

void Scripts::read_all() {
    script_files_.clear();
    bool more = false;
    for (const FileInfo& file : files_.list(more)) {
        if (file.kind == "script") read_file(file.path);
    }
    collect_parts();
}

// A file that cannot be read keeps the scripts that it had.
void Scripts::read_file(const std::string& path) {
    const Result<std::string> text = files_.text(path);
    if (!text.ok()) {
        script_files_.erase(path);
        return;
    }
    ScriptsOfFile& kept = script_files_[path];
    const auto read = session::read_script_file(text.value(), path);
    kept.mistake = read.ok() ? "" : read.error().what;
    if (!read.ok()) return;
    const session::ScriptFile& file = read.value();
    std::vector<ScriptPart> before = std::exchange(kept.parts, {});
    const bool same_names = kept.common == file.project.common && kept.plain == file.plain;
    kept.common = file.project.common;
    kept.plain = file.plain;
    for (size_t i = 0; i < file.project.scripts.size(); ++i) {
        const aesl::Script& script = file.project.scripts[i];
        kept.parts.push_back({file.plain ? path : fmt::format("{}#{}", path, i + 1), path,
                              script.node, script.node_id});
        // What was compiled stays for the same text, names and node.
        const bool same = same_names && i < before.size() && before[i] == kept.parts.back();
        if (!same) compiled_.erase(kept.parts.back().doc);
    }
}

void Scripts::collect_parts() {
    parts_.clear();
    for (const auto& [path, file] : script_files_) {
        parts_.insert(parts_.end(), file.parts.begin(), file.parts.end());
    }
    std::stable_sort(parts_.begin(), parts_.end(),
                     [this](const ScriptPart& one, const ScriptPart& other) {
                         return place_of(one.file) < place_of(other.file);
                     });
    std::erase_if(compiled_, [&](const auto& entry) {
        return std::none_of(parts_.begin(), parts_.end(),
                            [&](const ScriptPart& part) { return part.doc == entry.first; });
    });
}

// Among the files that the project names; all others come after them.
size_t Scripts::place_of(const std::string& file) const {
    const auto found = std::find(preferred_.begin(), preferred_.end(), file);
    return static_cast<size_t>(found - preferred_.begin());
}

std::vector<BrokenFile> Scripts::broken() const {
    std::vector<BrokenFile> broken;
    for (const auto& [path, file] : script_files_) {
        if (!file.mistake.empty()) broken.push_back({path, file.mistake});
    }
    return broken;
}

bool Scripts::is_broken(const std::string& file) const {
    const auto found = script_files_.find(file);
    return found != script_files_.end() && !found->second.mistake.empty();
}

const CompiledScript* Scripts::compiled(const std::string& doc) {
    const auto part = std::find_if(parts_.begin(), parts_.end(),
                                   [&](const ScriptPart& one) { return one.doc == doc; });
    if (part == parts_.end()) return nullptr;
    const auto known = compiled_.find(doc);
    if (known != compiled_.end() && known->second.version == files_.version(doc)) {
        return &known->second;
    }
    const Result<DocumentView> opened = files_.open(doc);
    if (!opened.ok()) return nullptr;
    CompiledScript script;
    script.number = ++compilations_;
    script.version = opened.value().version;
    script.source = opened.value().text;
    script.target = target_of_(part->node, part->node_id);
    const ScriptsOfFile& file = script_files_[part->file];
    script.common =
        file.plain ? session::with_emitted(file.common, script.source, script.target) : file.common;
    script.result = aesl::compile(script.source, script.target, script.common,
                                  session::options_for(script.common, {}));
    return &(compiled_[doc] = std::move(script));
}

const aesl::CommonDefinitions* Scripts::common(const std::string& file) const {
    const auto found = script_files_.find(file);
    return found == script_files_.end() ? nullptr : &found->second.common;
}

const ScriptPart* Scripts::for_node(const std::string& name, uint16_t id) const {
    const ScriptPart* found = nullptr;
    std::tuple<bool, bool, bool> best;
    for (const ScriptPart& part : parts_) {
        if (part.node != name && !part.node.empty()) continue;
        const bool named = place_of(part.file) < preferred_.size();
        const std::tuple fit(named, part.node_id == id && id != 0, !part.node.empty());
        if (found && fit <= best) continue;
        found = &part;
        best = fit;
    }
    return found;
}

std::vector<Scripts::LinesOf> Scripts::lines_in(const std::string& file) const {
    const auto text = files_.text(file);
    if (!text.ok()) return {};
    const auto project = aesl::parse_project(text.value(), file);
    if (!project.ok()) return {};
    std::vector<LinesOf> all;
    for (const ScriptPart& part : parts_) {
        if (part.file != file || all.size() >= project.value().scripts.size()) continue;
        const aesl::Script& script = project.value().scripts[all.size()];
        const auto more = std::count(script.source.begin(), script.source.end(), '\n');
        all.push_back({part.doc, script.first_line, script.first_line + static_cast<int>(more)});
    }
    return all;
}

// ---- across scripts ----

std::optional<Scripts::Found> Scripts::references(const std::string& doc, aesl::Position at) {
    const CompiledScript* script = compiled(doc);
    if (!script) return std::nullopt;
    const auto mention = mention_at(script->view(), at);
    if (!mention) return std::nullopt;
    Found found{
        mention->name, mention->kind, owner_of(script->view(), mention->name, mention->kind), {}};
    const std::string file = doc.substr(0, doc.rfind('#'));
    for (const ScriptPart& part : parts_) {
        const bool shared = found.owner == Owner::Project && part.file == file;
        if (part.doc != doc && !shared) continue;
        const CompiledScript* other = compiled(part.doc);
        if (!other) continue;
        for (const auto& one : mentions_of(other->view(), found.name, found.kind)) {
            found.spots.push_back({part.doc, one.at, one.end});
        }
    }
    return found;
}

std::vector<Spot> Scripts::definition(const std::string& doc, aesl::Position at) {
    const CompiledScript* script = compiled(doc);
    const auto mention = script ? mention_at(script->view(), at) : std::nullopt;
    if (!mention) return {};
    std::vector<Spot> spots;
    for (const auto& one : mentions_of(script->view(), mention->name, mention->kind)) {
        if (one.declares) spots.push_back({doc, one.at, one.end});
    }
    return spots;
}

Result<size_t> Scripts::rename(const std::string& doc, aesl::Position at, const std::string& to,
                               const std::string& by) {
    const auto found = references(doc, at);
    if (!found) return Error{Code::NotFound, "there is no name at this place"};
    if (found->owner == Owner::Node) {
        return Error{Code::Refused,
                     fmt::format("“{}” belongs to the node and cannot be renamed", found->name)};
    }
    const std::string file = doc.substr(0, doc.rfind('#'));
    if (found->owner == Owner::Project) {
        const std::string element = found->kind == MentionKind::Event ? "event" : "constant";
        const aesl::CommonDefinitions* names = common(file);
        int32_t value = 0;
        bool known = false;
        for (const auto& event : names->events) {
            if (element == "event" && event.name == found->name) {
                value = event.size.value_or(0);
                known = true;
            }
        }
        for (const auto& constant : names->constants) {
            if (element == "constant" && constant.name == found->name) {
                value = constant.value;
                known = true;
            }
        }
        if (known && !script_files_[file].plain) {
            return change(file, element, found->name, to, value, by);
        }
    }
    const std::string fault = fault_of_name(compiled(doc)->view(), to);
    if (!fault.empty()) return Error{Code::BadInput, fault};
    size_t places = 0;
    TRY(replace_mentions(doc, found->name, found->kind, to, by, places));
    return places;
}

Status Scripts::replace_mentions(const std::string& doc, const std::string& name, MentionKind kind,
                                 const std::string& to, const std::string& by, size_t& places) {
    const CompiledScript* script = compiled(doc);
    if (!script) return Status::done();
    std::vector<TextChange> changes;
    for (const auto& one : mentions_of(script->view(), name, kind)) {
        const size_t from = units_of(script->source, one.offset);
        changes.push_back({from, from + units_of(name, name.size()), to});
    }
    places += changes.size();
    if (changes.empty()) return Status::done();
    (void)TRY(files_.edit(doc, script->version, changes, by));
    return Status::done();
}

// ---- events and constants of a file ----

Result<std::string> Scripts::project_text(const std::string& file) {
    const auto known = script_files_.find(file);
    if (known == script_files_.end() || known->second.plain) {
        return Error{Code::Refused, file +
                                        ": a plain script declares nothing; make it a project "
                                        "to share events and constants"};
    }
    if (!known->second.mistake.empty()) {
        return Error{Code::Refused, "fix the file first: " + known->second.mistake};
    }
    return files_.text(file);
}

Status Scripts::check_new_name(const std::string& file, const std::string& name) {
    for (const ScriptPart& part : parts_) {
        if (part.file != file) continue;
        const CompiledScript* script = compiled(part.doc);
        const std::string fault = script ? fault_of_name(script->view(), name) : "";
        if (!fault.empty()) return Error{Code::BadInput, fault};
    }
    const aesl::CommonDefinitions* names = common(file);
    for (const auto& event : names->events) {
        if (event.name == name) {
            return Error{Code::Refused, fmt::format("there is an event “{}” already", name)};
        }
    }
    return Status::done();
}

Status Scripts::add(const std::string& file, const std::string& element, const std::string& name,
                    int32_t value, const std::string& by) {
    const std::string text = TRY(project_text(file));
    TRY(check_new_name(file, name));
    (void)TRY(files_.replace(file, aesl::ProjectText(text).add({element, name, value}), by));
    return Status::done();
}

Result<size_t> Scripts::change(const std::string& file, const std::string& element,
                               const std::string& name, const std::string& to, int32_t value,
                               const std::string& by) {
    TRY(project_text(file));
    if (to != name) TRY(check_new_name(file, to));
    const MentionKind kind = element == "event" ? MentionKind::Event : MentionKind::Constant;
    size_t places = 0;
    if (to != name) {
        const std::vector<ScriptPart> parts = parts_;  // each edit reads the files again
        for (const ScriptPart& part : parts) {
            if (part.file == file) TRY(replace_mentions(part.doc, name, kind, to, by, places));
        }
    }
    const std::string text = TRY(project_text(file));
    auto changed = aesl::ProjectText(text).change(element, name, {element, to, value});
    if (!changed) return no_such(element, name, file);
    (void)TRY(files_.replace(file, std::move(*changed), by));
    return places + 1;
}

Status Scripts::remove(const std::string& file, const std::string& element, const std::string& name,
                       const std::string& by) {
    const std::string text = TRY(project_text(file));
    auto changed = aesl::ProjectText(text).remove(element, name);
    if (!changed) return no_such(element, name, file);
    (void)TRY(files_.replace(file, std::move(*changed), by));
    return Status::done();
}

Status Scripts::move(const std::string& file, const std::string& element, const std::string& name,
                     size_t to, const std::string& by) {
    const std::string text = TRY(project_text(file));
    auto changed = aesl::ProjectText(text).move(element, name, to);
    if (!changed) return no_such(element, name, file);
    (void)TRY(files_.replace(file, std::move(*changed), by));
    return Status::done();
}

}  // namespace vagus::serve
