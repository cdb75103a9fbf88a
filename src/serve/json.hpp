// JSON as pages get and send it: in this module `Json` is the library's value. The one with places,
// which reads files that people write, is JsonValue (base/json.hpp).
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace vagus::serve {

using Json = nlohmann::json;

}  // namespace vagus::serve
