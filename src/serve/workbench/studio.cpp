#include "serve/workbench/studio.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "base/file.hpp"
#include "net/network.hpp"
#include "serve/process.hpp"
#include "serve/workbench/workbench.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr Duration kLastWords = 500ms;  // for what was sent before the end

double wall_ms() {
    return std::chrono::duration<double, std::milli>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

bool is_loopback(const std::string& address) {
    return address == "::1" || address.starts_with("127.");
}

// Beside the program, where it is installed and where it is built.
fs::path share_folder() {
    return fs::path(own_program()).parent_path().parent_path() / "share" / "vagus";
}

// Only its owner may read it.
Status write_secret(const fs::path& file, const std::string& text) {
    std::error_code failed;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
    const mode_t before = umask(0077);
    const Status written = write_file(file.string(), text);
    umask(before);
    return written;
}

Result<std::string> token_from(const std::string& file) {
    std::error_code failed;
    if (fs::exists(file, failed)) return token_in(TRY(read_file(file)), file);
    std::array<uint8_t, 16> random;
    const std::string bytes = random_bytes(random.size());
    std::memcpy(random.data(), bytes.data(), random.size());
    const std::string token = token_of(random);
    TRY(write_secret(file, token + "\n"));
    return token;
}

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
        const fs::path data = options_.data.empty() ? user_data_folder() : fs::path(options_.data);
        const std::string token_file =
            options_.token_file.empty() ? (data / "token").string() : options_.token_file;
        const std::string token = TRY(token_from(token_file));
        std::optional<std::string> look;
        if (!options_.look_token_file.empty()) look = TRY(token_from(options_.look_token_file));
        TRY(listen());
        desk_ = std::make_unique<Desk>(
            Access(token, look),
            Desk::Outside{.send =
                              [this](ClientId client, bool binary, std::string bytes) {
                                  binary ? web_->send_binary(client, std::move(bytes))
                                         : web_->send(client, std::move(bytes));
                              },
                          .close = [this](ClientId client,
                                          std::string reason) { web_->close(client, reason); },
                          .log = talk_.log,
                          .wall_ms = wall_ms});
        bench_ = std::make_unique<Workbench>(network_, *desk_, places(data));
        const Status opened = open_first();
        if (!opened.ok()) return opened;
        tell_address(token, data);
        return Status::done();
    }

    WorkbenchPlaces places(const fs::path& data) const {
        const fs::path config =
            options_.config.empty() ? user_config_folder() : fs::path(options_.config);
        const char* home = std::getenv("HOME");
        return {.library = {data, share_folder() / "examples"},
                .settings = (config / "settings.json").string(),
                .program = kThisProgram,
                .home = home ? home : "/"};
    }

    Status listen() {
        WebOptions web;
        web.address = options_.listen;
        web.pages = options_.pages.empty() ? (share_folder() / "pages").string() : options_.pages;
        web.hosts = options_.hosts;
        web.tls_cert = options_.tls_cert;
        web.tls_key = options_.tls_key;
        web.port = static_cast<uint16_t>(options_.port < 0 ? kStudioPort : options_.port);
        const auto wake = [this] { network_.wake(); };
        auto started = WebServer::start(web, wake);
        if (!started.ok() && options_.port < 0) {
            web.port = 0;
            started = WebServer::start(web, wake);
        }
        if (!started.ok()) return started.error();
        web_ = std::move(started.value());
        return Status::done();
    }

    Status open_first() {
        const Time now = network_.now();
        if (!options_.example.empty()) return bench_->open_example(options_.example, now);
        if (!options_.project.empty()) return bench_->open(options_.project, now);
        return Status::done();
    }

    void tell_address(const std::string& token, const fs::path& data) {
        const bool tls = !options_.tls_cert.empty();
        const std::string host =
            !options_.hosts.empty()                                   ? options_.hosts.front()
            : options_.listen == "0.0.0.0" || options_.listen == "::" ? "127.0.0.1"
            : options_.listen.find(':') != options_.listen.npos       ? "[" + options_.listen + "]"
                                                                      : options_.listen;
        const std::string address =
            fmt::format("{}://{}:{}/#token={}", tls ? "https" : "http", host, web_->port(), token);
        talk_.print("studio " + address);
        if (!tls && !is_loopback(options_.listen)) {
            talk_.log(
                "without --tls-cert everybody in this network can read what passes, the "
                "token too");
        }
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
        for (const WebEvent& event : web_->take()) desk_->hear(event, now);
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
    std::unique_ptr<WebServer> web_;
    std::unique_ptr<Desk> desk_;
    std::unique_ptr<Workbench> bench_;
    bool ended_ = false;
};

}  // namespace

Status run_studio(const StudioOptions& options, const StudioTalk& talk) {
    return Studio(options, talk).run();
}

}  // namespace vagus::serve
