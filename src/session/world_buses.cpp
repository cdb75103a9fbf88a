#include "session/world_buses.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "base/file.hpp"
#include "base/project_border.hpp"
#include "sim/world_file.hpp"

namespace vagus::session {

namespace {

// By their path: many robots have the same.
using ProjectFiles = std::map<std::string, ProjectFile>;

Result<const ProjectFile*> read_once(ProjectFiles& projects, const std::string& path) {
    const auto known = projects.find(path);
    if (known != projects.end()) return &known->second;
    return &projects.emplace(path, TRY(open_project(path))).first->second;
}

Status load_scripts(SimSession& session, sim::RobotId robot, const ProjectFile& project) {
    for (const std::string& named : project.scripts) {
        const std::string path = project.path_of(named);
        session.load_for(robot, path, TRY(read_file(path)));
    }
    return Status::done();
}

}  // namespace

Result<std::unique_ptr<WorldBuses>> WorldBuses::open(const std::string& path,
                                                     const SimOptions& options) {
    const std::string text = TRY(read_file(path));
    auto common = TRY(open_sim_text(path, text, options, Projects::Run));
    // make_unique cannot reach the constructor.
    std::unique_ptr<WorldBuses> made(new WorldBuses(std::move(common), options.traced));
    const sim::WorldDefinition& definition = made->world().definition();
    SimOptions of_robot = options;
    of_robot.heard = true;
    ProjectFiles projects;
    made->of_.assign(definition.robots.size(), &made->common_);
    for (size_t i = 0; i < definition.robots.size(); ++i) {
        const sim::RobotDefinition& robot = definition.robots[i];
        if (robot.project.empty()) continue;
        const sim::RobotId id{static_cast<uint32_t>(i) + 1};
        const auto fail = [&](const Error& error) {
            const std::string element = "robots[" + std::to_string(i) + "].project: ";
            return sim::error_in_world({error.code, element + error.what}, text, path);
        };
        const Result<std::string> beside = path_beside(path, robot.project);
        if (!beside.ok()) return fail(beside.error());
        const Result<const ProjectFile*> project = read_once(projects, beside.value());
        if (!project.ok()) return fail(project.error());
        made->robots_.push_back({id, robot.name, *project.value(),
                                 std::make_unique<SimSession>(made->world(), id, of_robot)});
        made->of_[i] = made->robots_.back().session.get();
        const Status loaded = load_scripts(*made->robots_.back().session, id, *project.value());
        if (!loaded.ok()) return fail(loaded.error());
    }
    return made;
}

const SimSession& WorldBuses::of(sim::RobotId robot) const {
    return *of_[robot.number - 1];
}

void WorldBuses::reload(const std::string& path, const std::string& text) {
    each([&](SimSession& one) { one.reload(path, text); });
}

std::vector<std::string> WorldBuses::script_paths() const {
    std::vector<std::string> paths;
    each([&paths](const SimSession& one) {
        for (std::string& path : one.script_paths()) {
            const bool known = std::find(paths.begin(), paths.end(), path) != paths.end();
            if (!known) paths.push_back(std::move(path));
        }
    });
    return paths;
}

bool WorldBuses::settled() const {
    return common_.settled() &&
           std::all_of(robots_.begin(), robots_.end(),
                       [](const RobotBus& robot) { return robot.session->settled(); });
}

bool WorldBuses::settle() {
    Duration within = common_.settles_within();
    for (const RobotBus& robot : robots_) {
        within = std::max(within, robot.session->settles_within());
    }
    for (Duration held{}; !settled() && held < within; held += sim::kNodeStep) {
        each([](SimSession& one) { one.before_hold(); });
        world().hold_instant();
        each([](SimSession& one) { one.after_hold(); });
    }
    gather();
    return settled();
}

void WorldBuses::begin_instant() {
    each([](SimSession& one) { one.before_nodes(); });
    world().begin_instant();
    each([](SimSession& one) { one.after_nodes(); });
    gather();
}

void WorldBuses::end_instant() {
    gather();
    const size_t told = world().happenings().size();
    world().end_instant();
    each([told](SimSession& one) { one.after_bodies(told); });
    gather();
}

void WorldBuses::reset() {
    common_.reset();
    for (RobotBus& robot : robots_) robot.session->begin_again();
}

void WorldBuses::gather() {
    if (!traced_) return;
    each([this](SimSession& one) { trace_ += one.take_trace(); });
}

void WorldBuses::trace(const std::string& lines) {
    gather();
    trace_ += lines;
}

std::string WorldBuses::take_trace() {
    gather();
    return std::exchange(trace_, {});
}

// By time; at one time the common bus first, then the robots in their order. Many robots have one
// script: what is to be said of it is said once.
std::vector<Note> WorldBuses::take_notes() {
    if (robots_.empty()) return common_.take_notes();
    std::vector<Note> all;
    each([&all](SimSession& one) {
        for (Note& note : one.take_notes()) {
            const bool of_script =
                note.kind == NoteKind::Mistakes || note.kind == NoteKind::Warnings;
            const bool again = of_script && std::any_of(all.begin(), all.end(), [&](const Note& n) {
                                   return n.kind == note.kind && n.text == note.text;
                               });
            if (!again) all.push_back(std::move(note));
        }
    });
    std::stable_sort(all.begin(), all.end(),
                     [](const Note& a, const Note& b) { return a.at < b.at; });
    return all;
}

std::vector<Diagnostic> WorldBuses::mistakes() const {
    std::vector<Diagnostic> list;
    each([&list](const SimSession& one) {
        for (Diagnostic& mistake : one.mistakes()) list.push_back(std::move(mistake));
    });
    return list;
}

std::vector<std::string> WorldBuses::without_script() const {
    std::vector<std::string> names;
    each([&names](const SimSession& one) {
        for (std::string& name : one.without_script()) names.push_back(std::move(name));
    });
    return names;
}

}  // namespace vagus::session
