// Breakpoints of scripts as the project keeps them: by document and line, whether a robot is there
// or not, until a person removes them. The nodes' own are made from these.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "serve/project/line_map.hpp"

namespace vagus::serve {

constexpr size_t kBreakpointsMax = 1000;

struct ScriptBreakpoint {
    std::string doc;
    int line = 0;
    std::string condition;
    uint32_t ignore = 0;  // it stops after so many hits
    bool enabled = true;
    bool once = false;  // set by the studio itself until a node is paused there; nobody sees it
    // ---- of this session ----
    uint32_t hits = 0;
    bool set = false;  // the node said so
    std::string why;   // why it is not
};

class ScriptBreakpoints {
public:
    const std::vector<ScriptBreakpoint>& all() const { return all_; }
    ScriptBreakpoint* find(const std::string& doc, int line);
    // A new one, or the one there is.
    Result<ScriptBreakpoint*> set(const std::string& doc, int line);
    // Without a line all of the document, without a document all.
    void clear(const std::optional<std::string>& doc, std::optional<int> line);
    // Where nobody has one: until a node is paused at one of these, or nobody waits for it any
    // more.
    Status set_once(const std::string& doc, int line);
    bool clear_once();
    // A node has not said yet whether it has one of these.
    bool waits_for_once() const;
    // The text of a document has changed: each stays with its line, or goes with it. Whether any is
    // another one now.
    bool follow(const std::string& doc, const LineMap& lines);
    // A file has another name.
    void rename(const std::string& from, const std::string& to);

    // What state.json keeps.
    nlohmann::json to_json() const;
    void from_json(const nlohmann::json& kept);

private:
    std::vector<ScriptBreakpoint> all_;
};

}  // namespace vagus::serve
