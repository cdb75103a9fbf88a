// How a server is reached: its tokens, its pages and its address on this computer. The same for the
// studio on a desk and for a robot that serves itself.
//
//     Door door = TRY(Door::open(options, data, [&] { links.wake(); }));
//     Desk desk(door.access(), door.outside(log));
//     for (const WebEvent& event : door.web().take()) desk.hear(event, now);
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/result.hpp"
#include "serve/access.hpp"
#include "serve/studio/desk.hpp"
#include "serve/web/server.hpp"

namespace vagus::serve {

constexpr uint16_t kStudioPort = 8910;  // if it is free; pages find their server again there

struct DoorOptions {
    std::string listen = "127.0.0.1";  // an address of this computer
    int port = -1;                     // 0: a free one; -1: kStudioPort, or else a free one
    std::string token_file = {};       // of those who drive; made if it is not there
    std::string look_token_file = {};  // of those who only look; empty: nobody
    std::string tls_cert = {}, tls_key = {};
    std::vector<std::string> hosts = {};  // further names of this computer
    std::string pages = {};               // folder; empty: those beside the program
    // Told the address with the new token, whenever somebody has made one.
    std::function<void(const std::string& address)> renewed = [](auto&) {};
};

class Door {
public:
    // Listens. Without a token file the token is in the folder `data`. `wake` is called on another
    // thread when there is something to take.
    static Result<Door> open(const DoorOptions& options, const std::filesystem::path& data,
                             std::function<void()> wake);

    WebServer& web() { return *web_; }
    const Access& access() const { return access_; }
    const std::string& token() const { return token_; }
    const std::string& token_file() const { return token_file_; }
    // "http://127.0.0.1:8910/", as a browser of this computer or of the network opens it.
    std::string address() const;
    // What passes can be read by others in the network.
    bool is_open_and_plain() const;
    // Must not outlive the door.
    Desk::Outside outside(std::function<void(const std::string&)> log);

private:
    Door(DoorOptions options, Access access) : options_(std::move(options)), access_(access) {}
    Status listen(const std::function<void()>& wake);

    DoorOptions options_;
    Access access_;
    std::string token_, token_file_;
    std::unique_ptr<WebServer> web_;
};

constexpr const char* kPlainWords =
    "without --tls-cert everybody in this network can read what passes, the token too";

// A file that only its owner may read; folders on its way are made.
Status write_secret(const std::filesystem::path& file, const std::string& text);
// What the program reads at run time: beside it, where it is installed and where it is built.
std::filesystem::path share_folder();

}  // namespace vagus::serve
