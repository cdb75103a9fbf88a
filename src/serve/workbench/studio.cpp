#include "serve/workbench/studio.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>

#include "serve/fleet/fleet_desk.hpp"
#include "serve/process.hpp"
#include "serve/workbench/pack.hpp"
#include "serve/workbench/server_loop.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

// A page of a file leads on: every user of the computer can read a command line.
std::string page_that_leads_to(const std::string& address) {
    return fmt::format(
        "<!doctype html><meta charset=\"utf-8\"><title>Vagus</title>"
        "<meta http-equiv=\"refresh\" content=\"0; url={0}\"><a href=\"{0}\">Vagus studio</a>\n",
        address);
}

WorkbenchPlaces places_of(const StudioOptions& options, const fs::path& data) {
    const fs::path config = user_config_folder(options.config);
    const char* home = std::getenv("HOME");
    return {.library = {data, share_folder() / "examples"},
            .settings = (config / "settings.json").string(),
            .program = kThisProgram,
            .home = home ? home : "/"};
}

Status open_first(const StudioOptions& options, ServerLoop& server) {
    const Time now = server.links().now();
    if (!options.example.empty()) return server.bench().open_example(options.example, now);
    if (!options.project.empty()) return server.bench().open(options.project, now);
    return Status::done();
}

// What is saved of the project that is open: what robots of the fleet can get.
std::optional<OpenVersion> version_of(const Workbench& bench) {
    const std::optional<OpenedProject>& project = bench.project();
    if (!project || project->project_file.empty()) return std::nullopt;
    const auto packed = [folder = project->folder]() -> vagus::Result<PackedVersion> {
        const CollectedBundle collected = TRY(collect_bundle(folder));
        std::string bytes = TRY(pack(collected));
        std::string sha256 = sha256_of(bytes);
        return PackedVersion{std::move(bytes), std::move(sha256)};
    };
    return OpenVersion{project->name, bench.unsaved(), packed};
}

fs::path first_page(const fs::path& data) {
    return data / "open.html";
}

void tell_address(const StudioTalk& talk, const Door& door, const fs::path& data) {
    const std::string address = door.address() + "#token=" + door.token();
    talk.print("studio " + address);
    if (door.is_open_and_plain()) talk.log(kPlainWords);
    const fs::path page = first_page(data);
    if (write_secret(page, page_that_leads_to(address)).ok()) talk.show(page.string());
}

// The page of the last start leads here also with a new token.
DoorOptions door_of(const StudioOptions& options, const StudioTalk& talk, const fs::path& data) {
    DoorOptions door = options.door;
    door.renewed = [talk, data](const std::string& address) {
        talk.print("studio " + address);
        const Status written = write_secret(first_page(data), page_that_leads_to(address));
        if (!written.ok()) talk.log(written.error().what);
    };
    return door;
}

}  // namespace

Status run_studio(const StudioOptions& options, const StudioTalk& talk) {
    const fs::path data = user_data_folder(options.data);
    ServerLoop server;
    TRY(server.open(door_of(options, talk, data), data, talk.log, places_of(options, data)));
    server.bench().on_end(
        [&server, &talk](const life::End&) { talk.log(server.bench().end_in_words()); });
    net::Links& links = server.links();
    Worker packer([&links] { links.wake(); });
    FleetDesk fleet(server.desk(),
                    [&links](LinkOptions link) {
                        return std::make_unique<MosquittoLink>(std::move(link),
                                                               [&links] { links.wake(); });
                    },
                    {.shelf = options.shelf,
                     .version = [&server] { return version_of(server.bench()); },
                     .work = packer.poster(),
                     .file = (data / "rollout.json").string()});
    if (!options.fleet.target.empty()) TRY(fleet.open(options.fleet, links.now()));
    TRY(open_first(options, server));
    tell_address(talk, server.door(), data);
    server.run({.next_tick = [&fleet](Time) { return fleet.next_tick(); },
                .tick =
                    [&fleet, &packer](Time now) {
                        packer.tick();
                        fleet.tick(now);
                    },
                .before_end = [&fleet] { fleet.close(); }});
    return Status::done();
}

}  // namespace vagus::serve
