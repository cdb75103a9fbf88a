#include "trial/draft_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "base/json.hpp"
#include "plan/value.hpp"
#include "trial/from_recording.hpp"

namespace vagus::trial {

std::string last_part(const std::string& path) {
    return std::filesystem::path(path).filename().string();
}

std::string beside(const std::string& main, const std::string& name) {
    if (name.empty()) return "";
    const std::filesystem::path folder = std::filesystem::path(main).parent_path();
    return std::filesystem::path(name).lexically_relative(folder.empty() ? "." : folder).string();
}

double round_up(double seconds) {
    const double step = seconds > 20 ? 1 : 0.1;
    return std::ceil(seconds * kRoom / step) * step;
}

std::string number(double value) {
    return plan::text_of(std::round(value * 10) / 10);
}

std::string seed_of(const mcap::Reader& reader, const record::RunFile& run) {
    const mcap::Attachment* const world = reader.attachment(run.world);
    if (!run.seed.empty() || world == nullptr) return run.seed;
    const auto json = read_json(world->data);
    const auto* const tree = std::get_if<JsonValue>(&json);
    return tree == nullptr ? "" : text_in(*tree, "seed");
}

std::vector<std::string> first_members(const std::string& recording) {
    const std::string help = "Made from " + last_part(recording) + ": trim it to what matters.";
    return {"\"format\": \"vagus-test/1\"", "\"help\": " + json_quote(help)};
}

void add_files(std::vector<std::string>& members, std::string_view key, const std::string& main,
               const std::vector<std::string>& files) {
    std::string text;
    for (const std::string& one : files) {
        text += (text.empty() ? "" : ", ") + json_quote(beside(main, one));
    }
    if (!text.empty()) members.push_back(fmt::format("\"{}\": [{}]", key, text));
}

std::string seeds_member(const std::string& seed) {
    return fmt::format("\"seeds\": [{0}, {0}]", seed.empty() ? "1" : seed);
}

std::string expect_member(const std::vector<std::string>& expectations) {
    std::string text;
    for (const std::string& one : expectations) {
        text += (text.empty() ? "\n    " : ",\n    ") + one;
    }
    return "\"expect\": [" + text + "\n  ]";
}

std::string test_text(const std::vector<std::string>& members) {
    std::string text = "{";
    for (const std::string& member : members) {
        text += (text.size() > 1 ? ",\n  " : "\n  ") + member;
    }
    return text + "\n}\n";
}

std::vector<std::string> hints_of(const record::RunFile& run, size_t inputs) {
    std::vector<std::string> hints;
    if (inputs > 0) {
        hints.push_back(fmt::format(
            "{} times somebody did something to that run (/vagus/input); a test does not: put what "
            "is to happen into the timeline of the world",
            inputs));
    }
    if (!run.poses.empty()) {
        hints.emplace_back(
            "the run began at a place of its own (--pose); the test begins where the world says: "
            "add \"starts\"");
    }
    return hints;
}

}  // namespace vagus::trial
