#include "serve/workbench/door.hpp"

#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <chrono>
#include <cstring>

#include "base/file.hpp"
#include "serve/process.hpp"
#include "serve/web/origin.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

double wall_ms() {
    return std::chrono::duration<double, std::milli>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

std::string random_token() {
    std::array<uint8_t, 16> random;
    const std::string bytes = random_bytes(random.size());
    std::memcpy(random.data(), bytes.data(), random.size());
    return token_of(random);
}

Result<std::string> token_from(const std::string& file) {
    std::error_code failed;
    if (fs::exists(file, failed)) return token_in(TRY(read_file(file)), file);
    const std::string token = random_token();
    TRY(write_secret(file, token + "\n"));
    return token;
}

// The file first: a token that no file has would be lost with the server.
Result<std::string> renewed(const Access& access, const std::string& file) {
    const std::string token = random_token();
    TRY(write_secret(file, token + "\n"));
    access.renew(token);
    return token;
}

}  // namespace

Status write_secret(const fs::path& file, const std::string& text) {
    std::error_code failed;
    if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
    const mode_t before = umask(0077);
    const Status written = write_file(file.string(), text);
    umask(before);
    return written;
}

fs::path share_folder() {
    return fs::path(own_program()).parent_path().parent_path() / "share" / "vagus";
}

Result<Door> Door::open(const DoorOptions& options, const fs::path& data,
                        std::function<void()> wake) {
    const std::string file =
        options.token_file.empty() ? (data / "token").string() : options.token_file;
    const std::string token = TRY(token_from(file));
    std::optional<std::string> look;
    if (!options.look_token_file.empty()) look = TRY(token_from(options.look_token_file));
    Door door(options, Access(token, look));
    door.token_ = token;
    door.token_file_ = file;
    TRY(door.listen(wake));
    return door;
}

Status Door::listen(const std::function<void()>& wake) {
    WebOptions web;
    web.address = options_.listen;
    web.pages = options_.pages.empty() ? (share_folder() / "pages").string() : options_.pages;
    web.hosts = options_.hosts;
    web.tls_cert = options_.tls_cert;
    web.tls_key = options_.tls_key;
    web.may_look = [access = access_](std::string_view token) {
        return access.grade(token) != Access::Grade::Refused;
    };
    web.port = static_cast<uint16_t>(options_.port < 0 ? kStudioPort : options_.port);
    auto started = WebServer::start(web, wake);
    if (!started.ok() && options_.port < 0) {
        web.port = 0;
        started = WebServer::start(web, wake);
    }
    if (!started.ok()) return started.error();
    web_ = std::move(started.value());
    return Status::done();
}

std::string Door::address() const {
    const std::string& listen = options_.listen;
    const std::string host = !options_.hosts.empty()                 ? options_.hosts.front()
                             : listen == "0.0.0.0" || listen == "::" ? "127.0.0.1"
                             : listen.find(':') != listen.npos       ? "[" + listen + "]"
                                                                     : listen;
    return fmt::format("{}://{}:{}/", options_.tls_cert.empty() ? "http" : "https", host,
                       web_->port());
}

bool Door::is_open_and_plain() const {
    return options_.tls_cert.empty() && !is_loopback(options_.listen);
}

Desk::Outside Door::outside(std::function<void(const std::string&)> log) {
    WebServer* web = web_.get();  // stays where it is when the door is moved
    return {.send =
                [web](ClientId client, bool binary, std::string bytes) {
                    binary ? web->send_binary(client, std::move(bytes))
                           : web->send(client, std::move(bytes));
                },
            .close = [web](ClientId client,
                           std::string reason) { web->close(client, std::move(reason)); },
            .log = std::move(log),
            .wall_ms = wall_ms,
            .know = [web](ClientId client) { web->know(client); },
            .renew = [access = access_, file = token_file_, address = address(),
                      tell = options_.renewed]() -> Result<std::string> {
                const std::string token = TRY(renewed(access, file));
                tell(address + "#token=" + token);
                return token;
            },
            .random = random_token};
}

}  // namespace vagus::serve
