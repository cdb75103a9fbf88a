// `vagus plan generate`: a plan as a C++ program (docs/plans.md, section 9).
//
// A marker file in the folder keeps a digest of each file that was written. A file that differs
// from its digest was changed by a person, and is not overwritten without --force.
#include "cli/plan/generate.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "base/file.hpp"
#include "base/json.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/plan/run.hpp"
#include "plan/check.hpp"
#include "plan/generate.hpp"
#include "session/toolboxes.hpp"
#include "toolbox/builtin.hpp"

namespace vagus::cli {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMarkerName = ".vagus-generated.json";
constexpr std::string_view kMarkerFormat = "vagus-generated/1";

using Texts = std::map<std::string, std::string>;  // by the name of the file

struct GenerateOptions {
    std::string file;
    std::vector<std::string> toolboxes;
    std::string folder;
    bool force = false;
};

// FNV-1a, 64 bits: against changes by accident, not by intent.
std::string digest_of(std::string_view text) {
    uint64_t digest = 0xcbf29ce484222325u;
    for (const char c : text) {
        digest ^= static_cast<unsigned char>(c);
        digest *= 0x100000001b3u;
    }
    return fmt::format("{:016x}", digest);
}

std::string format_marker(const Texts& files) {
    std::string text = fmt::format("{{\n  \"format\": \"{}\",\n  \"files\": {{", kMarkerFormat);
    for (const auto& [name, content] : files) {
        text += fmt::format("{}\n    {}: \"{}\"", text.ends_with('{') ? "" : ",", json_quote(name),
                            digest_of(content));
    }
    return text + "\n  }\n}\n";
}

// The digests of the files that an earlier generation wrote.
Result<Texts> read_marker(const fs::path& path) {
    const std::string text = TRY(read_file(path.string()));
    const auto json = read_json(text);
    const JsonValue* root = std::get_if<JsonValue>(&json);
    const JsonValue* files = root ? root->find("files") : nullptr;
    const JsonValue* format = root ? root->find("format") : nullptr;
    if (!files || !format || format->text != kMarkerFormat) {
        return Error{Code::BadInput,
                     fmt::format("{} is not what `vagus plan generate` wrote; remove it, and the "
                                 "generated files, or choose another folder",
                                 path.string())};
    }
    Texts digests;
    for (const JsonMember& member : files->members) digests[member.key] = member.value.text;
    return digests;
}

// The digests of what is in the folder from an earlier generation; an Error if the folder is
// somebody else's.
Result<Texts> look_at(const fs::path& folder) {
    std::error_code error;
    if (!fs::exists(folder, error)) return Texts();
    if (!fs::is_directory(folder, error)) {
        return Error{Code::Refused,
                     fmt::format("{} is no folder; give -o a new one or one that was "
                                 "generated",
                                 folder.string())};
    }
    if (fs::exists(folder / kMarkerName, error)) return read_marker(folder / kMarkerName);
    if (fs::is_empty(folder, error)) return Texts();
    return Error{Code::Refused, fmt::format("the folder {} holds other files and no {}; give -o an "
                                            "empty folder or one that was generated",
                                            folder.string(), kMarkerName)};
}

// The files that a person has changed since they were generated, or put there.
std::vector<std::string> changed_files(const fs::path& folder, const Texts& texts,
                                       const Texts& digests) {
    std::vector<std::string> changed;
    for (const auto& [name, text] : texts) {
        std::error_code error;
        if (!fs::exists(fs::symlink_status(folder / name, error))) continue;
        const Result<std::string> there = read_file((folder / name).string());
        if (there.ok() && there.value() == text) continue;
        const auto digest = digests.find(name);
        const bool ours =
            there.ok() && digest != digests.end() && digest->second == digest_of(there.value());
        if (!ours) changed.push_back((folder / name).string());
    }
    return changed;
}

// Files of the last generation that this one has not, as plans were renamed; changed ones stay.
void remove_stale(const fs::path& folder, const Texts& texts, const Texts& digests) {
    for (const auto& [name, digest] : digests) {
        if (texts.contains(name) || name.find('/') != std::string::npos) continue;
        const fs::path path = folder / name;
        const Result<std::string> there = read_file(path.string());
        std::error_code error;
        if (there.ok() && digest_of(there.value()) == digest) fs::remove(path, error);
    }
}

Status write_all(const fs::path& folder, const Texts& texts) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) {
        return Error{Code::Unavailable, fmt::format("the folder {} cannot be made: {}",
                                                    folder.string(), error.message())};
    }
    // The marker first: after a crash between two files the folder is still known as ours.
    TRY(write_file((folder / kMarkerName).string(), format_marker(texts)));
    for (const auto& [name, text] : texts) TRY(write_file((folder / name).string(), text));
    return Status::done();
}

int generate_into(const fs::path& folder, const Texts& texts, bool force) {
    const Result<Texts> digests = look_at(folder);
    if (!digests.ok()) return complain(digests.error(), kExitUsage);
    const std::vector<std::string> changed = changed_files(folder, texts, digests.value());
    if (!changed.empty() && !force) {
        return complain(
            fmt::format("changed since they were generated: {}; nothing was written; "
                        "--force overwrites them",
                        fmt::join(changed, ", ")));
    }
    remove_stale(folder, texts, digests.value());
    const Status written = write_all(folder, texts);
    return written.ok() ? kExitDone : complain(written.error());
}

int generate(const GenerateOptions& options) {
    const toolbox::Parts parts;
    run::CodeLibrary library;
    const Status added = session::add_toolboxes(library, parts, options.toolboxes);
    if (!added.ok()) return complain(added.error(), kExitUsage);
    const plan::Checked checked =
        plan::check(options.file, embed::PlanDisk(options.file), library.templates());
    show_findings(checked.findings);
    if (!checked.ok()) return kExitUsage;
    plan::OwnToolboxes own;
    for (const plan::Toolbox& toolbox : library.templates().toolboxes()) {
        if (!toolbox::is_builtin(toolbox.name)) own.insert(toolbox.name);
    }
    return generate_into(options.folder, plan::generate(checked, own), options.force);
}

}  // namespace

void add_plan_generate(CLI::App& plan, int& exit_code) {
    CLI::App* verb = plan.add_subcommand("generate", "writes a plan as a C++ program");
    verb->footer(
        "The program builds with CMake against the installed package Vagus.\n\nExample:\n"
        "  vagus plan generate Square.plan.json -o square");
    auto options = std::make_shared<GenerateOptions>();  // owners: CLI11's options, the callback
    add_plan_file(*verb, options->file);
    add_toolbox_option(*verb, options->toolboxes);
    takes_file(*verb->add_option("-o,--output", options->folder,
                                 "folder to write into: new, empty, or one that this verb made")
                    ->required(),
               {});
    verb->add_flag("--force", options->force, "overwrites also files that a person has changed");
    verb->callback([options, &exit_code] { exit_code = generate(*options); });
}

}  // namespace vagus::cli
