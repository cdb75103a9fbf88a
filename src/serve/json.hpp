// JSON as pages get and send it: in this module `Json` is the library's value. The one with places,
// which reads files that people write, is JsonValue (base/json.hpp).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vagus::serve {

using Json = nlohmann::json;

// One line. Text that is not UTF-8, as names of files may be, is replaced, not refused.
std::string json_text(const Json& json);

}  // namespace vagus::serve
