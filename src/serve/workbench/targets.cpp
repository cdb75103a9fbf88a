#include "serve/workbench/targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "serve/process.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

constexpr uint32_t kFirstPort = 33333;  // of Aseba's switch, and of the playground's robots
constexpr uint32_t kPorts = 10;
constexpr const char* kListens = "0A";  // state in /proc/net/tcp (proc(5))

// "usb-Mobsya_Thymio-II-if00" is "Mobsya Thymio-II".
std::string name_of_device(std::string name) {
    if (name.starts_with("usb-")) name.erase(0, 4);
    const size_t interface = name.rfind("-if");
    if (interface != name.npos) name.erase(interface);
    std::replace(name.begin(), name.end(), '_', ' ');
    return name;
}

// Ports above 0 on which something listens for this computer.
void add_listening(const std::string& file, std::set<uint32_t>& ports) {
    std::ifstream lines(file);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        std::string number, local, remote, state;
        words >> number >> local >> remote >> state;
        const size_t colon = local.rfind(':');
        uint32_t port = 0;
        if (state != kListens || colon == local.npos) continue;
        std::from_chars(local.data() + colon + 1, local.data() + local.size(), port, 16);
        ports.insert(port);
    }
}

// avahi-browse writes \DDD for what is no letter, digit or minus.
std::string unescaped(const std::string& text) {
    std::string plain;
    for (size_t i = 0; i < text.size(); ++i) {
        int code = 0;
        if (text[i] == '\\' && i + 3 < text.size() &&
            std::from_chars(&text[i + 1], &text[i + 4], code).ec == std::errc()) {
            plain += static_cast<char>(code);
            i += 3;
        } else {
            plain += text[i];
        }
    }
    return plain;
}

}  // namespace

std::vector<FoundTarget> serial_targets(const std::string& by_id, const std::string& devices) {
    std::vector<FoundTarget> found;
    std::set<std::string> named;
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(by_id, failed)) {
        const fs::path device = fs::canonical(entry.path(), failed);
        if (failed) continue;
        named.insert(device.filename().string());
        found.push_back({"ser:" + device.string(), name_of_device(entry.path().filename().string()),
                         "serial", device.string()});
    }
    for (const auto& entry : fs::directory_iterator(devices, failed)) {
        const std::string name = entry.path().filename().string();
        const bool serial = name.starts_with("ttyACM") || name.starts_with("ttyUSB");
        if (!serial || named.contains(name)) continue;
        found.push_back({"ser:" + entry.path().string(), name, "serial", entry.path().string()});
    }
    std::sort(found.begin(), found.end(),
              [](const auto& one, const auto& other) { return one.target < other.target; });
    return found;
}

std::vector<FoundTarget> local_targets(const std::string& tcp, const std::string& tcp6) {
    std::set<uint32_t> ports;
    add_listening(tcp, ports);
    add_listening(tcp6, ports);
    std::vector<FoundTarget> found;
    for (const uint32_t port : ports) {
        if (port < kFirstPort || port >= kFirstPort + kPorts) continue;
        found.push_back({fmt::format("tcp:127.0.0.1:{}", port),
                         fmt::format("This computer, port {}", port), "local",
                         "a switch, a simulator or a playground"});
    }
    return found;
}

std::vector<FoundTarget> announced_targets(const std::string& printed) {
    // =;interface;IPv4;name;type;domain;host;address;port;text
    std::vector<FoundTarget> found;
    std::set<std::string> seen;
    std::istringstream lines(printed);
    std::string line;
    while (std::getline(lines, line)) {
        std::vector<std::string> words;
        std::istringstream parts(line);
        for (std::string word; std::getline(parts, word, ';');) words.push_back(word);
        if (words.size() < 9 || words[0] != "=") continue;
        const std::string host = words[2] == "IPv6" ? "[" + words[7] + "]" : words[7];
        const std::string target = fmt::format("tcp:{}:{}", host, words[8]);
        if (!seen.insert(words[3] + words[8]).second) continue;
        found.push_back({target, unescaped(words[3]), "network", words[6]});
    }
    return found;
}

// ---- Targets ----

class Targets::Browse {
public:
    static std::unique_ptr<Browse> start() {
        auto printing = Printing::start(
            {"avahi-browse", "--parsable", "--resolve", "--terminate", "_aseba._tcp"});
        if (!printing.ok()) return nullptr;
        return std::make_unique<Browse>(std::move(printing.value()));
    }
    explicit Browse(Printing printing) : printing_(std::move(printing)) {}
    bool over() { return printing_.read(); }
    const std::string& text() const { return printing_.text(); }

private:
    Printing printing_;
};

Targets::Targets() = default;
Targets::~Targets() = default;

bool Targets::look(Time now) {
    if (now < next_) return false;
    next_ = now + kLookEvery;
    if (browse_ && browse_->over()) {
        announced_ = announced_targets(browse_->text());
        browse_.reset();
    }
    if (!browse_) browse_ = Browse::start();
    std::vector<FoundTarget> found = serial_targets();
    for (const auto& more : {local_targets(), announced_}) {
        found.insert(found.end(), more.begin(), more.end());
    }
    if (found.size() > kFoundMax) found.resize(kFoundMax);
    if (found == found_) return false;
    found_ = std::move(found);
    return true;
}

nlohmann::json Targets::document() const {
    nlohmann::json list = nlohmann::json::array();
    list.push_back({{"target", "sim"},
                    {"name", "Simulator"},
                    {"kind", "simulator"},
                    {"help", "the world of the project"}});
    for (const FoundTarget& one : found_) {
        list.push_back(
            {{"target", one.target}, {"name", one.name}, {"kind", one.kind}, {"help", one.help}});
    }
    return {{"found", std::move(list)}};
}

}  // namespace vagus::serve
