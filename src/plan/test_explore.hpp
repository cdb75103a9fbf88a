// For tests of explore.hpp: a small toolbox, and plans from their texts.
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <utility>

#include "plan/check.hpp"
#include "plan/explore.hpp"

namespace vagus::plan {

class ExploreTexts final : public Files {
public:
    explicit ExploreTexts(std::map<std::string, std::string> texts) : texts_(std::move(texts)) {}
    Result<std::string> read(const std::string& path) const override {
        const auto found = texts_.find(path);
        if (found == texts_.end()) return Error{Code::NotFound, "there is no " + path};
        return found->second;
    }

private:
    std::map<std::string, std::string> texts_;
};

// Go (states Done, Blocked), Sit (none), Break (only fails), Step (a computation: Yes, No); See,
// which looks every 10 ms (Seen, Lost), and Hear, which waits for a word (Heard).
inline const Library& explore_library() {
    static const Library kLibrary = [] {
        const Input number{.name = "n", .type = Type::Int, .fallback = Value(int64_t{0})};
        const Input word{
            .name = "word", .type = Type::String, .fallback = Value(std::string("any"))};
        const OutputDeclaration result{.name = "r", .type = Type::Int};
        Toolbox core{.name = "core"};
        core.templates = {
            {.name = "Go",
             .inputs = {number},
             .outputs = {result},
             .outcomes = {{.name = "Done"}, {.name = "Blocked"}}},
            {.name = "Sit"},
            {.name = "Break", .only_fails = true},
            {.name = "Step",
             .kind = Kind::Computation,
             .inputs = {number},
             .outputs = {result},
             .outcomes = {{.name = "Yes"}, {.name = "No"}}},
            {.name = "See",
             .kind = Kind::Supervisor,
             .inputs = {number},
             .outputs = {result},
             .outcomes = {{.name = "Seen"}, {.name = "Lost"}}},
            {.name = "Hear",
             .kind = Kind::Supervisor,
             .inputs = {word, number},
             .outputs = {result},
             .outcomes = {{.name = "Heard"}},
             .period_ms = 0},
        };
        Library made;
        made.add(std::move(core));
        return made;
    }();
    return kLibrary;
}

using ExploreFiles = std::map<std::string, std::string>;

// "main.plan.json" is the outermost.
inline Checked checked_plans(const ExploreFiles& texts) {
    Checked checked = check("main.plan.json", ExploreTexts(texts), explore_library());
    EXPECT_TRUE(checked.ok()) << format_findings_json(checked.findings);
    return checked;
}

// A plan file of these parts, each the inside of its JSON object.
struct PlanParts {
    std::string name = "Main";
    std::string configuration = {};
    std::string globals = {};
    std::string actors;  // the first one is the start
};
inline std::string plan_text(const PlanParts& parts) {
    const size_t from = parts.actors.find('"') + 1;
    const std::string start = parts.actors.substr(from, parts.actors.find('"', from) - from);
    return "{ \"format\": \"vagus-plan/1\", \"name\": \"" + parts.name +
           "\",\n\"configuration\": {" + parts.configuration + "},\n\"start\": { \"actor\": \"" +
           start + "\", \"supervisors\": {" + parts.globals + "} },\n\"actors\": {\n" +
           parts.actors + "\n} }\n";
}

}  // namespace vagus::plan
