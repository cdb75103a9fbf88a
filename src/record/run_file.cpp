#include "record/run_file.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <utility>

#include "base/file.hpp"
#include "base/json.hpp"
#include "toolbox/version.hpp"

namespace vagus::record {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFormat = "vagus-recording/1";

// Each text of a RunFile, and each list, by its key.
struct TextKey {
    std::string_view key;
    std::string RunFile::*at;
};
constexpr TextKey kTexts[] = {
    {"kind", &RunFile::kind},         {"verb", &RunFile::verb},      {"plan", &RunFile::plan},
    {"world", &RunFile::world},       {"from", &RunFile::from},      {"seed", &RunFile::seed},
    {"max_time", &RunFile::max_time}, {"robot", &RunFile::robot},    {"answers", &RunFile::answers},
    {"bus", &RunFile::bus},           {"project", &RunFile::project}};
struct ListKey {
    std::string_view key;
    std::vector<std::string> RunFile::*at;
};
constexpr ListKey kLists[] = {{"command", &RunFile::command}, {"toolboxes", &RunFile::toolboxes},
                              {"set", &RunFile::set},         {"poses", &RunFile::poses},
                              {"loads", &RunFile::loads},     {"robots", &RunFile::robots}};

fs::path absolute(const std::string& path) {
    std::error_code error;
    return fs::absolute(path, error).lexically_normal();
}

fs::path shared_part(const fs::path& a, const fs::path& b) {
    fs::path shared;
    for (auto i = a.begin(), j = b.begin(); i != a.end() && j != b.end() && *i == *j; ++i, ++j) {
        shared /= *i;
    }
    return shared;
}

Error not_a_run(const std::string& name, const std::string& why) {
    return {Code::BadInput,
            name + ": is no recording that can be run again: " + why +
                "; record with `vagus plan run … --record FILE` or `vagus sim … --record FILE`"};
}

}  // namespace

std::string format_run(const RunFile& run) {
    std::string text = fmt::format(R"({{"format":"{}","vagus":"{}")", kFormat, toolbox::kVersion);
    if (!run.chaos.empty()) text += ",\"chaos\":" + json_quote(run.chaos);
    for (const TextKey& one : kTexts) {
        text += fmt::format(",\"{}\":{}", one.key, json_quote(run.*one.at));
    }
    for (const ListKey& one : kLists) {
        std::string list;
        for (const std::string& item : run.*one.at) {
            list += (list.empty() ? "" : ",") + json_quote(item);
        }
        text += fmt::format(",\"{}\":[{}]", one.key, list);
    }
    return text + "}";
}

Result<RunFile> read_run(std::string_view text, const std::string& name) {
    const auto json = read_json(text);
    const auto* const tree = std::get_if<JsonValue>(&json);
    if (tree == nullptr || tree->kind != JsonKind::Object) {
        return not_a_run(name, "its channel /vagus/run has no JSON object");
    }
    const JsonValue* const format = tree->find("format");
    if (format == nullptr || format->text != kFormat) {
        return not_a_run(name, fmt::format("expected the format \"{}\", found \"{}\"", kFormat,
                                           format != nullptr ? format->text : "nothing"));
    }
    RunFile run;
    const JsonValue* const chaos = tree->find("chaos");
    if (chaos != nullptr) run.chaos = chaos->text;
    for (const TextKey& one : kTexts) {
        const JsonValue* const value = tree->find(one.key);
        if (value != nullptr && value->kind == JsonKind::String) run.*one.at = value->text;
    }
    for (const ListKey& one : kLists) {
        const JsonValue* const value = tree->find(one.key);
        if (value == nullptr) continue;
        for (const JsonValue& item : value->items) (run.*one.at).push_back(item.text);
    }
    return run;
}

Status check_no_fleet(const RunFile& run, const std::string& name, std::string_view instead) {
    if (run.robots.empty()) return Status::done();
    return Error{Code::Refused,
                 fmt::format("{}: is of a world in which {} robots have projects of their own{}",
                             name, run.robots.size(), instead)};
}

std::string PackedFiles::name_of(const std::string& path) const {
    return path.empty() ? "" : absolute(path).lexically_relative(root).generic_string();
}

PackedFiles pack(const std::map<std::string, std::string>& read) {
    PackedFiles packed;
    fs::path root;
    bool first = true;
    for (const auto& [path, content] : read) {
        const fs::path folder = absolute(path).parent_path();
        root = std::exchange(first, false) ? folder : shared_part(root, folder);
    }
    packed.root = root.string();
    for (const auto& [path, content] : read) packed.files.emplace(packed.name_of(path), content);
    return packed;
}

Status write_inside(const std::string& folder, const std::string& name, std::string_view content) {
    const fs::path inside = fs::path(name).lexically_normal();
    if (inside.empty() || inside.is_absolute() || *inside.begin() == "..") {
        return Error{Code::Refused, "the file \"" + name +
                                        "\" of the recording leads out of its folder; it is not "
                                        "written"};
    }
    const fs::path path = fs::path(folder) / inside;
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    return write_file_unsynced(path.string(), content);
}

Result<UnpackedFolder> UnpackedFolder::make() {
    return UnpackedFolder(TRY(TemporaryFolder::make("unpacked")));
}

std::string UnpackedFolder::path_of(const std::string& name) const {
    return name.empty() ? ""
                        : (fs::path(folder_.path()) / fs::path(name).lexically_normal()).string();
}

}  // namespace vagus::record
