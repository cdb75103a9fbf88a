#include "tests/plans/random_change.hpp"

#include <fmt/format.h>

#include <utility>

namespace vagus {

namespace {

using Json = ChangeOracle::Json;

class Changer {
public:
    Changer(Json& plan, SplitMix64& random) : plan_(plan), random_(random) {}

    void change() {
        switch (below(16)) {
            case 0:
                return;
            case 1:
            case 2:
                return retarget(some(plan_["actors"])["states"]);
            case 3:
                return retarget(some_supervisor()["events"]);
            case 4:
                return swap_kinds();
            case 5:
                return remove_actor();
            case 6:
                return rename(some_supervisors());
            case 7:
                return remove(some_supervisors());
            case 8:
                return add(some_supervisors());
            case 9:
                return turn_round(some_supervisors());
            case 10:
                return change_period(some_supervisor());
            case 11:
                return change_input();
            case 12:
                return add_variable();
            case 13:
                return remove(plan_["configuration"]);
            case 14:
                return change_variable();
            default:
                return change_formulas();
        }
    }

private:
    uint64_t below(uint64_t bound) { return random_.below(bound); }
    Json& some(Json& object) {
        if (object.empty()) return nothing_ = Json::object();
        auto at = object.begin();
        std::advance(at, static_cast<std::ptrdiff_t>(below(object.size())));
        return at.value();
    }
    std::string some_actor() {
        auto at = plan_["actors"].begin();
        std::advance(at, static_cast<std::ptrdiff_t>(below(plan_["actors"].size())));
        return at.key();
    }
    Json& some_supervisors() {
        return below(2) == 0 ? plan_["start"]["supervisors"] : some(plan_["actors"])["supervisors"];
    }
    Json& some_supervisor() { return some(some_supervisors()); }

    void retarget(Json& targets) {
        if (!targets.empty()) some(targets) = below(9) == 0 ? "@terminate" : some_actor();
    }

    // What one actor does and what another does, exchanged.
    void swap_kinds() { std::swap(some(plan_["actors"]), some(plan_["actors"])); }

    void remove_actor() {
        const std::string gone = some_actor();
        if (plan_["actors"].size() < 2 || plan_["start"]["actor"] == gone) return;
        plan_["actors"].erase(gone);
        const std::string instead = some_actor();
        const auto lead = [&](Json& targets) {
            for (auto& [name, target] : targets.items()) {
                if (target == gone) target = instead;
            }
        };
        const auto lead_all = [&](Json& supervisors) {
            for (auto& [name, supervisor] : supervisors.items()) lead(supervisor["events"]);
        };
        lead_all(plan_["start"]["supervisors"]);
        for (auto& [name, actor] : plan_["actors"].items()) {
            lead(actor["states"]);
            if (actor.contains("supervisors")) lead_all(actor["supervisors"]);
        }
    }

    void rename(Json& objects) {
        if (objects.empty()) return;
        Json renamed = Json::object();
        const uint64_t chosen = below(objects.size());
        uint64_t index = 0;
        for (const auto& [name, value] : objects.items()) {
            renamed[index++ == chosen ? new_name() : name] = value;
        }
        objects = renamed;
    }

    void remove(Json& objects) {
        if (objects.empty()) return;
        auto at = objects.begin();
        std::advance(at, static_cast<std::ptrdiff_t>(below(objects.size())));
        objects.erase(at.key());
    }

    void add(Json& supervisors) {
        const Json made = {{"template", "Every"},
                           {"period_ms", 7 + below(20)},
                           {"in", {{"seconds", 0.02}}},
                           {"events", {{"Tick", some_actor()}}}};
        Json all = Json::object();
        if (below(2) == 0) all[new_name()] = made;
        for (const auto& [name, value] : supervisors.items()) all[name] = value;
        if (all.size() == supervisors.size()) all[new_name()] = made;
        supervisors = all;
    }

    void turn_round(Json& objects) {
        Json turned = Json::object();
        for (auto at = objects.rbegin(); at != objects.rend(); ++at) turned[at.key()] = at.value();
        objects = turned;
    }

    void change_period(Json& supervisor) {
        if (supervisor.value("template", "") == "Every") supervisor["period_ms"] = 1 + below(40);
    }

    void change_input() {
        Json& actor = below(2) == 0 ? some(plan_["actors"]) : some_supervisor();
        if (!actor.contains("template")) return;
        if (actor["template"] == "Send" && actor["in"].contains("args")) {
            actor["in"].erase("args");
        } else if (actor["in"].contains("seconds")) {
            actor["in"]["seconds"] = 0.03;
        }
    }

    void change_formulas() {
        for (auto& [name, actor] : plan_["actors"].items()) {
            if (!actor.contains("in") || !actor["in"].contains("value")) continue;
            actor["in"]["value"] = fmt::format("n + {}", below(5));
        }
    }

    void add_variable() {
        Json all = Json::object();
        const Json made = {{"type", "int"}, {"initial", below(100)}};
        if (below(2) == 0) all[new_name()] = made;
        for (const auto& [name, value] : plan_["configuration"].items()) all[name] = value;
        if (all.size() == plan_["configuration"].size()) all[new_name()] = made;
        plan_["configuration"] = all;
    }

    // Nothing is in a variable's way that nothing reads: often it can have another type.
    void change_variable() {
        Json& variable = some(plan_["configuration"]);
        if (below(3) == 0) {
            variable["access"] = "out";
        } else {
            variable = {{"type", "string"}, {"initial", "1"}};
        }
    }

    std::string new_name() { return fmt::format("new{}", below(1'000'000)); }

    Json& plan_;
    SplitMix64& random_;
    Json nothing_;
};

}  // namespace

std::string change_at_random(ChangeOracle::Texts& texts, SplitMix64& random) {
    auto file = texts.begin();
    // Often the outermost: it runs always.
    if (random.below(2) == 0) {
        std::advance(file, static_cast<std::ptrdiff_t>(random.below(texts.size())));
    }
    Changer changer(file->second, random);
    for (uint64_t i = 1 + random.below(3); i > 0; --i) changer.change();
    return file->first;
}

}  // namespace vagus
