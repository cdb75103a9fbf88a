// What differs between two versions of a plan file, element by element, and the way back: applying
// the differences to the one gives the other. What a plan file says: docs/plans.md, section 2.
//
//     const JsonValue old_plan = read_plan_tree(old_text, "a/Main.plan.json").value();
//     const JsonValue new_plan = read_plan_tree(new_text, "b/Main.plan.json").value();
//     const Differences all = differences(old_plan, new_plan);
//     print(format_text(all, {.places = false}));
//
// Files are compared in their saved form, so spaces and the order of an element's keys are no
// difference; the order of actors, supervisors, variables, inputs and outputs is one (P0, P21).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"
#include "base/result.hpp"

namespace vagus::plan {

// A plan file as a tree in its saved form. The Error, FILE:LINE:COL, is its first P0 or P1.
Result<JsonValue> read_plan_tree(std::string_view text, std::string_view path);

enum class DifferenceKind : uint8_t { Added, Removed, Changed, Reordered };
// "added", "removed", "changed", "reordered".
std::string_view name_of(DifferenceKind kind);

struct Difference {
    DifferenceKind kind = DifferenceKind::Changed;
    // Keys from the root: {"actors", "drive", "states", "Done"}. Of what is reordered, the list.
    std::vector<std::string> path;
    JsonValue before;    // not if added. Of what is reordered, the names that both have, in order
    JsonValue after;     // not if removed
    std::string behind;  // if added: the key in front of it; empty: it is the first
};
// Where an element stands in the drawing: below `layout`.
bool is_place(const Difference& difference);

using Differences = std::vector<Difference>;  // in the order of the file

Differences differences(const JsonValue& before, const JsonValue& after);

// Gives the tree that `after` was. The Error names what `before` does not have, or has otherwise
// than the difference says.
Result<JsonValue> apply_differences(const Differences& all, JsonValue before);

struct DifferencesText {
    bool places = false;  // one line each; else how many there are, in one line
};
// For people: an element a block, "-" before what was, "+" before what is.
std::string format_text(const Differences& all, DifferencesText how);
// One object: docs/explore.md.
std::string format_json(const Differences& all);

}  // namespace vagus::plan
