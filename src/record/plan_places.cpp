#include "record/plan_places.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "base/file.hpp"
#include "base/json.hpp"
#include "embed/loaded_plan.hpp"

namespace vagus::record {

namespace {

Place place_in(const plan::Plan& plan, std::string_view name) {
    const auto among = [name](const std::vector<plan::Supervisor>& all) {
        const auto found = std::find_if(all.begin(), all.end(),
                                        [name](const auto& one) { return one.name == name; });
        return found == all.end() ? Place{} : found->line;
    };
    const int index = plan::find_actor(plan, name);
    if (index >= 0) return plan.actors[static_cast<size_t>(index)].line;
    if (const Place global = among(plan.globals); global.line > 0) return global;
    for (const plan::Actor& actor : plan.actors) {
        if (const Place its = among(actor.supervisors); its.line > 0) return its;
    }
    return {};
}

}  // namespace

// A part of the path behind the first is an actor that is a plan.
const plan::Plan* PlanPlaces::find(const std::string& path) const {
    if (plan_ == nullptr) return nullptr;
    const std::vector<plan::Plan>& plans = plan_->plans();
    const plan::Plan* at = &plans.front();
    size_t slash = path.find('/');
    while (slash != std::string::npos) {
        const size_t next = path.find('/', slash + 1);
        const int index = plan::find_actor(*at, path.substr(slash + 1, next - slash - 1));
        if (index < 0) return nullptr;
        const plan::Actor& actor = at->actors[static_cast<size_t>(index)];
        if (!actor.plan) return nullptr;
        const auto file =
            (std::filesystem::path(at->file).parent_path() / *actor.plan).lexically_normal();
        const auto found = std::find_if(plans.begin(), plans.end(), [&file](const auto& one) {
            return std::filesystem::path(one.file).lexically_normal() == file;
        });
        if (found == plans.end()) return nullptr;
        at = &*found;
        slash = next;
    }
    return at;
}

std::string PlanPlaces::place(const plan::Plan& plan, Place at) const {
    const std::string file = rerun_.name_of(plan.file);
    return at.line > 0 ? fmt::format("{}:{}", file, at.line) : file;
}

std::string PlanPlaces::element(const std::string& path, std::string_view name) const {
    const plan::Plan* const plan = find(path);
    return plan == nullptr ? "" : place(*plan, place_in(*plan, name));
}

std::string PlanPlaces::plan(const std::string& path) const {
    const plan::Plan* const plan = find(path);
    return plan == nullptr ? "" : place(*plan, plan->start_line);
}

std::string PlanPlaces::variable(const std::string& path, std::string_view name) const {
    const plan::Plan* const plan = find(path);
    if (plan == nullptr) return "";
    const auto found = std::find_if(plan->configuration.begin(), plan->configuration.end(),
                                    [name](const auto& one) { return one.name == name; });
    return place(*plan, found == plan->configuration.end() ? Place{} : found->line);
}

std::string PlanPlaces::timeline(size_t entry) const {
    const std::string& name = rerun_.about().world;
    const auto text = read_file(rerun_.path_of(name));
    if (!text.ok()) return name;
    const auto json = read_json(text.value());
    const auto* const tree = std::get_if<JsonValue>(&json);
    const JsonValue* const timeline = tree != nullptr ? tree->find("timeline") : nullptr;
    if (timeline == nullptr) return name;
    // The world has them by time, those of one time in the order of the file.
    std::vector<const JsonValue*> entries;
    for (const JsonValue& one : timeline->items) entries.push_back(&one);
    std::stable_sort(entries.begin(), entries.end(), [](const JsonValue* a, const JsonValue* b) {
        const JsonValue* const left = a->find("t");
        const JsonValue* const right = b->find("t");
        return left != nullptr && right != nullptr && left->number < right->number;
    });
    if (entry >= entries.size()) return name;
    return fmt::format("{}:{}", name, entries[entry]->at.line);
}

}  // namespace vagus::record
