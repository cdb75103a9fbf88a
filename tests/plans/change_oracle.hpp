// P31 once more, slowly and directly: follows a trace, knows plans only as JSON texts, and says
// what a change must lead to. For the property test of hot changes.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "plan/trace.hpp"

namespace vagus {

class ChangeOracle {
public:
    using Json = nlohmann::ordered_json;  // keys in file order
    using Texts = std::map<std::string, Json>;

    explicit ChangeOracle(Texts texts) : newest_(std::move(texts)) {}

    // Each line but those of changes.
    void see(const plan::TraceEvent& event);

    // Whether a version that has no check errors can take over now.
    bool accepts(const Texts& next) const;
    // It has; gives the lines that tell it.
    std::vector<std::string> accept(const Texts& next, const std::string& changed);
    const Texts& newest() const { return newest_; }

private:
    struct Level {
        std::string path;
        std::string file;
        std::string actor;       // active
        Json started;            // it, as it was started
        std::string on_its_way;  // the actor that its event leads to
        bool ends = false;       // its supervisors have been stopped with an outer actor
        std::set<std::string> remedy, resting, failed;  // global supervisors that do not watch
    };

    void activate(Level& level, const std::string& actor);
    bool accepts(const Level& level, const Json& next) const;
    bool watches(const Level& level, const std::string& global) const;
    const Json& plan(const Level& level) const { return newest_.at(level.file); }

    Texts newest_;
    std::vector<Level> levels_;
};

}  // namespace vagus
