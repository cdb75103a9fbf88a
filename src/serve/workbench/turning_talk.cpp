#include "serve/workbench/turning_talk.hpp"

#include <nlohmann/json.hpp>

#include "serve/json.hpp"

namespace vagus::serve {

namespace {

// Names of files may be any bytes.
std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string format_turning_asked(const TurningAsked& asked) {
    return text_of({{"file", asked.file},
                    {"condition", asked.condition},
                    {"tries", asked.tries},
                    {"results", asked.results}});
}

std::optional<TurningAsked> read_turning_asked(const std::string& text) {
    const Json json = Json::parse(text, nullptr, false);
    if (!json.is_object()) return std::nullopt;
    for (const char* key : {"file", "condition", "results"}) {
        if (!json.contains(key) || !json[key].is_string()) return std::nullopt;
    }
    if (!json.contains("tries") || !json["tries"].is_number_integer()) return std::nullopt;
    return TurningAsked{json["file"], json["condition"], json["tries"], json["results"]};
}

std::string format_progress(const TurningProgress& progress) {
    return text_of({{"stage", progress.stage}, {"done", progress.done}, {"of", progress.of}});
}

std::string format_turning_found(const TurningFound& found) {
    return text_of({{"sentence", found.sentence}, {"found", Json::parse(found.json)}});
}

std::string format_turning_refused(const std::string& why) {
    return text_of({{"error", why}});
}

}  // namespace vagus::serve
