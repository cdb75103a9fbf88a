// What a follower of a plan has to know of its file: names, and what contains what. It travels from
// the process of a run to the server with each version of the plan, so that nobody reads a file
// again that may say something else by now.
//
//     PlanFollower follower(std::make_shared<PlanOutlines>(outlines_of(loaded.plans())), doc_of);
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "plan/model.hpp"

namespace vagus::serve {

struct PlanOutline {
    struct Variable {
        std::string name = {}, type = {}, unit = {};
        static void layout(auto& each, auto& it) {
            each("name", it.name);
            each("type", it.type);
            each("unit", it.unit);
        }
        bool operator==(const Variable&) const = default;
    };
    struct Supervisor {
        std::string name = {};
        std::vector<std::string> events = {};
        static void layout(auto& each, auto& it) {
            each("name", it.name);
            each("events", it.events);
        }
        bool operator==(const Supervisor&) const = default;
    };
    struct Actor {
        std::string name = {};
        std::string template_name = {};        // or the path of its plan, as written
        std::optional<std::string> file = {};  // of its plan
        std::vector<Supervisor> supervisors = {};
        static void layout(auto& each, auto& it) {
            each("name", it.name);
            each("template_name", it.template_name);
            each("file", it.file);
            each("supervisors", it.supervisors);
        }
        bool operator==(const Actor&) const = default;
    };

    std::string file = {}, name = {};
    std::vector<Variable> configuration = {};
    std::vector<Supervisor> globals = {};
    std::vector<Actor> actors = {};
    static void layout(auto& each, auto& it) {
        each("file", it.file);
        each("name", it.name);
        each("configuration", it.configuration);
        each("globals", it.globals);
        each("actors", it.actors);
    }
    bool operator==(const PlanOutline&) const = default;
};

// Of a run, the outermost plan first.
using PlanOutlines = std::vector<PlanOutline>;

PlanOutlines outlines_of(const std::vector<plan::Plan>& plans);

}  // namespace vagus::serve
