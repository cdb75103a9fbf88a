// What changed from one JSON value to another, as a merge patch (RFC 7396): what a client applies
// to the old one to have the new one. null means "goes", so documents hold no null in objects.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace vagus::serve {

// Both are objects. Empty if nothing changed.
nlohmann::json merge_patch(const nlohmann::json& from, const nlohmann::json& to);

}  // namespace vagus::serve
