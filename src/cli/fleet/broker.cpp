#include "cli/fleet/broker.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>

#include "base/file.hpp"
#include "base/shell_word.hpp"
#include "base/text.hpp"
#include "cli/fleet/process.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "fleet/limits.hpp"
#include "fleet/operator.hpp"
#include "fleet/robot_names.hpp"
#include "fleet/target.hpp"
#include "fleet/topic.hpp"
#include "keeper/keeper.hpp"
#include "net/end_signal.hpp"
#include "serve/process.hpp"

namespace vagus::cli {
namespace {

namespace fs = std::filesystem;

using Clock = std::chrono::steady_clock;

constexpr int kLookEveryMs = 200;                            // whether children go on
constexpr auto kKeeperAgainAfter = std::chrono::seconds(1);  // one that cannot run is no flood
constexpr size_t kPasswordBytes = 16;
constexpr int kCertificateDays = 3650;
constexpr uint16_t kPort = 8883;
constexpr uint16_t kWebPort = 8884;
constexpr size_t kHostBytesMax = 253;  // of a name in DNS
constexpr const char* kHostBytes =
    "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789.-_:";
constexpr std::string_view kNamesKey = "subjectAltName=";  // in broker.ext
constexpr const char* kNamesOfItself = "DNS:localhost,IP:127.0.0.1,IP:::1";
// For one client: what is retained of the most robots, three messages of each; the records that a
// keeper finds are fewer.
constexpr size_t kQueuedMax = 3 * fleet::kRobotsMax;
static_assert(kQueuedMax > keeper::kTasksMax + keeper::kKeysMax);
constexpr size_t kQueuedBytesMax = size_t{128} << 20;
constexpr mode_t kForOwner = 0600;
constexpr mode_t kFolderForOwner = 0700;
constexpr const char* kUsers[] = {"operator", "looker", "keeper"};

// Rights, as docs/fleet.md explains them. %u is the user: a robot's own name. Who may read `want`
// is not everybody, so what everybody may read is a list.
constexpr const char* kAccess = R"(# Made by `vagus fleet init`; read by mosquitto when it starts.
# A robot writes below robot/ITS NAME/ alone.
pattern readwrite vagus/1/+/robot/%u/#
pattern read vagus/1/+/robot/+/connection
pattern read vagus/1/+/robot/+/description
pattern read vagus/1/+/robot/+/state
pattern read vagus/1/+/robot/+/version
pattern read vagus/1/+/robot/+/var/#
pattern read vagus/1/+/robot/+/event/+
pattern read vagus/1/+/robot/+/ask/#
pattern read vagus/1/+/robot/+/answer/#
pattern read vagus/1/+/cmd/#
pattern read vagus/1/+/shared/#
pattern read vagus/1/+/task/#
pattern read vagus/1/+/keeper/#

user operator
topic readwrite vagus/1/+/cmd/#
topic readwrite vagus/1/+/robot/+/want

user looker
topic write vagus/1/+/cmd/+/stop
topic write vagus/1/+/cmd/group/+/stop

user keeper
topic readwrite vagus/1/+/shared/#
topic readwrite vagus/1/+/task/#
topic readwrite vagus/1/+/keeper/#
)";

std::string user_of_this_process() {
    const passwd* user = getpwuid(geteuid());
    return user == nullptr ? "mosquitto" : user->pw_name;
}

// "listener 8883" of a configuration that a person may have changed.
std::vector<std::string> ports_in(const std::string& configuration) {
    std::vector<std::string> ports;
    for (std::string_view line : split(configuration, '\n')) {
        constexpr std::string_view kListener = "listener ";
        if (!line.starts_with(kListener)) continue;
        line.remove_prefix(kListener.size());
        ports.emplace_back(line.substr(0, line.find(' ')));
    }
    return ports;
}

class Maker {
public:
    explicit Maker(const BrokerOptions& options)
        : options_(options), folder_(fs::absolute(options.folder).lexically_normal()) {}

    // What the person should know about it; empty: nothing.
    Result<std::string> make() {
        TRY(check_ports());
        std::error_code failed;
        fs::create_directories(folder_ / "data", failed);
        if (failed) {
            return Error{Code::Unavailable,
                         fmt::format("{}: cannot be made: {}", options_.folder, failed.message())};
        }
        chmod(folder_.c_str(), kFolderForOwner);
        TRY(make_authority());
        const bool is_new = TRY(make_certificate());
        TRY(write("access", kAccess));
        TRY(write("mosquitto.conf", configuration()));
        TRY(make_users());
        if (!is_new) return std::string();
        const std::string names = TRY(certified_names());
        return fmt::format(
            "{}: broker.crt is new, for the names {}; start `vagus fleet serve` "
            "again.\n",
            options_.folder, names);
    }

private:
    std::string path(const std::string& name) const { return (folder_ / name).string(); }
    bool has(const std::string& name) const {
        std::error_code failed;
        return fs::exists(folder_ / name, failed);
    }

    // For its owner alone, from its first byte on; what is there stays.
    Status write(const std::string& name, const std::string& content) {
        if (has(name)) return Status::done();
        const mode_t before = umask(~kForOwner & 0777);
        const Status written = write_file(path(name), content);
        umask(before);
        return written;
    }

    // Robots trust ca.crt: what is there of the authority stays, and what is lost of it is made by
    // the rest where that is possible.
    Status make_authority() {
        if (has("ca.crt")) return Status::done();
        if (has("ca.key")) return sign_authority({"-key", path("ca.key")});
        if (has("broker.crt")) {
            return Error{Code::Refused,
                         fmt::format("{0}: ca.crt and ca.key are lost, and broker.crt is signed by "
                                     "them; put them back, or delete broker.crt for another "
                                     "authority, whose ca.crt every robot and observer needs",
                                     options_.folder)};
        }
        return sign_authority({"-newkey", "ec", "-pkeyopt", "ec_paramgen_curve:prime256v1",
                               "-nodes", "-keyout", path("ca.key")});
    }

    Status sign_authority(const std::vector<std::string>& key) {
        std::vector<std::string> words = {"req", "-x509"};
        words.insert(words.end(), key.begin(), key.end());
        words.insert(words.end(),
                     {"-out", path("ca.crt"), "-days", std::to_string(kCertificateDays), "-subj",
                      "/CN=Authority of a fleet of Vagus", "-addext",
                      "keyUsage=critical,keyCertSign,cRLSign"});
        return openssl(words);
    }

    // The configuration stays as it is, so a port that it does not have would be for nothing.
    Status check_ports() const {
        if (!has("mosquitto.conf")) return Status::done();
        const std::string configured = TRY(read_file(path("mosquitto.conf")));
        const std::vector<std::string> ports = ports_in(configured);
        const std::pair<const char*, std::optional<uint16_t>> asked[] = {
            {"--port", options_.port}, {"--web-port", options_.web_port}};
        for (const auto& [option, port] : asked) {
            if (!port || std::ranges::count(ports, std::to_string(*port)) > 0) continue;
            return Error{Code::BadInput,
                         fmt::format("{} {}: the broker of {} has the ports {}; change its "
                                     "mosquitto.conf, or make another folder",
                                     option, *port, options_.folder, fmt::join(ports, ", "))};
        }
        return Status::done();
    }

    // One that is there stays, unless it lacks a name that is asked for: then true, and it is
    // another one with all of them.
    Result<bool> make_certificate() {
        const bool is_there = has("broker.crt") && has("broker.key");
        if (!is_there) {
            TRY(openssl({"genpkey", "-algorithm", "EC", "-pkeyopt", "ec_paramgen_curve:P-256",
                         "-out", path("broker.key")}));
            std::vector<std::string> hosts = options_.hosts;
            hosts.push_back(serve::host_name());
            const bool was_there = has("broker.ext");  // one that was lost had these names
            const std::string names = was_there ? TRY(certified_names()) : kNamesOfItself;
            TRY(certify(alternative_names(names, hosts)));
            return was_there;
        }
        if (options_.hosts.empty()) return false;
        const std::string before = has("broker.ext") ? TRY(certified_names()) : "";
        const std::string names = alternative_names(before, options_.hosts);
        if (names == before) return false;
        if (before.empty() || !is_signed_here()) {
            return Error{Code::Refused,
                         fmt::format("--host {}: {}/broker.crt was not made by `vagus fleet init`, "
                                     "and is kept; whoever signed it can add the name",
                                     options_.hosts.back(), options_.folder)};
        }
        TRY(certify(names));
        return true;
    }

    bool is_signed_here() const {
        return run_to_end({"openssl", "verify", "-no_check_time", "-CAfile", path("ca.crt"),
                           path("broker.crt")})
            .ok();
    }

    Result<std::string> certified_names() const {
        std::string names = TRY(read_file(path("broker.ext")));
        if (names.starts_with(kNamesKey)) names.erase(0, kNamesKey.size());
        names.erase(names.find_last_not_of(" \n") + 1);
        return names;
    }

    // The certificate that is there is replaced as a whole, once there is another one.
    Status certify(const std::string& names) {
        if (!has("ca.key")) {
            return Error{Code::Refused,
                         fmt::format("{}: ca.key is lost, and nothing else can sign a certificate "
                                     "that robots trust; put it back, or delete ca.crt and "
                                     "broker.crt for another authority, whose ca.crt every robot "
                                     "and observer needs",
                                     options_.folder)};
        }
        TRY(openssl({"req", "-new", "-key", path("broker.key"), "-out", path("broker.csr"), "-subj",
                     "/CN=Broker of a fleet of Vagus"}));
        TRY(write_file(path("broker.ext.new"), fmt::format("{}{}\n", kNamesKey, names)));
        TRY(openssl({"x509", "-req", "-in", path("broker.csr"), "-CA", path("ca.crt"), "-CAkey",
                     path("ca.key"), "-CAcreateserial", "-days", std::to_string(kCertificateDays),
                     "-extfile", path("broker.ext.new"), "-out", path("broker.crt.new")}));
        std::error_code failed;
        fs::rename(path("broker.crt.new"), path("broker.crt"), failed);
        if (!failed) fs::rename(path("broker.ext.new"), path("broker.ext"), failed);
        if (!failed) return Status::done();
        return Error{Code::Unavailable, fmt::format("{}: cannot be written: {}", path("broker.crt"),
                                                    failed.message())};
    }

    // `names`, and those of `hosts` that it lacks.
    static std::string alternative_names(std::string names, std::vector<std::string> hosts) {
        for (const std::string& host : hosts) {
            if (host.empty()) continue;
            const bool address =
                host.find_first_not_of("0123456789.") == host.npos || host.find(':') != host.npos;
            const std::string name = fmt::format("{}:{}", address ? "IP" : "DNS", host);
            const auto known = split(names, ',');
            if (std::ranges::count(known, name) == 0) names += "," + name;
        }
        return names;
    }

    Status openssl(std::vector<std::string> words) {
        words.insert(words.begin(), "openssl");
        const mode_t before = umask(~kForOwner & 0777);
        const Status done = run_to_end(words);
        umask(before);
        return done;
    }

    std::string configuration() const {
        const auto listener = [this](uint16_t port, const char* protocol) {
            return fmt::format(
                "\nlistener {}\nprotocol {}\ncafile {}\ncertfile {}\nkeyfile {}\n"
                "tls_version tlsv1.2\n",
                port, protocol, path("ca.crt"), path("broker.crt"), path("broker.key"));
        };
        return fmt::format(
                   "# Made by `vagus fleet init`; yours to change. mosquitto.conf(5)\n"
                   "user {}\nallow_anonymous false\npassword_file {}\nacl_file {}\n"
                   "persistence true\npersistence_location {}/\nautosave_interval 60\n"
                   "max_packet_size {}\nmax_queued_messages {}\nmax_queued_bytes "
                   "{}\nset_tcp_nodelay true\n"
                   "log_dest stderr\nlog_type error\nlog_type notice\n"
                   "log_timestamp_format %Y-%m-%dT%H:%M:%S\n"
                   "connection_messages false\n",
                   user_of_this_process(), path("passwords"), path("access"), path("data"),
                   fleet::kPayloadBytesMax + 2 * fleet::kTopicBytesMax, kQueuedMax,
                   kQueuedBytesMax) +
               listener(options_.port.value_or(kPort), "mqtt") +
               listener(options_.web_port.value_or(kWebPort), "websockets");
    }

    // Each user has a file NAME.login with the user and a password; the broker's own file has only
    // what cannot be turned back. A user that it lacks gets its line, also where an earlier `init`
    // ended before it came to that.
    Status make_users() {
        std::string fresh;
        std::vector<std::string> users(std::begin(kUsers), std::end(kUsers));
        for (const std::string& robot : options_.robots) users.push_back(fleet::escape(robot));
        std::string before = has("passwords") ? TRY(read_file(path("passwords"))) : "";
        for (const std::string& user : users) {
            const bool has_login = has(user + ".login");
            if (has_login && knows(before, user)) continue;
            if (!has_login) {
                const std::string password = hex_of(serve::random_bytes(kPasswordBytes));
                TRY(write(user + ".login", user + "\n" + password + "\n"));
            }
            const std::string file = path(user + ".login");
            const std::string lines = TRY(read_file(file));
            const fleet::Login login = TRY(fleet::read_login(lines, file));
            before = without(before, user);
            fresh += login.user + ":" + login.password + "\n";
        }
        if (fresh.empty()) return Status::done();
        std::error_code failed;
        fs::remove(path("passwords.new"), failed);
        TRY(write("passwords.new", fresh));
        const Status hashed = run_to_end({"mosquitto_passwd", "-U", path("passwords.new")});
        if (hashed.ok()) {
            const std::string lines = TRY(read_file(path("passwords.new")));
            fs::remove(path("passwords"), failed);
            TRY(write("passwords", before + lines));
        }
        fs::remove(path("passwords.new"), failed);
        return hashed;
    }

    static bool knows(const std::string& passwords, const std::string& user) {
        return ("\n" + passwords).find("\n" + user + ":") != std::string::npos;
    }
    // The lines of all others.
    static std::string without(const std::string& passwords, const std::string& user) {
        std::string others;
        for (const std::string_view line : split(passwords, '\n')) {
            if (!line.empty() && !line.starts_with(user + ":")) others += fmt::format("{}\n", line);
        }
        return others;
    }

    const BrokerOptions& options_;
    const fs::path folder_;
};

Status check(const BrokerOptions& options) {
    if (options.robots.size() > kFleetUsersMax) {
        return Error{Code::Limit, fmt::format("--robot: {} at a time at most, found {}",
                                              kFleetUsersMax, options.robots.size())};
    }
    for (const std::string& host : options.hosts) {
        if (!host.empty() && host.size() <= kHostBytesMax &&
            host.find_first_not_of(kHostBytes) == std::string::npos) {
            continue;
        }
        return Error{Code::BadInput,
                     fmt::format("--host \"{}\": expected the name of a computer, or an address, "
                                 "as broker.local or 192.168.1.7",
                                 visible(host))};
    }
    for (const std::string& robot : options.robots) {
        if (robot.find("..") != std::string::npos) {
            return Error{Code::BadInput, "--robot " + fleet::no_range(robot)};
        }
        const bool taken =
            std::find(std::begin(kUsers), std::end(kUsers), robot) != std::end(kUsers);
        if (fleet::is_robot_name(robot) && !taken) continue;
        return Error{Code::BadInput,
                     fmt::format("\"{}\" cannot be the name of a robot: expected 1 to {} bytes, "
                                 "and none of all, group, operator, looker, keeper",
                                 visible(robot), fleet::kNameBytesMax)};
    }
    return Status::done();
}

int init(const BrokerOptions& options) {
    const auto made = make_broker(options);
    if (!made.ok()) {
        return complain(made.error(),
                        made.error().code == Code::BadInput ? kExitUsage : kExitFailed);
    }
    print(made.value() +
          fmt::format("{0}: ca.crt is for everybody, NAME.login for the one of that name.\n"
                      "Next: vagus fleet serve {1}\n",
                      options.folder, shell_word(options.folder)));
    return kExitDone;
}

// `vagus fleet TARGET keep` for one fleet of this broker, in a process of its own, so that a
// fault in it affects nothing else.
class KeeperChild {
public:
    KeeperChild(const std::string& folder, const std::string& port, const std::string& fleet)
        : fleet_(fleet),
          words_({serve::kThisProgram, "fleet",
                  fmt::format("mqtts://localhost:{}/{}", port, fleet::escape(fleet)), "keep",
                  "--tls-ca", (fs::absolute(folder) / "ca.crt").string(), "--login",
                  (fs::absolute(folder) / "keeper.login").string()}) {}

    // Starts it where it does not run.
    void look() {
        if (child_) {
            const auto ended = child_->ended();
            if (!ended) return;
            child_.reset();
            again_at_ = Clock::now() + kKeeperAgainAfter;
            say(fmt::format("the keeper of {} {}, and is started again\n", fleet_, *ended));
        }
        if (Clock::now() < again_at_) return;
        auto started = Companion::start(words_);
        if (started.ok()) child_.emplace(std::move(started.value()));
    }
    void end() {
        if (child_) child_->end();
    }

private:
    std::string fleet_;
    std::vector<std::string> words_;
    std::optional<Companion> child_;
    Clock::time_point again_at_{};
};

// Until an end is asked for, or mosquitto has ended: how.
std::optional<std::string> run_until_end(Companion& broker, std::vector<KeeperChild>& keepers) {
    while (!net::end_asked()) {
        if (const auto end = broker.ended()) return end;
        for (KeeperChild& keeper : keepers) keeper.look();
        pollfd wait{net::end_descriptor(), POLLIN, 0};
        poll(&wait, 1, kLookEveryMs);
    }
    return std::nullopt;
}

Status check_fleets(const std::vector<std::string>& fleets) {
    if (fleets.size() > kKeptFleetsMax) {
        return Error{Code::Limit,
                     fmt::format("--fleet: {} at most, found {}", kKeptFleetsMax, fleets.size())};
    }
    for (const std::string& fleet : fleets) {
        if (fleet::is_name(fleet)) continue;
        return Error{Code::BadInput,
                     fmt::format("\"{}\" cannot be the name of a fleet: expected 1 to {} bytes",
                                 visible(fleet), fleet::kNameBytesMax)};
    }
    return Status::done();
}

}  // namespace

Result<std::string> make_broker(const BrokerOptions& options) {
    TRY(check(options));
    return Maker(options).make();
}

int serve_broker(const std::string& folder, const std::vector<std::string>& fleets) {
    const std::string file = (fs::absolute(folder) / "mosquitto.conf").string();
    const auto configuration = read_file(file);
    if (!configuration.ok()) {
        return complain(configuration.error().what + "; make one with `vagus fleet init " +
                            shell_word(folder) + "`",
                        kExitUsage);
    }
    if (const Status good = check_fleets(fleets); !good.ok()) {
        return complain(good.error(), kExitUsage);
    }
    net::watch_for_end();
    auto broker = Companion::start({"mosquitto", "-c", file});
    if (!broker.ok()) return complain(broker.error());
    const std::vector<std::string> ports = ports_in(configuration.value());
    const std::string port = ports.empty() ? "1883" : ports.front();
    print("fleet mqtts://localhost:" + port + "\n");
    std::vector<KeeperChild> keepers;
    for (const std::string& fleet : fleets) keepers.emplace_back(folder, port, fleet);
    const auto end = run_until_end(broker.value(), keepers);
    // They say good-bye before the broker goes.
    for (KeeperChild& keeper : keepers) keeper.end();
    broker.value().end();
    if (!end) return kExitDone;
    return complain("mosquitto " + *end + "; its last words are above");
}

void add_broker_verbs(CLI::App& fleet, int& exit_code) {
    const auto options = std::make_shared<BrokerOptions>();  // owners: CLI11 and the callbacks
    CLI::App* verb = fleet.add_subcommand("init", "makes what a broker of one's own needs");
    verb->add_option("FOLDER", options->folder, "made if it is not there")->required();
    verb->add_option("--port", options->port, "of the broker (default: 8883)")
        ->check(CLI::Range(1, UINT16_MAX));
    verb->add_option("--web-port", options->web_port, "the same, by WebSockets (default: 8884)")
        ->check(CLI::Range(1, UINT16_MAX));
    verb->add_option("--host", options->hosts, "a further name or address of this computer")
        ->type_name("NAME")
        ->allow_extra_args(false);
    verb->add_option("--robot", options->robots,
                     "a robot that gets a login; t1..t30: thirty of them")
        ->type_name("NAME")
        ->allow_extra_args(false);
    verb->footer(
        "Configuration, rights, a small authority with the certificate of the broker, and a login "
        "each for\n"
        "the operator (may command robots), the looker (may watch and stop them), the keeper and "
        "every\n"
        "robot. What is already there is kept: run init again to add another --robot or --host.\n"
        "Example:\n  vagus fleet init broker --host broker.local --robot r1 --robot r2");
    verb->callback([options, &exit_code] {
        for (const std::string& word : std::exchange(options->robots, {})) {
            for (std::string& name : fleet::names_in(word)) {
                options->robots.push_back(std::move(name));
            }
        }
        exit_code = init(*options);
    });

    const auto fleets = std::make_shared<std::vector<std::string>>(1, "lab");
    verb = fleet.add_subcommand("serve", "runs mosquitto with what `init` made, and keepers");
    verb->add_option("FOLDER", options->folder, "of `vagus fleet init`")->required();
    verb->add_option("--fleet", *fleets,
                     "a fleet that gets a keeper of its tasks and shared values (default: lab)")
        ->type_name("NAME")
        ->allow_extra_args(false);
    verb->footer(
        "Needs Debian's package mosquitto, whose own service need not run. Ends with Ctrl-C; "
        "mosquitto and\nthe keepers end with it; a keeper that dies is started again.\n"
        "Example:\n  vagus fleet serve broker --fleet lab");
    verb->callback(
        [options, fleets, &exit_code] { exit_code = serve_broker(options->folder, *fleets); });
}

}  // namespace vagus::cli
