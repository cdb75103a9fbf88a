#include "plan/model.hpp"

namespace vagus::plan {

int find_variable(const Plan& plan, std::string_view name) {
    for (size_t i = 0; i < plan.configuration.size(); ++i) {
        if (plan.configuration[i].name == name) return static_cast<int>(i);
    }
    return -1;
}

int find_actor(const Plan& plan, std::string_view name) {
    for (size_t i = 0; i < plan.actors.size(); ++i) {
        if (plan.actors[i].name == name) return static_cast<int>(i);
    }
    return -1;
}

ActorNames::ActorNames(const Plan& plan) {
    for (size_t i = 0; i < plan.actors.size(); ++i) {
        index_.emplace(plan.actors[i].name, static_cast<int>(i));  // keeps the first of several
    }
}

int ActorNames::find(std::string_view name) const {
    const auto found = index_.find(name);
    return found == index_.end() ? -1 : found->second;
}

}  // namespace vagus::plan
