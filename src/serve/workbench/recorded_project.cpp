#include "serve/workbench/recorded_project.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "base/project_border.hpp"
#include "mcap/reader.hpp"
#include "record/past_run.hpp"
#include "serve/json.hpp"
#include "session/project_file.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

std::string project_file_of(const std::string& name, const record::RunFile& run,
                            const mcap::Reader& reader) {
    Json project = {{"format", "vagus-project/1"},
                    {"name", name},
                    {"help", "The files of the run that was recorded, as they were then."}};
    if (!run.plan.empty()) project["plan"] = run.plan;
    if (!run.world.empty()) project["world"] = run.world;
    if (!run.toolboxes.empty()) project["toolboxes"] = run.toolboxes;
    for (const mcap::Attachment& one : reader.attachments()) {
        // Robots with projects of their own have their scripts there.
        if (run.robots.empty() && one.name.ends_with(".aesl")) project["scripts"] += one.name;
    }
    for (const std::string& set : run.set) {
        const size_t equals = std::min(set.find('='), set.size());
        project["start"]["set"][set.substr(0, equals)] =
            set.substr(std::min(equals + 1, set.size()));
    }
    return project.dump(2) + "\n";
}

// One that only marks how far projects reach names nothing.
bool has_project_file(const mcap::Reader& reader) {
    const mcap::Attachment* const file = reader.attachment(kProjectFileName);
    if (file == nullptr) return false;
    const auto read = session::read_project_file(file->data, file->name);
    return read.ok() && !(read.value().plan.empty() && read.value().world.empty() &&
                          read.value().scripts.empty());
}

// What is refused by one file is not written around it.
Status write_files(const fs::path& folder, const std::string& name, const mcap::Reader& reader) {
    const record::RecordedRun run = TRY(record::read_recorded(reader));
    for (const mcap::Attachment& one : reader.attachments()) {
        TRY(record::write_inside(folder, one.name, one.data));
    }
    if (has_project_file(reader)) return Status::done();
    return write_file_unsynced((folder / kProjectFileName).string(),
                               project_file_of(name, run.about, reader));
}

// The recording comes last: a folder with it in it is whole.
Status make_project(const fs::path& folder, const fs::path& recording, std::string_view bytes) {
    const mcap::Reader reader = TRY(mcap::Reader::open(bytes, recording.string()));
    TRY(write_files(folder, recording.stem().string(), reader));
    return write_file_unsynced((folder / recording.filename()).string(), bytes);
}

}  // namespace

std::string numbered(const std::string& name, size_t number) {
    return number == 1 ? name : fmt::format("{}-{}", name, number);
}

bool same_bytes(const fs::path& one, const fs::path& other) {
    std::error_code failed;
    const uintmax_t size = fs::file_size(one, failed);
    if (failed || fs::file_size(other, failed) != size || failed) return false;
    if (size == 0) return true;
    const auto a = MappedFile::open(one.string());
    const auto b = MappedFile::open(other.string());
    return a.ok() && b.ok() && a.value().bytes() == b.value().bytes();
}

Result<RecordedProject> project_of_recording(const fs::path& recording, const fs::path& projects) {
    const MappedFile file = TRY(MappedFile::open(recording.string()));
    const std::string name = recording.filename().string();
    const std::string stem = recording.stem().string();
    std::error_code failed;
    for (size_t number = 1; number <= kCopiesMax; ++number) {
        const fs::path folder = projects / numbered(stem, number);
        RecordedProject made{.folder = folder.string(), .recording = name};
        if (same_bytes(folder / name, recording)) return made;
        if (fs::exists(folder, failed)) continue;
        fs::create_directories(folder, failed);
        const Status written = make_project(folder, recording, file.bytes());
        if (written.ok()) return made;
        fs::remove_all(folder, failed);
        return written.error();
    }
    return Error{Code::Limit,
                 fmt::format("{}: there are more than {} projects named {}; delete some",
                             projects.string(), kCopiesMax, stem)};
}

}  // namespace vagus::serve
