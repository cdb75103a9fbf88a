// How scripts find their nodes: files wait until all nodes have described themselves, then each
// script is compiled for its node and sent.
#include <algorithm>

#include "base/text.hpp"
#include "session/diagnostic_text.hpp"
#include "session/sim_session.hpp"

namespace vagus::session {

void SimSession::load(const std::string& path, std::string_view text) {
    take(path, std::nullopt, text);
}

void SimSession::load_for(sim::RobotId robot, const std::string& path, std::string_view text) {
    take(path, robot, text);
}

void SimSession::take(const std::string& path, std::optional<sim::RobotId> only,
                      std::string_view text) {
    const std::pair source{path, only};
    if (std::find(sources_.begin(), sources_.end(), source) == sources_.end()) {
        if (sources_.size() >= kScriptFilesMax) {
            return refuse_file(path, path + ": error: more than " +
                                         std::to_string(kScriptFilesMax) +
                                         " script files in one world; join some of them");
        }
        sources_.push_back(source);
    }
    auto file = read_script_file(text, path);
    if (!file.ok()) return refuse_file(path, file.error().what);
    std::erase_if(waiting_, [&](const WaitingFile& other) {
        return other.file.path == path && other.only == only;
    });
    waiting_.push_back({std::move(file.value()), only});
    if (all_described()) place_files();
}

void SimSession::reload(const std::string& path, std::string_view text) {
    for (const auto& [known, only] : std::vector(sources_)) {
        if (known == path) take(path, only, text);
    }
}

bool SimSession::all_described() const {
    return std::all_of(nodes_.begin(), nodes_.end(), [this](const Node& node) {
        const debug::NodeView* view = network_.node(node.id);
        return view != nullptr && view->described;
    });
}

void SimSession::place_files() {
    const std::vector<WaitingFile> files = std::exchange(waiting_, {});
    for (const WaitingFile& waiting : files) place(waiting);
}

void SimSession::place(const WaitingFile& waiting) {
    const ScriptFile& file = waiting.file;
    file_mistakes_.erase(file.path);
    if (!file.plain && !agree_on_names(file.path, file.project.common)) return;
    size_t placed = 0;
    if (waiting.only) {
        placed = place_for(*waiting.only, file);
    } else {
        placed = file.plain ? place_plain(file) : place_project(file);
    }
    if (placed > 0) return;
    std::vector<std::string> wanted;
    for (const aesl::Script& script : file.project.scripts) {
        wanted.push_back("\"" + script.node + "\" (node " + std::to_string(script.node_id) + ")");
    }
    std::vector<std::string> there;
    for (const Node& node : nodes_) {
        there.push_back("\"" + network_.node(node.id)->name + "\" (node " +
                        std::to_string(node.id) + ")");
    }
    const auto list = [](const std::vector<std::string>& words) {
        return words.empty() ? "none" : list_of({words.begin(), words.end()});
    };
    refuse_file(file.path,
                file.path +
                    ": error: no script in it is for a robot of this world; it has scripts for " +
                    list(wanted) + ", the world has " + list(there) +
                    "; give the script's node the name of a robot's node");
}

// A script without a node's name is for the first node of each robot.
size_t SimSession::place_plain(const ScriptFile& file) {
    size_t placed = 0;
    for (Node& node : nodes_) {
        if (node.place > 0) continue;
        give(node, file, file.project.scripts.front());
        placed++;
    }
    return placed;
}

// Nodes whose name and number both fit come first, so that none takes the script of another.
size_t SimSession::place_project(const ScriptFile& file) {
    std::vector<bool> used(file.project.scripts.size());
    std::vector<bool> served(nodes_.size());
    for (const bool exact : {true, false}) {
        for (size_t i = 0; i < nodes_.size(); i++) {
            Node& node = nodes_[i];
            if (served[i]) continue;
            const std::string& name = network_.node(node.id)->name;
            std::vector<bool> marks = used;
            const int index = aesl::script_for(file.project, name, node.id, marks);
            if (index < 0) continue;
            const aesl::Script& script = file.project.scripts[static_cast<size_t>(index)];
            if (exact && script.node_id != node.id) continue;
            used = marks;
            give(node, file, script);
            served[i] = true;
        }
    }
    return static_cast<size_t>(std::count(served.begin(), served.end(), true));
}

// For a robot of its own: the scripts for its nodes, or, for its first one, the only one of the
// file.
size_t SimSession::place_for(sim::RobotId robot, const ScriptFile& file) {
    std::vector<bool> used(file.project.scripts.size());
    size_t placed = 0;
    for (Node& node : nodes_) {
        if (node.robot != robot) continue;
        const std::string& name = network_.node(node.id)->name;
        const int index = aesl::script_for(file.project, name, node.id, used);
        if (index < 0) continue;
        give(node, file, file.project.scripts[static_cast<size_t>(index)]);
        placed++;
    }
    if (placed > 0 || file.project.scripts.size() != 1) return placed;
    const auto first = std::find_if(nodes_.begin(), nodes_.end(),
                                    [robot](const Node& node) { return node.robot == robot; });
    if (first == nodes_.end()) return 0;
    give(*first, file, file.project.scripts.front());
    return 1;
}

void SimSession::refuse_file(const std::string& path, const std::string& sentence) {
    file_mistakes_[path] = sentence;
    note(NoteKind::Mistakes, sentence + "\n");
}

// The longest list of events among the other files: all agree as far as they go.
const aesl::CommonDefinitions& SimSession::names_without(const std::string& path) const {
    static const aesl::CommonDefinitions kNone;
    const aesl::CommonDefinitions* longest = &kNone;
    for (const auto& [other, common] : names_) {
        if (other != path && common.events.size() > longest->events.size()) longest = &common;
    }
    return *longest;
}

bool SimSession::agree_on_names(const std::string& path, const aesl::CommonDefinitions& common) {
    for (const auto& [other, names] : names_) {
        if (other == path) continue;
        const size_t both = std::min(names.events.size(), common.events.size());
        for (size_t i = 0; i < both; i++) {
            if (names.events[i].name == common.events[i].name) continue;
            refuse_file(path, path + ": error: event " + std::to_string(i) + " is \"" +
                                  common.events[i].name + "\" here and \"" + names.events[i].name +
                                  "\" in " + other +
                                  "; robots on one bus share the numbers of events: declare the "
                                  "same events in the same order in both");
            return false;
        }
    }
    names_[path] = common;
    const aesl::CommonDefinitions& others = names_without(path);
    network_.set_common(others.events.size() > common.events.size() ? others : common);
    return true;
}

void SimSession::give(Node& node, const ScriptFile& file, const aesl::Script& script) {
    aesl::Program before;
    if (node.script && node.script->path == file.path) before = node.script->program;
    node.script = Assignment{
        file.path, script, file.project.common, Stage::Waiting, std::move(before), {}, {}};
    if (file.plain) {
        const auto& target = network_.node(node.id)->target;
        node.script->common = with_emitted(names_without(file.path), script.source, target);
        if (!agree_on_names(file.path, node.script->common)) return;
    }
    compile(node);
}

void SimSession::compile(Node& node) {
    Assignment& script = *node.script;
    const aesl::Compilation done =
        aesl::compile(script.script.source, network_.node(node.id)->target, script.common,
                      options_for(script.common, options_.compile));
    const SourceText text{script.path, script.script.source, script.script.first_line};
    std::string report;
    const std::vector<std::string> lines = diagnostic_report(text, done);
    for (const std::string& line : lines) report += line + "\n";
    if (!done.ok()) {
        script.mistakes = lines;
        script.stage = Stage::Failed;
        note(NoteKind::Mistakes, report);
        return;
    }
    script.mistakes.clear();
    if (!report.empty()) note(NoteKind::Warnings, report);
    script.program = done.program;
    script.stage = Stage::Ready;
}

void SimSession::send_ready() {
    size_t sent = 0;
    size_t ready = 0;
    for (const Node& node : nodes_) {
        if (node.script && node.script->stage == Stage::Sent) sent++;
        if (node.script && node.script->stage == Stage::Ready) ready++;
    }
    if (ready == 0) return;
    for (Node& node : nodes_) {
        if (sent >= kLoadsAtOnce) return;
        if (!node.script || node.script->stage != Stage::Ready) continue;
        send(node);
        sent++;
    }
}

void SimSession::send(Node& node) {
    Assignment& script = *node.script;
    const auto request = network_.load(node.id, script.program);
    if (!request.ok()) {
        script.stage = Stage::Failed;
        note(NoteKind::Trouble, script.path + ": " + request.error().what);
        return;
    }
    script.request = request.value();
    script.stage = Stage::Sent;
}

}  // namespace vagus::session
