#include "serve/workbench/turning_talk.hpp"

#include <nlohmann/json.hpp>

#include "serve/json.hpp"

namespace vagus::serve {

std::string format_turning_asked(const TurningAsked& asked) {
    return json_text({{"file", asked.file},
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
    return json_text({{"stage", progress.stage}, {"done", progress.done}, {"of", progress.of}});
}

std::string format_turning_found(const TurningFound& found) {
    return json_text({{"sentence", found.sentence}, {"found", Json::parse(found.json)}});
}

std::string format_turning_refused(const std::string& why) {
    return json_text({{"error", why}});
}

}  // namespace vagus::serve
