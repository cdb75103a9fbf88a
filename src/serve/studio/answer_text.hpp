// What goes to a page, as text; and the limits of the protocol as lengths of time.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <variant>

#include "base/time.hpp"
#include "serve/json.hpp"
#include "serve/protocol/protocol.hpp"

namespace vagus::serve {

inline std::string answer_text(uint64_t id, const std::variant<nlohmann::json, Problem>& outcome) {
    nlohmann::json message = {{"id", id}};
    if (const auto* out = std::get_if<nlohmann::json>(&outcome)) {
        message["ok"] = *out;
        return json_text(message);
    }
    const Problem& problem = std::get<Problem>(outcome);
    message["error"] = {{"code", problem.code}, {"what", problem.what}};
    if (!problem.place.empty()) message["error"]["place"] = problem.place;
    return json_text(message);
}

inline Duration limit_ms(const char* name) {
    return std::chrono::milliseconds(Protocol::get().limit(name));
}

// The server's time as pages know it: milliseconds.
inline double server_ms(Time now) {
    return std::chrono::duration<double, std::milli>(now).count();
}

}  // namespace vagus::serve
