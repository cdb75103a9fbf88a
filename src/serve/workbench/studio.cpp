#include "serve/workbench/studio.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

#include "net/network.hpp"
#include "serve/process.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr Duration kLastWords = 500ms;  // for what was sent before the end

// A page of a file leads on: what stands on a command line every user of the computer can read.
std::string page_that_leads_to(const std::string& address) {
    return fmt::format(
        "<!doctype html><meta charset=\"utf-8\"><title>Vagus</title>"
        "<meta http-equiv=\"refresh\" content=\"0; url={0}\"><a href=\"{0}\">Vagus studio</a>\n",
        address);
}

class Studio {
public:
    Studio(const StudioOptions& options, const StudioTalk& talk) : options_(options), talk_(talk) {}

    Status run() {
        TRY(network_.watch_signals());
        TRY(begin());
        while (!ended_) {
            const Time now = network_.now();
            const Time next = std::min(bench_->next_tick(now), desk_->next_tick(now));
            for (const net::Event& event : network_.poll(next)) hear(event);
            turn();
        }
        end();
        return Status::done();
    }

private:
    Status begin() {
        const fs::path data = user_data_folder(options_.data);
        door_.emplace(TRY(Door::open(options_.door, data, [this] { network_.wake(); })));
        desk_ = std::make_unique<Desk>(door_->access(), door_->outside(talk_.log));
        bench_ = std::make_unique<Workbench>(network_, *desk_, places(data));
        const Status opened = open_first();
        if (!opened.ok()) return opened;
        tell_address(data);
        return Status::done();
    }

    WorkbenchPlaces places(const fs::path& data) const {
        const fs::path config = user_config_folder(options_.config);
        const char* home = std::getenv("HOME");
        return {.library = {data, share_folder() / "examples"},
                .settings = (config / "settings.json").string(),
                .program = kThisProgram,
                .home = home ? home : "/"};
    }

    Status open_first() {
        const Time now = network_.now();
        if (!options_.example.empty()) return bench_->open_example(options_.example, now);
        if (!options_.project.empty()) return bench_->open(options_.project, now);
        return Status::done();
    }

    void tell_address(const fs::path& data) {
        const std::string address = door_->address() + "#token=" + door_->token();
        talk_.print("studio " + address);
        if (door_->is_open_and_plain()) talk_.log(kPlainWords);
        const fs::path page = data / "open.html";
        if (write_secret(page, page_that_leads_to(address)).ok()) talk_.show(page.string());
    }

    void hear(const net::Event& event) {
        if (event.kind == net::EventKind::Signal) {
            ended_ = true;
        } else {
            bench_->hear(event);
        }
    }

    void turn() {
        const Time now = network_.now();
        for (const WebEvent& event : door_->web().take()) desk_->hear(event, now);
        bench_->tick(now);
        desk_->tick(now);
    }

    // Robots must not go on without anybody, and no text may be lost.
    void end() {
        bench_->stop_everything();
        const Time until = network_.now() + kLastWords;
        while (network_.now() < until && network_.has_unwritten()) (void)network_.poll(until);
        bench_->close();
        desk_->tick(network_.now());
    }

    const StudioOptions& options_;
    const StudioTalk& talk_;
    net::Network network_;
    std::optional<Door> door_;
    std::unique_ptr<Desk> desk_;
    std::unique_ptr<Workbench> bench_;
    bool ended_ = false;
};

}  // namespace

Status run_studio(const StudioOptions& options, const StudioTalk& talk) {
    return Studio(options, talk).run();
}

}  // namespace vagus::serve
