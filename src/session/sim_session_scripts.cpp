// How scripts find their nodes: files wait until all nodes have described themselves, then each
// script is compiled for its node and sent.
#include <algorithm>

#include "base/text.hpp"
#include "debug/lines.hpp"
#include "session/diagnostic_text.hpp"
#include "session/sim_session.hpp"
#include "sim/machine.hpp"

namespace vagus::session {
namespace {

// About the whole file.
Diagnostic of_file(const std::string& path, std::string sentence) {
    Diagnostic diagnostic;
    diagnostic.file = path;
    diagnostic.sentence = std::move(sentence);
    return diagnostic;
}

}  // namespace

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
            return refuse_file(path, of_file(path, "more than " + std::to_string(kScriptFilesMax) +
                                                       " script files in one world; join some of "
                                                       "them"));
        }
        sources_.push_back(source);
    }
    auto file = read_script_file(text, path);
    if (!file.ok()) return refuse_file(path, of_file("", file.error().what));
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

// Called at each instant: the node that was missing last is looked at first.
bool SimSession::all_described() {
    for (size_t looked_at = 0; looked_at < nodes_.size(); looked_at++) {
        const debug::NodeView* view = network_.node(nodes_[undescribed_].id);
        if (view == nullptr || !view->described) return false;
        undescribed_ = (undescribed_ + 1) % nodes_.size();
    }
    return true;
}

void SimSession::place_files() {
    const std::vector<WaitingFile> files = std::exchange(waiting_, {});
    for (const WaitingFile& waiting : files) place(waiting);
    compiled_.clear();  // the next text is another, and its mistakes are told again
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
    refuse_file(
        file.path,
        of_file(file.path, "no script in it is for a robot of this world; it has scripts for " +
                               list(wanted) + ", the world has " + list(there) +
                               "; give the script's node the name of a robot's node"));
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

size_t SimSession::place_project(const ScriptFile& file) {
    std::vector<Node*> all;
    for (Node& node : nodes_) all.push_back(&node);
    return place_among(all, file);
}

size_t SimSession::place_among(std::span<Node* const> nodes, const ScriptFile& file) {
    std::vector<aesl::NodeName> names;
    for (const Node* node : nodes) names.push_back({network_.node(node->id)->name, node->id});
    const std::vector<int> scripts = aesl::scripts_for(file.project, names);
    size_t placed = 0;
    for (size_t i = 0; i < nodes.size(); i++) {
        if (scripts[i] < 0) continue;
        give(*nodes[i], file, file.project.scripts[static_cast<size_t>(scripts[i])]);
        placed++;
    }
    return placed;
}

// For a robot of its own: the scripts for its nodes, or, for its first one, the only one of the
// file.
size_t SimSession::place_for(sim::RobotId robot, const ScriptFile& file) {
    std::vector<Node*> its;
    for (Node& node : nodes_) {
        if (node.robot == robot) its.push_back(&node);
    }
    const size_t placed = place_among(its, file);
    if (placed > 0 || file.project.scripts.size() != 1 || its.empty()) return placed;
    give(*its.front(), file, file.project.scripts.front());
    return 1;
}

std::map<uint16_t, std::string> SimSession::running_scripts() const {
    std::map<uint16_t, std::string> running;
    for (const Node& node : nodes_) {
        if (node.script && node.script->stage == Stage::Runs) {
            running.emplace(node.id, node.script->script->source);
        }
    }
    return running;
}

void SimSession::refuse_file(const std::string& path, Diagnostic why) {
    note(NoteKind::Mistakes, report_of(why));
    file_mistakes_[path] = std::move(why);
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
            refuse_file(
                path,
                of_file(path, "event " + std::to_string(i) + " is \"" + common.events[i].name +
                                  "\" here and \"" + names.events[i].name + "\" in " + other +
                                  "; robots on one bus share the numbers of events: "
                                  "declare the same events in the same order in both"));
            return false;
        }
    }
    names_[path] = common;
    const aesl::CommonDefinitions& others = names_without(path);
    network_.set_common(others.events.size() > common.events.size() ? others : common);
    return true;
}

void SimSession::give(Node& node, const ScriptFile& file, const aesl::Script& script) {
    SharedValue<aesl::Program> before;
    if (node.script && node.script->path == file.path) before = node.script->program;
    if (node.script) count(node.script->stage)--;
    count(Stage::Waiting)++;
    node.script = Assignment{
        file.path, script, file.project.common, Stage::Waiting, std::move(before), {}, {}};
    if (file.plain) {
        const aesl::Target& target = network_.node(node.id)->target;
        node.script->common = with_emitted(names_without(file.path), script.source, target);
        if (!agree_on_names(file.path, node.script->common)) return;
    }
    compile(node);
}

// Many robots of one kind have one script: it is compiled, and its mistakes are told, once.
const SimSession::Compiled& SimSession::compiled(const Node& node) {
    const Assignment& script = *node.script;
    const SharedValue<aesl::Target>& target = network_.node(node.id)->target;
    const std::string& source = script.script->source;
    const int first_line = script.script->first_line;
    for (const Compiled& known : compiled_) {
        if (known.path == script.path && known.script->first_line == first_line &&
            known.script->source == source && *known.common == *script.common &&
            *known.target == *target) {
            return known;
        }
    }
    aesl::Options how = options_for(script.common, options_.compile);
    how.first_line = first_line;
    const aesl::Compilation done = aesl::compile(source, target, script.common, how);
    const SourceText text{script.path, source, first_line};
    Compiled made{script.path,
                  script.script,
                  script.common,
                  target,
                  done.program,
                  done.ok(),
                  diagnostics_of(text, done)};
    std::string report;
    for (const Diagnostic& one : made.mistakes) report += report_of(one);
    if (!report.empty()) note(made.good ? NoteKind::Warnings : NoteKind::Mistakes, report);
    compiled_.push_back(std::move(made));
    return compiled_.back();
}

void SimSession::was_loaded(uint16_t id, const std::string& path, std::string_view text) {
    Node* const node = find(id);
    const debug::NodeView* const view = network_.node(id);
    const auto file = read_script_file(text, path);
    if (node == nullptr || view == nullptr || !view->described || !file.ok()) return;
    const std::vector<aesl::NodeName> name = {{view->name, id}};
    const int which = file.value().plain ? 0 : aesl::scripts_for(file.value().project, name)[0];
    if (which < 0) return;
    const aesl::Script& script = file.value().project.scripts[static_cast<size_t>(which)];
    const aesl::CommonDefinitions common =
        file.value().plain ? with_emitted(names_without(path), script.source, view->target)
                           : file.value().project.common;
    aesl::Options how = options_for(common, options_.compile);
    how.first_line = script.first_line;
    const aesl::Compilation done = aesl::compile(script.source, view->target, common, how);
    if (!done.ok() || !network_.adopt(debug::NodeId{id}, done.program).ok()) return;
    if (node->script) count(node->script->stage)--;
    count(Stage::Runs)++;
    node->script = Assignment{path, script, common, Stage::Runs, done.program, {}, {}};
}

void SimSession::compile(Node& node) {
    Assignment& script = *node.script;
    const Compiled& done = compiled(node);
    script.common = done.common;  // equal, and there once
    const bool same =
        script.script->node == done.script->node && script.script->node_id == done.script->node_id;
    if (same) script.script = done.script;
    if (!done.good) {
        script.mistakes = done.mistakes;
        enter(script, Stage::Failed);
        return;
    }
    script.mistakes.clear();
    script.program = done.program;
    enter(script, Stage::Ready);
}

void SimSession::enter(Assignment& script, Stage stage) {
    count(script.stage)--;
    count(stage)++;
    script.stage = stage;
}

// In the order of the robots; goes on where it stopped, for it is called at each instant.
void SimSession::send_ready() {
    if (held_) return;
    const size_t at_once = over_can_ ? kLoadsAtOnceOverCan : kLoadsAtOnce;
    while (count(Stage::Ready) > 0 && count(Stage::Sent) < at_once) {
        Node& node = nodes_[next_ready_];
        next_ready_ = (next_ready_ + 1) % nodes_.size();
        if (node.script && node.script->stage == Stage::Ready) send(node);
    }
    if (count(Stage::Ready) == 0) next_ready_ = 0;
}

void SimSession::run_scripts(Again which) {
    held_ = false;
    for (Node& node : nodes_) {
        if (!node.script || node.script->program->bytecode.empty()) continue;
        const Stage stage = node.script->stage;
        const debug::NodeView* const view = network_.node(node.id);
        const bool runs = stage == Stage::Runs && view != nullptr && view->connected &&
                          view->state == debug::ProgramState::Running;
        const bool again = which == Again::All || !runs;
        if (again && (stage == Stage::Runs || stage == Stage::Failed)) {
            enter(*node.script, Stage::Ready);
        }
    }
}

void SimSession::forget_scripts() {
    sources_.clear();
    waiting_.clear();
    file_mistakes_.clear();
    names_.clear();
    network_.set_common({});
    for (Node& node : nodes_) {
        if (!node.script) continue;
        count(node.script->stage)--;
        node.script.reset();
        node.fault.clear();
        node.killed.clear();
    }
}

// One sentence for as long as it runs: its place changes all the time.
std::string SimSession::endless(uint16_t id) {
    constexpr uint64_t kInstructions =
        uint64_t{sim::kInstructionsPerMillisecond} * (kEndlessAfter / sim::kNodeStep);
    Node* const node = find(debug::NodeId{id});
    if (node == nullptr) return "";
    const auto handler = world_->running_handler(node->robot, id);
    if (!handler || handler->instructions < kInstructions) {
        node->endless.clear();
    } else if (node->endless.empty()) {
        const aesl::Program* const its = program(id);
        const auto place = place_of(id, its != nullptr ? debug::line_of(*its, handler->pc) : 0);
        node->endless =
            (place ? place->first + ":" + std::to_string(place->second) : label(*node)) + ": " +
            debug::kEndlessText;
    }
    return node->endless;
}

void SimSession::send(Node& node) {
    Assignment& script = *node.script;
    const auto request = network_.load(node.id, script.program);
    if (!request.ok()) {
        enter(script, Stage::Failed);
        note(NoteKind::Trouble, script.path + ": " + request.error().what);
        return;
    }
    script.request = request.value();
    enter(script, Stage::Sent);
}

}  // namespace vagus::session
