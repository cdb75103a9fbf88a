#include "serve/edit/file_desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "base/base64.hpp"
#include "serve/edit/named_paths.hpp"
#include "serve/edit/own_script.hpp"
#include "serve/edit/seen.hpp"
#include "serve/project/paths.hpp"
#include "sim/world_file.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kFollowedMax = 100;  // in the answer

// The ending that makes a file of that kind; empty: any.
std::string_view ending_of(const std::string& kind) {
    if (kind == "script") return ".aesl";
    if (kind == "plan") return ".plan.json";
    if (kind == "world") return ".world.json";
    if (kind == "toolbox") return ".toolbox.json";
    return "";
}

std::string moved(const std::string& path, const std::string& from, const std::string& to) {
    return is_below(from, path) ? to + path.substr(from.size()) : path;
}

}  // namespace

FileDesk::FileDesk(Desk& desk, Files& files, Scripts& scripts, const EditedProject& project,
                   const EditListeners& listeners, std::string epoch)
    : files_(files),
      scripts_(scripts),
      project_(project),
      listeners_(listeners),
      epoch_(std::move(epoch)) {
    desk.command("file.new", [this](const Call& call) { make(call); });
    desk.command("file.rename", [this](const Call& call) { rename(call); });
    desk.command("file.delete", [this](const Call& call) { remove(call); });
    desk.command("file.bytes", [this](const Call& call) { bytes(call); });
}

// ---- new ones ----

void FileDesk::make(const Call& call) {
    const std::string path = call.in["path"];
    const std::string kind = call.in["kind"];
    call.answer(kind == "folder" ? files_.make_folder(path) : make_file(path, kind));
}

Status FileDesk::make_file(const std::string& path, const std::string& kind) {
    const std::string_view ending = ending_of(kind);
    const size_t slash = path.rfind('/');
    const size_t name_size = path.size() - (slash == path.npos ? 0 : slash + 1);
    if (!path.ends_with(ending) || name_size <= ending.size()) {
        return Error{Code::BadInput,
                     fmt::format("{}: the name of a {} must end in {}", path, kind, ending)};
    }
    const std::string name = name_of_file(path);
    if (kind == "script") return make_script(path);
    if (kind == "plan") return make_first("plan", project_.plan, path, new_plan(name));
    if (kind == "world") return make_first("world", project_.world, path, new_world(name));
    if (kind == "toolbox") return make_toolbox(path);
    return files_.make(path, "");
}

Status FileDesk::make_script(const std::string& path) {
    return make_script_for(nodes_of_project(), path, new_script);
}

// For a node that has no script yet, and loaded into it; else for a number that is free.
Status FileDesk::make_script_for(const std::vector<WorldNode>& nodes, const std::string& path,
                                 const std::function<std::string(const NewNode&)>& text) {
    const WorldNode* const bare = node_without_script(nodes, scripts_);
    NewNode node = bare ? bare->node : nodes.empty() ? NewNode() : nodes.front().node;
    if (!bare) node.id = unused_number(nodes, scripts_);
    const bool named = bare && can_be_named(node);
    TRY(files_.make(path, text(node)));
    if (!bare) return Status::done();
    if (named) TRY(list_in_project("scripts", path));
    return give_to_robot(bare->robot, path);
}

// Scripts that vagus.json names come before all others: one that it names alone would be loaded
// into each node of that name.
bool FileDesk::can_be_named(const NewNode& node) const {
    const auto text = files_.text(project_.project_file);
    if (project_.project_file.empty() || !text.ok()) return false;
    std::set<std::string> named;
    for (const NamedPath& one : named_paths(project_.project_file, text.value())) {
        named.insert(path_from(project_.project_file, one.text));
    }
    return std::none_of(
        scripts_.parts().begin(), scripts_.parts().end(), [&](const ScriptPart& part) {
            return (part.node == node.name || part.node.empty()) && !named.contains(part.file);
        });
}

// A robot that has a script keeps it: the file says which nodes it is for.
Status FileDesk::give_to_robot(size_t robot, const std::string& path) {
    const auto text = files_.text(project_.world);
    const auto world = text.ok() ? sim::read_world(text.value(), project_.world)
                                 : Result<sim::WorldDefinition>(text.error());
    if (!world.ok() || !world.value().robots[robot].script.empty()) return Status::done();
    const JsonValue name = json_string(name_from(project_.world, path));
    const size_t entry = sim::entry_of_robot(text.value(), project_.world, robot);
    return follow({project_.world, {{JsonStep::Do::Set, {"robots", entry, "script"}, name}}},
                  "server");
}

// The first plan or world is that of the project: else nothing would run in it. So is the next one
// after that was deleted.
Status FileDesk::make_first(const std::string& key, const std::string& named,
                            const std::string& path, const std::string& content) {
    const bool has_one = files_.exists(named);
    TRY(files_.make(path, content));
    const std::string& file = project_.project_file;
    if (file.empty() || has_one) return Status::done();
    const auto text = files_.text(file);
    const auto json = read_json(text.ok() ? text.value() : "");
    const auto* root = std::get_if<JsonValue>(&json);
    if (!root || root->kind != JsonKind::Object) return Status::done();  // its finding says so
    const JsonValue name = json_string(name_from(file, path));
    return follow({file, {{JsonStep::Do::Set, {key}, name}}}, "server");
}

// With the script that does its work, and vagus.json told of it: else no plan could use it. Where
// each node has a script, that of the first one gets the work.
Status FileDesk::make_toolbox(const std::string& path) {
    const std::string name = name_of_file(path);
    const std::string ending(ending_of("toolbox"));
    const std::string script = path.substr(0, path.size() - ending.size()) + ".aesl";
    const auto taken = [this](const std::string& one) {
        return files_.exists(one)
                   ? Status(Error{Code::Refused,
                                  one + ": there is such a file already; take another name"})
                   : Status::done();
    };
    TRY(taken(path));
    const std::vector<WorldNode> nodes = nodes_of_project();
    NewNode node = nodes.empty() ? NewNode() : nodes.front().node;
    const ScriptPart* const there = scripts_.for_node(node.name, node.id);
    if (there && !node_without_script(nodes, scripts_)) {
        // A plain script, or one with a mistake, takes nothing.
        if (add_toolbox_to(ScriptPart(*there), node, path).ok()) return Status::done();
    }
    TRY(taken(script));
    TRY(make_script_for(nodes, script, [&](const NewNode& of) {
        node = of;
        return new_toolbox_script(name, of);
    }));
    TRY(files_.make(path, new_toolbox(name, name_from(path, script), node)));
    return list_in_project("toolboxes", path);
}

Status FileDesk::add_toolbox_to(const ScriptPart& part, const NewNode& node,
                                const std::string& path) {
    const std::string name = name_of_file(path);
    OwnTemplate of{.name = name, .help = "What it does.", .node = node.name, .args = node.args};
    of.name[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(of.name[0])));
    const OwnScript made = TRY(own_script(part, of, files_, scripts_));
    const DocumentView before = TRY(files_.open(part.file));
    TRY(files_.make(path, new_toolbox_file(name, name_from(path, part.file), of)));
    (void)TRY(files_.replace(part.file, made.text, "server"));
    if (!before.unsaved) {
        TRY(files_.save(part.file));
        listeners_.saved(part.file);
    }
    return list_in_project("toolboxes", path);
}

// Adds a file to a list of vagus.json.
Status FileDesk::list_in_project(const std::string& key, const std::string& path) {
    const std::string& file = project_.project_file;
    if (file.empty()) return Status::done();
    const auto text = files_.text(file);
    if (!text.ok()) return Status::done();
    const auto json = read_json(text.value());
    const auto* root = std::get_if<JsonValue>(&json);
    if (!root) return Status::done();  // its finding says so
    const JsonValue* listed = root->find(key);
    Follower follower{file, {}};
    const JsonValue value = json_string(name_from(file, path));
    if (listed && listed->kind == JsonKind::Array) {
        follower.steps.push_back({JsonStep::Do::Insert, {key, listed->items.size()}, value});
    } else {
        follower.steps.push_back({JsonStep::Do::Set, {key}, json_array({value})});
    }
    return follow(follower, "server");
}

std::vector<WorldNode> FileDesk::nodes_of_project() const {
    const auto text = files_.text(project_.world);
    if (project_.world.empty() || !text.ok()) return {};
    const auto world = sim::read_world(text.value(), project_.world);
    return world.ok() ? nodes_of_world(world.value()) : std::vector<WorldNode>();
}

// ---- other names ----

void FileDesk::rename(const Call& call) {
    if (!seen_all(call, files_, epoch_)) return;
    const std::string from = call.in["path"];
    const std::string to = call.in["to"];
    const std::vector<Follower> after = followers(from, to);
    const Status renamed = files_.rename(from, to);
    if (!renamed.ok()) return call.fail(renamed.error());
    listeners_.renamed(from, to);
    nlohmann::json followed = nlohmann::json::array();
    for (const Follower& follower : after) {
        const Status done = follow(follower, made_for(call.member));
        if (!done.ok()) {
            listeners_.say("warning", fmt::format("{} still names the old place: {}", follower.path,
                                                  done.error().what));
        } else if (followed.size() < kFollowedMax) {
            followed.push_back(follower.path);
        }
    }
    call.done({{"followed", std::move(followed)}});
}

// Paths in a file are relative to its folder, so a file that moves gets new ones, too.
std::vector<FileDesk::Follower> FileDesk::followers(const std::string& from,
                                                    const std::string& to) {
    std::vector<Follower> found;
    bool more = false;
    for (const FileInfo& file : files_.list(more)) {
        if (!may_name_others(file.path)) continue;
        if (file.size > kTextBytesMax) continue;
        const auto text = files_.text(file.path);
        if (!text.ok()) continue;
        Follower follower{moved(file.path, from, to), {}};
        for (const NamedPath& named : named_paths(file.path, text.value())) {
            // A folder may be named with a slash behind it, and keeps it.
            const std::string slash = named.folder && named.text.ends_with('/') ? "/" : "";
            const std::string bare = named.text.substr(0, named.text.size() - slash.size());
            const std::string before = path_from(file.path, bare);
            const std::string after = moved(before, from, to);
            const bool same = before == after && follower.path == file.path;
            if (same || !check_path(before).ok()) continue;
            const std::string name = name_from(follower.path, after) + slash;
            if (name == named.text) continue;
            follower.steps.push_back({JsonStep::Do::Set, named.at, json_string(name)});
        }
        if (!follower.steps.empty()) found.push_back(std::move(follower));
    }
    return found;
}

// A file that had nothing unsaved is saved, so that the folder is whole for others, too.
Status FileDesk::follow(const Follower& follower, const std::string& by) {
    const DocumentView view = TRY(files_.open(follower.path));
    const std::string kind = kind_of_file(follower.path);
    const std::string text = TRY(patched(view.text, {kind, follower.path}, follower.steps));
    (void)TRY(files_.replace(follower.path, text, by));
    if (view.unsaved) return Status::done();
    TRY(files_.save(follower.path));
    listeners_.saved(follower.path);
    return Status::done();
}

// ---- the rest ----

void FileDesk::remove(const Call& call) {
    call.answer(files_.remove(call.in["path"]));
}

void FileDesk::bytes(const Call& call) {
    const std::string path = call.in["path"];
    const auto size = files_.size(path);
    if (!size.ok()) return call.fail(size.error());
    if (size.value() > kBytesMax) {
        return call.fail("limit",
                         fmt::format("{}: {} bytes, and a page gets files of at most {}; copy it "
                                     "from the folder of the project, or move it out of there",
                                     path, size.value(), kBytesMax));
    }
    const auto read = files_.bytes(path);
    if (!read.ok()) return call.fail(read.error());
    call.done({{"base64", base64(read.value())}});
}

}  // namespace vagus::serve
