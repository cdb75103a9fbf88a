#include "serve/field/versions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/folder.hpp"
#include "serve/json.hpp"
#include "serve/project/paths.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kIncoming = "incoming";
constexpr const char* kCurrent = "current";
constexpr const char* kNext = "next";  // the link before it is renamed
constexpr const char* kGone = "gone";
constexpr const char* kTrial = "trial.json";
constexpr const char* kList = "deployed.json";
constexpr const char* kFiles = "files";

Status outcome(const std::error_code& failed, const fs::path& path) {
    if (!failed) return Status::done();
    return Error{Code::Unavailable, fmt::format("{}: cannot be changed: {}; look at its rights and "
                                                "at the room on the disk",
                                                path.string(), failed.message())};
}

// 0 for what is no number.
uint32_t number_of(const std::string& name) {
    uint32_t number = 0;
    const auto [end, failed] = std::from_chars(name.data(), name.data() + name.size(), number);
    return failed == std::errc() && end == name.data() + name.size() ? number : 0;
}

// Files are on the disk as they are written; their names are not.
Status sync_tree(const fs::path& root) {
    std::error_code failed;
    for (auto entry = fs::recursive_directory_iterator(root, failed);
         !failed && entry != fs::recursive_directory_iterator(); entry.increment(failed)) {
        std::error_code unknown;
        if (entry->is_directory(unknown)) TRY(sync_folder(entry->path().string()));
    }
    TRY(outcome(failed, root));
    return sync_folder(root.string());
}

}  // namespace

Versions::Versions(fs::path project)
    : project_(std::move(project)), root_(project_ / kOwnFolder / "versions") {}

fs::path Versions::place(uint32_t version) const {
    return root_ / std::to_string(version);
}

Status Versions::tidy_up() {
    std::error_code failed;
    if (!fs::exists(root_, failed)) return Status::done();
    TRY(hold());
    forget_incoming();
    fs::remove(root_ / kNext, failed);
    fs::remove_all(root_ / kGone, failed);
    const auto begun = trial();
    if (!begun || begun->version == current()) return Status::done();
    // It was to be in force and never was.
    end_trial();
    remove(begun->version);
    return Status::done();
}

Status Versions::hold() {
    if (held_) return Status::done();
    auto lock = FolderLock::take(root_.string());
    if (!lock.ok() && lock.error().code == Code::Refused) {
        return Error{Code::Refused,
                     fmt::format("{}: another robot that is served from this folder keeps its "
                                 "versions in it; give each robot a copy of the project",
                                 project_.string())};
    }
    if (!lock.ok()) return lock.error();
    held_.emplace(std::move(lock.value()));
    return Status::done();
}

uint32_t Versions::current() const {
    std::error_code failed;
    const fs::path link = fs::read_symlink(root_ / kCurrent, failed);
    return failed ? 0 : number_of(link.string());
}

std::vector<uint32_t> Versions::all() const {
    std::vector<uint32_t> numbers;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(root_, failed)) {
        const uint32_t number = number_of(entry.path().filename().string());
        if (number > 0) numbers.push_back(number);
    }
    std::sort(numbers.begin(), numbers.end());
    return numbers;
}

fs::path Versions::folder(uint32_t version) const {
    if (version == 0) return project_;
    const auto read = bundle(version);
    const fs::path files = place(version) / kFiles;
    return read.ok() ? files / read.value().project : files;
}

Result<Bundle> Versions::bundle(uint32_t version) const {
    return read_bundle((place(version) / kList).string());
}

uint32_t Versions::before(uint32_t version) const {
    const auto read = bundle(version);
    const uint32_t wanted = read.ok() ? read.value().before : version;
    uint32_t found = 0;
    for (const uint32_t number : all()) {
        if (number <= wanted && number < version) found = number;
    }
    return found;
}

// ---- on its way here ----

Status Versions::begin() {
    TRY(hold());
    forget_incoming();
    std::error_code failed;
    fs::create_directories(root_ / kIncoming / kFiles, failed);
    return outcome(failed, root_);
}

Status Versions::add(const std::string& path, std::string_view content) {
    const fs::path file = root_ / kIncoming / kFiles / path;
    std::error_code failed;
    fs::create_directories(file.parent_path(), failed);
    TRY(outcome(failed, file));
    return write_file(file.string(), content);
}

fs::path Versions::incoming(const Bundle& bundle) const {
    return root_ / kIncoming / kFiles / bundle.project;
}

Result<uint32_t> Versions::finish(Bundle bundle) {
    bundle.before = current();
    const std::vector<uint32_t> there = all();
    const uint32_t number = std::max(there.empty() ? 0 : there.back(), bundle.before) + 1;
    const fs::path incoming = root_ / kIncoming;
    TRY(write_file((incoming / kList).string(), to_json(bundle).dump(1) + "\n"));
    TRY(sync_tree(incoming));
    TRY(write_trial({.version = number, .back = bundle.before}));
    std::error_code failed;
    fs::rename(incoming, place(number), failed);
    TRY(outcome(failed, incoming));
    TRY(sync_folder(root_.string()));
    return number;
}

void Versions::forget_incoming() {
    if (!held_) return;  // it is of another server, or there is none
    std::error_code failed;
    fs::remove_all(root_ / kIncoming, failed);
}

// ---- what is in force ----

Status Versions::put_in_force(uint32_t version) {
    std::error_code failed;
    if (version == 0) {
        fs::remove(root_ / kCurrent, failed);
        TRY(outcome(failed, root_ / kCurrent));
        return sync_folder(root_.string());
    }
    fs::remove(root_ / kNext, failed);
    fs::create_symlink(std::to_string(version), root_ / kNext, failed);
    TRY(outcome(failed, root_ / kNext));
    fs::rename(root_ / kNext, root_ / kCurrent, failed);
    TRY(outcome(failed, root_ / kCurrent));
    return sync_folder(root_.string());
}

std::optional<VersionTrial> Versions::trial() const {
    const auto text = read_file((root_ / kTrial).string());
    if (!text.ok()) return std::nullopt;
    const Json json = Json::parse(text.value(), nullptr, false);
    const auto number = [&](const char* key) {
        const bool there = json.is_object() && json.contains(key) && json[key].is_number_unsigned();
        return there ? json[key].get<uint32_t>() : 0u;
    };
    return VersionTrial{number("version"), number("back"), number("tries")};
}

Status Versions::write_trial(const VersionTrial& trial) {
    const Json json = {{"version", trial.version}, {"back", trial.back}, {"tries", trial.tries}};
    TRY(write_file((root_ / kTrial).string(), json.dump() + "\n"));
    return sync_folder(root_.string());
}

void Versions::end_trial() {
    std::error_code failed;
    fs::remove(root_ / kTrial, failed);
    // If it comes back after a power cut, it is told once more that this version starts.
    (void)sync_folder(root_.string()).ok();
}

void Versions::remove(uint32_t version) {
    if (version == 0 || version == current()) return;
    std::error_code failed;
    fs::rename(place(version), root_ / kGone, failed);  // never half a version under its number
    fs::remove_all(root_ / kGone, failed);
}

void Versions::remove_old() {
    std::vector<uint32_t> numbers = all();
    while (numbers.size() > kVersionsKept) {
        remove(numbers.front());
        numbers.erase(numbers.begin());
    }
}

}  // namespace vagus::serve
