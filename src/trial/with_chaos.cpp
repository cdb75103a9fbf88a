#include "trial/with_chaos.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/project_border.hpp"
#include "sim/chaos_file.hpp"

namespace vagus::trial {

namespace {

namespace fs = std::filesystem;

// Puts it in the place of the member, or before the last one, which says what is expected.
void set(JsonValue& object, std::string_view key, JsonValue value) {
    for (JsonMember& member : object.members) {
        if (member.key != key) continue;
        member.value = std::move(value);
        return;
    }
    const auto last = object.members.empty() ? object.members.end() : object.members.end() - 1;
    object.members.insert(last, json_member(key, std::move(value)));
}

Result<JsonValue> seen_from(const std::string& path, const std::string& named) {
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(path, error).parent_path(), error);
    const fs::path file = fs::weakly_canonical(fs::absolute(named, error), error);
    const std::string relative = file.lexically_relative(folder).generic_string();
    (void)TRY(path_beside(path, relative));  // it may lead out of a project
    return json_string(relative);
}

Status set_files(JsonValue& object, std::string_view key, const std::string& path,
                 const std::vector<std::string>& files) {
    std::vector<JsonValue> seen;
    for (const std::string& one : files) seen.push_back(TRY(seen_from(path, one)));
    if (!seen.empty()) set(object, key, json_array(std::move(seen)));
    return Status::done();
}

}  // namespace

Result<std::string> with_chaos(const TestFile& test, std::string_view text,
                               const Breaking& breaking, const std::string& path) {
    JsonValue json = TRY(parse_json(text, test.path));
    if (!test.plan.empty()) set(json, "plan", TRY(seen_from(path, test.plan)));
    set(json, "world", TRY(seen_from(path, test.world)));
    TRY(set_files(json, "scripts", path, test.scripts));
    TRY(set_files(json, "toolboxes", path, test.toolboxes));
    const auto seed = static_cast<int64_t>(breaking.seed);
    set(json, "seeds", json_array({json_integer(seed), json_integer(seed)}));
    set(json, "chaos", TRY(parse_json(sim::format_chaos(breaking.faults), path)));
    return format_json(json);
}

}  // namespace vagus::trial
