#include "serve/workbench/bundle.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <deque>
#include <nlohmann/json.hpp>
#include <set>

#include "base/file.hpp"
#include "base/project_border.hpp"
#include "base/text.hpp"
#include "serve/edit/edited_project.hpp"
#include "serve/edit/named_paths.hpp"
#include "serve/json.hpp"
#include "serve/project/files.hpp"
#include "serve/project/paths.hpp"
#include "serve/workbench/opened.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kFormat = "vagus-deployed/1";

Error too_much(const std::string& what) {
    return {Code::Limit, what + "; take out of its folder what the robot does not need"};
}

// A robot gets all of a project or nothing: what cannot be listed cannot be sent.
Status check_whole(const fs::path& root, const std::string& own) {
    const FolderScan scan = scan_folder(root);
    for (const ScanFault& fault : scan.passed_over) {
        if (fault.path == "." || is_below(own, fault.path)) {
            return Error{Code::BadInput, fmt::format("{}: {}; nothing was sent",
                                                     (root / fault.path).string(), fault.why)};
        }
    }
    if (!scan.more) return Status::done();
    return too_much(fmt::format("{}: more than {} files, or folders deeper than {}", root.string(),
                                kFilesMax, kFolderDepthMax));
}

// Files below the folder of the project, but not those of projects inside it.
std::set<std::string> own_files(const Files& files, const std::string& own) {
    bool more = false;
    const std::vector<FileInfo> listed = files.list(more);
    std::vector<std::string> inner;
    for (const FileInfo& file : listed) {
        const std::string folder = folder_of_path(file.path);
        if (file.kind == "project" && folder != own && is_below(own, folder)) {
            inner.push_back(folder);
        }
    }
    std::set<std::string> paths;
    for (const FileInfo& file : listed) {
        const bool other = std::any_of(inner.begin(), inner.end(), [&](const std::string& folder) {
            return is_below(folder, file.path);
        });
        if (file.kind != "folder" && is_below(own, file.path) && !other) paths.insert(file.path);
    }
    return paths;
}

// A file that is named and there, and that no project can send.
Status check_named(const Files& files, const std::string& by, const std::string& path) {
    const auto why = fault_of_path(path);
    std::error_code failed;
    const bool elsewhere = path.starts_with("/") || path.starts_with("../");
    if (!why || elsewhere || !fs::exists(files.root() / path, failed)) return Status::done();
    return Error{Code::BadInput, fmt::format("{} names {}: {}; nothing was sent",
                                             (files.root() / by).string(), path, *why)};
}

// What they name, and what that names.
Status add_named(const Files& files, std::set<std::string>& paths) {
    std::deque<std::string> left(paths.begin(), paths.end());
    while (!left.empty() && paths.size() <= kBundleFilesMax) {
        const std::string file = left.front();
        left.pop_front();
        const auto text = files.text(file);
        if (!text.ok()) continue;  // no text: it names nothing
        for (const NamedPath& named : named_paths(file, text.value())) {
            const std::string path = path_from(file, named.text);
            if (named.folder && is_border(path)) continue;
            TRY(check_named(files, file, path));
            if (files.exists(path) && paths.insert(path).second) left.push_back(path);
        }
    }
    return Status::done();
}

Result<BundleFile> described(const Files& files, const std::string& path) {
    const auto inside = path_in(files.root(), path);
    if (!inside.ok()) return inside.error();
    std::error_code failed;
    if (!fs::is_regular_file(inside.value(), failed)) {
        return Error{Code::BadInput, path + ": not a regular file; only files can be sent"};
    }
    const std::string bytes = TRY(read_file(inside.value().string()));
    return BundleFile{path, bytes.size(), sha256_of(bytes)};
}

}  // namespace

std::string sha256_of(std::string_view bytes) {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest;
    unsigned size = 0;
    EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
    return hex_of({reinterpret_cast<const char*>(digest.data()), size});
}

Result<CollectedBundle> collect_bundle(const std::string& project) {
    const OpenedProject opened = TRY(open_path(project));
    if (opened.project_file.empty()) {
        if (!opened.is_alone()) return no_project_file_in(opened.folder);
        return Error{Code::BadInput, project +
                                         ": expected a folder with a vagus.json; a file alone "
                                         "does not say what a robot does with it"};
    }
    Files files(opened.root);
    const std::string own = folder_of_path(opened.project_file);
    TRY(check_whole(opened.root, own));
    std::set<std::string> paths = own_files(files, own);
    paths.insert(opened.project_file);
    paths.insert(kProjectFileName);  // makes the border there what it is here
    TRY(add_named(files, paths));
    if (paths.size() > kBundleFilesMax) {
        return too_much(fmt::format("{}: more than {} files", project, kBundleFilesMax));
    }
    CollectedBundle collected{{.name = opened.name, .project = own}, opened.root};
    for (const std::string& path : paths) {
        collected.bundle.files.push_back(TRY(described(files, path)));
    }
    TRY(check_bundle(collected.bundle));
    return collected;
}

Status check_bundle(const Bundle& bundle) {
    if (!bundle.project.empty()) TRY(check_path(bundle.project));
    if (bundle.files.empty()) return Error{Code::BadInput, "a project without files"};
    std::set<std::string> seen;
    size_t bytes = 0;
    for (const BundleFile& file : bundle.files) {
        TRY(check_path(file.path));
        if (!seen.insert(file.path).second) {
            return Error{Code::BadInput, file.path + ": it is named twice"};
        }
        if (file.size > kBundleFileBytesMax) {
            return too_much(fmt::format("{}: {} bytes; a file may have {}", file.path, file.size,
                                        kBundleFileBytesMax));
        }
        bytes += file.size;
    }
    if (bytes > kBundleBytesMax || bundle.files.size() > kBundleFilesMax) {
        return too_much(fmt::format("{} files of {} bytes; a project may have {} of {}",
                                    bundle.files.size(), bytes, kBundleFilesMax, kBundleBytesMax));
    }
    const std::string own = bundle.project.empty() ? "" : bundle.project + "/";
    if (seen.contains(own + kProjectFileName)) return Status::done();
    return Error{Code::BadInput, own + kProjectFileName + ": expected among the files, not found"};
}

Json to_json(const Bundle& bundle) {
    Json files = Json::array();
    for (const BundleFile& file : bundle.files) {
        files.push_back({{"path", file.path}, {"size", file.size}, {"sha256", file.sha256}});
    }
    return {
        {"format", kFormat},       {"name", bundle.name},           {"project", bundle.project},
        {"before", bundle.before}, {"when_wall", bundle.when_wall}, {"files", std::move(files)}};
}

Result<Bundle> bundle_from(const Json& json) {
    try {
        Bundle bundle{.name = json.at("name"),
                      .project = json.at("project"),
                      .when_wall = json.value("when_wall", 0.0),
                      .before = json.value("before", 0u)};
        for (const Json& one : json.at("files")) {
            bundle.files.push_back({one.at("path"), one.at("size"), one.at("sha256")});
        }
        TRY(check_bundle(bundle));
        return bundle;
    } catch (const Json::exception& wrong) {
        return Error{Code::BadInput, wrong.what()};
    }
}

Result<Bundle> read_bundle(const std::string& file) {
    const Json json = Json::parse(TRY(read_file(file)), nullptr, false);
    const bool ours = json.is_object() && json.contains("format") && json["format"] == kFormat;
    const Result<Bundle> bundle =
        ours ? bundle_from(json) : Error{Code::BadInput, fmt::format("expected a {}", kFormat)};
    if (bundle.ok()) return bundle;
    return Error{Code::BadInput,
                 fmt::format("{}: {}; deploy the project again", file, bundle.error().what)};
}

}  // namespace vagus::serve
