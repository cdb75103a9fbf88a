#include "serve/json.hpp"

#include <nlohmann/json.hpp>

namespace vagus::serve {

std::string json_text(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace vagus::serve
