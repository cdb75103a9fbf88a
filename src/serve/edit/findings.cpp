#include "serve/edit/findings.hpp"

#include <algorithm>
#include <tuple>

#include "serve/edit/condition_check.hpp"
#include "serve/edit/named_paths.hpp"
#include "serve/edit/script_findings.hpp"
#include "serve/edit/template_list.hpp"
#include "serve/json.hpp"
#include "session/project_file.hpp"

namespace vagus::serve {

namespace {

bool is_checked(const std::string& kind) {
    return kind == "plan" || kind == "world" || kind == "toolbox" || kind == "project";
}

Json list_of_findings(const std::vector<DocFinding>& findings) {
    Json list = Json::array();
    for (const DocFinding& finding : findings) list.push_back(json_of(finding));
    return list;
}

}  // namespace

Findings::Findings(Desk& desk, Files& files, Scripts& scripts, const EditedProject& project)
    : desk_(desk), files_(files), scripts_(scripts), project_(project) {
    desk_.topics().document("findings", [this](const Json&) { return document(); });
    desk_.topics().document("templates", [this](const Json&) {
        return template_list(toolboxes().library->templates());
    });
}

void Findings::text_changed(const std::string& path) {
    desk_.topics().touch("findings");
    if (!concerns_files(path)) return;
    due_at_last_ = due_ ? due_at_last_ : std::optional(now_ + kCheckWithin);
    due_ = std::min(now_ + kCheckAfter, *due_at_last_);
}

// A script concerns others by what it declares only; names of files by whether they are there.
bool Findings::concerns_files(const std::string& path) {
    if (kind_of_file(path) == "other") return list_again();  // a folder, perhaps
    const bool there = files_.exists(path);
    const bool known = listed_.contains(path);
    if (there != known) {
        ++files_generation_;
        if (there) {
            listed_.insert(path);
        } else {
            listed_.erase(path);
        }
        return true;
    }
    const std::string kind = kind_of_file(path);
    if (kind != "script") return is_checked(kind);
    const aesl::CommonDefinitions* common = scripts_.common(path);
    const aesl::CommonDefinitions now = common ? *common : aesl::CommonDefinitions();
    if (common_[path] == now) return is_read_by_a_check(path);
    common_[path] = now;
    ++files_generation_;
    return true;
}

// The condition of being well of vagus.json names variables of scripts.
bool Findings::is_read_by_a_check(const std::string& path) const {
    return std::ranges::any_of(
        of_files_, [&](const auto& one) { return one.second.checkup.read.contains(path); });
}

// Whether there are others than before.
bool Findings::list_again() {
    std::set<std::string> listed;
    bool more = false;
    for (const FileInfo& file : files_.list(more)) {
        if (file.kind != "folder") listed.insert(file.path);
    }
    if (listed == listed_) return false;
    listed_ = std::move(listed);
    ++files_generation_;
    return true;
}

void Findings::project_changed() {
    ++files_generation_;
    ++toolboxes_generation_;
    toolboxes_ = {};
    of_scripts_.clear();
    of_files_.clear();
    left_.clear();
    list_again();
    due_ = due_at_last_ = now_;
    find_scope();
    desk_.topics().touch("findings");
    desk_.topics().touch("templates");
}

// ---- which files ----

std::vector<std::string> Findings::named_in(const std::string& file) {
    std::vector<std::string> paths;
    if (file.empty() || !listed_.contains(file)) return paths;
    const Result<DocumentView> view = files_.open(file);
    if (!view.ok()) return paths;
    for (const NamedPath& named : named_paths(file, view.value().text)) {
        paths.push_back(path_from(file, named.text));
    }
    return paths;
}

// Files of the project's folder, but not of projects inside it, and those that it names.
void Findings::find_scope() {
    scope_.clear();
    const std::string own = folder_of_path(project_.project_file);
    std::vector<std::string> inner;
    for (const std::string& path : listed_) {
        const std::string folder = folder_of_path(path);
        const bool other = kind_of_file(path) == "project" && path != project_.project_file;
        if (other && folder != own && is_below(own, folder)) inner.push_back(folder);
    }
    for (const std::string& path : listed_) {
        const bool below = is_below(own, path) &&
                           std::none_of(inner.begin(), inner.end(), [&](const std::string& folder) {
                               return is_below(folder, path);
                           });
        if (below) scope_.insert(path);
    }
    for (const std::string& file : {project_.project_file, project_.world}) {
        for (const std::string& path : named_in(file)) scope_.insert(path);
    }
    for (const std::string& path : {project_.plan, project_.world}) {
        if (!path.empty()) scope_.insert(path);
    }
    scope_.insert(project_.toolboxes.begin(), project_.toolboxes.end());
}

const std::set<std::string>& Findings::files_of_project() {
    find_scope();
    return scope_;
}

// What a page watches is checked wherever it is.
std::set<std::string> Findings::wanted() const {
    std::set<std::string> paths = scope_;
    for (const Json& of : desk_.topics().subjects("doc")) {
        const std::string doc = of["doc"];
        paths.insert(doc.substr(0, doc.rfind('#')));
    }
    return paths;
}

// ---- scripts ----

void Findings::refresh_scripts() {
    const std::set<std::string> paths = wanted();
    std::map<std::string, OfScript> kept;
    for (const ScriptPart& part : scripts_.parts()) {
        if (!paths.contains(part.file)) continue;
        const CompiledScript* script = scripts_.compiled(part.doc);
        if (!script) continue;
        const auto known = of_scripts_.find(part.doc);
        OfScript of = known == of_scripts_.end() ? OfScript{} : std::move(known->second);
        if (of.compilation != script->number) {
            const Result<std::string> file = files_.text(part.file);
            const bool whole = file.ok() && !scripts_.is_broken(part.file);
            of.findings = findings_of_script(part, *script, whole ? file.value() : "");
            of.json = list_of_findings(of.findings);
            of.compilation = script->number;
            of.version = script->version;
        }
        kept.emplace(part.doc, std::move(of));
    }
    of_scripts_ = std::move(kept);
}

std::vector<DocFinding> Findings::broken_files() {
    const std::set<std::string> paths = wanted();
    std::vector<DocFinding> findings;
    for (const BrokenFile& broken : scripts_.broken()) {
        if (!paths.contains(broken.file)) continue;
        const Result<std::string> text = files_.text(broken.file);
        findings.push_back(finding_of_sentence(broken.file, text.ok() ? text.value() : "",
                                               Severity::Error, "aesl_file", broken.sentence));
    }
    return findings;
}

// ---- other files: a round of checks ----

void Findings::refresh_toolboxes() {
    bool same = toolboxes_.library != nullptr && toolbox_paths_ == project_.toolboxes;
    for (const auto& [path, version] : toolboxes_.checkup.read) {
        same = same && files_.version(path) == version;
    }
    if (same) return;
    toolbox_paths_ = project_.toolboxes;
    toolboxes_ = load_toolboxes(files_, toolbox_paths_);
    ++toolboxes_generation_;
    desk_.topics().touch("templates");
}

void Findings::begin_round() {
    due_.reset();
    left_.clear();
    reached_.clear();
    done_.clear();
    if (!files_.is_open()) return end_round();
    find_scope();
    // Another script for a robot means other events for plans.
    std::vector<std::string> scripts = named_in(nodes_file());
    if (scripts != named_) ++files_generation_;
    named_ = std::move(scripts);
    refresh_toolboxes();
    const std::set<std::string> paths = wanted();
    // A sub-plan is checked with the plan that names it.
    if (!project_.plan.empty()) left_.push_back(project_.plan);
    for (const char* kind : {"plan", "world", "toolbox", "project"}) {
        for (const std::string& path : paths) {
            const bool named = path == project_.plan ||
                               std::count(toolbox_paths_.begin(), toolbox_paths_.end(), path) > 0;
            if (kind_of_file(path) == kind && !named && listed_.contains(path)) {
                left_.push_back(path);
            }
        }
    }
    if (left_.empty()) end_round();
}

bool Findings::holds(const OfFile& known) {
    if (known.toolboxes != toolboxes_generation_ || known.files != files_generation_) return false;
    return std::all_of(known.checkup.read.begin(), known.checkup.read.end(),
                       [&](const auto& one) { return files_.version(one.first) == one.second; });
}

void Findings::check_next() {
    const std::string path = left_.front();
    left_.pop_front();
    if (!reached_.contains(path)) {
        const auto known = of_files_.find(path);
        if (known == of_files_.end() || !holds(known->second)) {
            OfFile of{check(path), toolboxes_generation_, files_generation_, {}};
            of.json = list_of_findings(of.checkup.findings);
            of_files_[path] = std::move(of);
        }
        for (const auto& [read, version] : of_files_[path].checkup.read) reached_.insert(read);
        done_.insert(path);
    }
    if (left_.empty()) end_round();
    desk_.topics().touch("findings");
}

void Findings::end_round() {
    std::erase_if(of_files_, [&](const auto& entry) { return !done_.contains(entry.first); });
    desk_.topics().touch("findings");
}

Checkup Findings::check(const std::string& path) {
    const std::string kind = kind_of_file(path);
    if (kind == "plan") return check_plan(files_, path, toolboxes_, bus_names());
    if (kind == "world") return check_world_file(files_, path);
    if (kind == "toolbox") return check_toolbox_file(files_, path);
    Checkup checkup = check_project_file(files_, path);
    if (path != project_.project_file) return checkup;
    Checkup condition = check_condition(files_, scripts_, path);
    std::ranges::move(condition.findings, std::back_inserter(checkup.findings));
    checkup.read.merge(condition.read);
    return checkup;
}

// The file that says which scripts the nodes have.
const std::string& Findings::nodes_file() const {
    return project_.world.empty() ? project_.project_file : project_.world;
}

// What the nodes of the project declare; nothing if nobody knows which nodes there are.
std::optional<session::BusNames> Findings::bus_names() {
    const bool world = !project_.world.empty();
    aesl::CommonDefinitions common;
    bool scripts = world;
    for (const std::string& path : named_) {
        if (kind_of_file(path) != "script") continue;
        scripts = true;
        add_events_of(path, common);
    }
    if (!scripts) return std::nullopt;
    return session::BusNames(std::move(common), world ? "the scripts of " + project_.world
                                                      : "the scripts of the project");
}

void Findings::add_events_of(const std::string& file, aesl::CommonDefinitions& common) {
    for (const ScriptPart& part : scripts_.parts()) {
        const CompiledScript* script = part.file == file ? scripts_.compiled(part.doc) : nullptr;
        if (!script) continue;
        for (const aesl::GlobalEvent& event : script->common.events) {
            const bool known =
                std::any_of(common.events.begin(), common.events.end(),
                            [&](const aesl::GlobalEvent& one) { return one.name == event.name; });
            if (!known) common.events.push_back(event);
        }
    }
}

void Findings::tick(Time now) {
    now_ = now;
    if (targets_ != scripts_.generation()) {
        targets_ = scripts_.generation();
        desk_.topics().touch("findings");
    }
    if (!desk_.topics().watched("findings")) return;
    if (due_ && now >= *due_) return begin_round();
    if (!left_.empty()) check_next();
}

Time Findings::next_tick() const {
    if (!desk_.topics().watched("findings")) return Time::max();
    if (due_) return left_.empty() ? *due_ : std::min(*due_, now_);
    return left_.empty() ? Time::max() : now_;
}

const Toolboxes& Findings::toolboxes() {
    refresh_toolboxes();
    return toolboxes_;
}

// ---- all of them ----

std::vector<DocFinding> Findings::all() {
    if (due_) begin_round();
    while (!left_.empty()) check_next();
    refresh_scripts();
    std::vector<DocFinding> found = broken_files();
    const auto add = [&](const std::vector<DocFinding>& more) {
        found.insert(found.end(), more.begin(), more.end());
    };
    for (const auto& [doc, of] : of_scripts_) add(of.findings);
    add(toolboxes_.checkup.findings);
    for (const auto& [path, of] : of_files_) add(of.checkup.findings);
    return found;
}

Json Findings::document() {
    refresh_scripts();
    Json list = Json::array();
    Json versions = Json::object();
    size_t more = 0;
    const auto add = [&](const Json& findings) {
        for (const Json& one : findings) {
            if (list.size() < kFindingsMax) {
                list.push_back(one);
            } else {
                ++more;
            }
        }
    };
    const auto say_version = [&](const std::string& doc, uint32_t version) {
        if (versions.size() < kFindingsMax && version > 0) versions[doc] = version;
    };
    add(list_of_findings(broken_files()));
    for (const auto& [doc, of] : of_scripts_) {
        add(of.json);
        say_version(doc, of.version);
    }
    add(list_of_findings(toolboxes_.checkup.findings));
    // A sub-plan may have been checked before the plan that names it.
    std::set<std::tuple<std::string, std::string, std::string>> said;
    for (const auto& [path, of] : of_files_) {
        for (const Json& one : of.json) {
            const bool fresh =
                said.emplace(one["doc"], one["at"].dump() + one["code"].dump(), one["what"]).second;
            if (fresh) add(Json::array({one}));
        }
        for (const auto& [doc, version] : of.checkup.read) say_version(doc, version);
    }
    return {{"findings", std::move(list)}, {"more", more}, {"versions", std::move(versions)}};
}

}  // namespace vagus::serve
