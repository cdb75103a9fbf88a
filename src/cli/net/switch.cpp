// `vagus switch`: a hub, the connections that people name, and this loop. All rules of routing
// are in hub/hub.hpp, all care for slow and broken peers in net/links.hpp.
#include "cli/net/switch.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include "base/log_lines.hpp"
#include "base/time.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "net/links.hpp"
#include "wire/reports.hpp"

namespace vagus::cli {

namespace {

using namespace std::chrono_literals;

constexpr const char* kDefaultListen = "tcp:127.0.0.1:33333";
constexpr Duration kReportEvery = 1s;  // losses of one link are told at most so often
// A pipe that poll() calls writable takes so much without blocking (POSIX: PIPE_BUF).
constexpr size_t kPipeBytes = 4096;

struct Options {
    std::vector<std::string> listen;
    std::vector<std::string> targets;
    bool verbose = false;
    bool echo = false;
};

// The switch must go on when nobody reads the frames that it prints.
bool takes_text(int descriptor) {
    pollfd asked{descriptor, POLLOUT, 0};
    return ::poll(&asked, 1, 0) == 1;
}

class Switch {
public:
    explicit Switch(const Options& options) : options_(options) {}

    int run() {
        if (const auto failed = begin()) return *failed;
        while (!ended_) {
            const Time next = links_.now() + kReportEvery;
            for (const net::Event& event : links_.poll(next)) on(event);
            for (const hub::SharedId& shared : hub_.take_shared_ids()) tell(sentence(shared));
            show_frames();
            report_losses();
        }
        report_total();
        return kExitDone;
    }

private:
    void tell(const std::string& sentence) { lines_.complain(sentence); }

    // An exit code if the switch cannot work.
    std::optional<int> begin() {
        std::vector<net::Target> listen, connect;
        for (const std::string& text : options_.listen) {
            const auto target = net::parse_target(text);
            if (!target.ok()) return complain(target.error(), kExitUsage);
            listen.push_back(target.value());
        }
        for (const std::string& text : options_.targets) {
            const auto target = net::parse_target(text);
            if (!target.ok()) return complain(target.error(), kExitUsage);
            const bool listens = target.value().use == net::Use::Listen;
            (listens ? listen : connect).push_back(target.value());
        }
        if (listen.empty()) listen.push_back(net::parse_target(kDefaultListen).value());
        const Status watched = links_.watch_signals();
        if (!watched.ok()) return complain(watched.error());
        if (options_.verbose) monitor_ = hub_.add({.name = "monitor"}).value();
        return open(listen, connect);
    }

    // The first line of the output is a promise that all of this works.
    std::optional<int> open(const std::vector<net::Target>& listen,
                            const std::vector<net::Target>& connect) {
        std::string text;
        std::vector<net::Target> listening;
        for (const net::Target& target : listen) {
            const auto place = links_.listen(hub_, target, {.echo = options_.echo});
            if (!place.ok()) return complain(place.error(), exit_code(place.error()));
            listening.push_back(place.value().target);
            text += "listening " + net::to_string(listening.back()) + "\n";
        }
        for (const net::Target& target : connect) {
            for (const net::Target& own : listening) {
                if (is_ourselves(target, own)) return complain_of_ring(target);
            }
            const auto place =
                links_.connect(hub_, target, {.retry = net::Retry::Forever, .echo = options_.echo});
            if (!place.ok()) return complain(place.error(), exit_code(place.error()));
            targets_.insert(place.value());
        }
        print(text);
        return std::nullopt;
    }

    static int complain_of_ring(const net::Target& target) {
        return complain(net::to_string(target) +
                            ": this switch listens there itself; give it another place to listen, "
                            "such as --listen tcp:127.0.0.1:0",
                        kExitUsage);
    }

    static int exit_code(const Error& error) {
        return error.code == Code::BadInput ? kExitUsage : kExitFailed;
    }

    void on(const net::Event& event) {
        const bool is_target = targets_.contains(event.place);
        switch (event.kind) {
            case net::EventKind::Opened:
                if (is_target || options_.verbose) tell(event.what + ": connected");
                break;
            case net::EventKind::Closed:
                if (is_target) tell(event.what + "; trying to reach it again");
                if (!is_target && (options_.verbose || event.expelled)) tell(event.what);
                on_last_losses(event);
                break;
            case net::EventKind::Failed:
                tell(event.what + (is_target ? "; trying again" : ""));
                break;
            case net::EventKind::Skipped:
                tell(event.what);
                break;
            case net::EventKind::Signal:
                ended_ = true;
                break;
            case net::EventKind::Readable:
                break;
        }
    }

    void on_last_losses(const net::Event& closed) {
        const hub::Dropped& dropped = closed.stats.dropped;
        closed_losses_.events += dropped.events;
        closed_losses_.messages += dropped.messages;
        if (dropped != told_[closed.link]) tell(loss_sentence(closed.what, dropped));
        told_.erase(closed.link);
    }

    void show_frames() {
        if (!monitor_) return;
        wire::Frame frame;
        std::string text;
        while (takes_text(STDOUT_FILENO)) {
            text.clear();
            while (text.size() < kPipeBytes / 2 && hub_.take(*monitor_, frame)) {
                text += frame_line(links_.now(), frame);
            }
            if (text.empty()) return;
            if (!print(text)) ended_ = true;
        }
    }

    void report_losses() {
        if (links_.now() < next_report_) return;
        next_report_ = links_.now() + kReportEvery;
        for (const hub::LinkId link : hub_.links()) {
            const hub::Dropped dropped = hub_.stats(link).dropped;
            hub::Dropped& told = told_[link];
            if (dropped == told) continue;
            told = dropped;
            tell(loss_sentence(hub_.name(link), dropped));
        }
    }

    void report_total() {
        hub::Dropped all = closed_losses_;
        for (const hub::LinkId link : hub_.links()) {
            const hub::Dropped dropped = hub_.stats(link).dropped;
            all.events += dropped.events;
            all.messages += dropped.messages;
        }
        if (all != hub::Dropped{}) tell(loss_sentence("switch", all));
    }

    const Options& options_;
    LogLines lines_;
    hub::Hub hub_;
    net::Links links_;  // after the hub: it goes first
    std::set<net::PlaceId> targets_;
    std::optional<hub::LinkId> monitor_;
    std::map<hub::LinkId, hub::Dropped> told_;
    hub::Dropped closed_losses_;  // of links that are gone
    Time next_report_{};
    bool ended_ = false;
};

}  // namespace

std::string frame_line(Time at, const wire::Frame& frame) {
    const double seconds = seconds_of(at);
    std::string line = fmt::format("{:.6f} {} ", seconds, frame.source);
    const bool event = wire::is_user_event(frame.type);
    const char* name = wire::message_name(frame.type);
    if (event) {
        line += fmt::format("event {}", frame.type);
    } else if (name != nullptr) {
        line += name;
    } else {
        line += fmt::format("message {:#06x}", frame.type);
    }
    if (frame.size > 0) line += ":";
    if (event && frame.size % 2 == 0) {
        for (uint16_t i = 0; i < wire::argument_count(frame); ++i) {
            line += fmt::format(" {}", wire::argument(frame, i));
        }
    } else {
        for (uint16_t i = 0; i < frame.size; ++i) line += fmt::format(" {:02x}", frame.payload[i]);
    }
    return line + "\n";
}

std::string loss_sentence(const std::string& link, const hub::Dropped& dropped) {
    return fmt::format("{}: too slow: {} user events and {} other messages lost so far", link,
                       dropped.events, dropped.messages);
}

bool is_ourselves(const net::Target& target, const net::Target& listening) {
    const auto* to = std::get_if<net::TcpPlace>(&target.place);
    const auto* at = std::get_if<net::TcpPlace>(&listening.place);
    if (to == nullptr || at == nullptr || to->port != at->port) return false;
    const bool to_this_machine = to->host == "localhost" || to->host == "::1" ||
                                 to->host.starts_with("127.") || to->host == "0.0.0.0";
    const bool at_loopback = at->host == "0.0.0.0" || at->host == "::" || at->host == "::1" ||
                             at->host.starts_with("127.");
    return to->host == at->host || (to_this_machine && at_loopback);
}

void add_switch(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("switch", "joins nodes and hosts into one network");
    verb->footer(
        "TARGET is tcp:HOST:PORT, ser:DEVICE[:BAUD], can:INTERFACE, or a string as Aseba's tools\n"
        "take it, with remapLocal=ID;remapTarget=ID to give a node another id. A target that is\n"
        "lost is tried again. What a slow client does not take is dropped and told on stderr.\n"
        "\n"
        "Example:\n"
        "  vagus switch ser:/dev/ttyACM0 'tcp:host=10.0.0.7;port=33333;remapLocal=5'");
    auto options = std::make_shared<Options>();  // owners: the options and the callback below
    verb->add_option("--listen", options->listen,
                     "where clients connect; tcp:127.0.0.1:33333 unless given, port 0 is a free "
                     "one. Can be given several times")
        ->type_name("TARGET")
        ->allow_extra_args(false);
    verb->add_option("TARGET", options->targets, "what to connect to")->type_name("");
    verb->add_flag("-v,--verbose", options->verbose, "print every frame");
    verb->add_flag("-l,--loop", options->echo, "give every frame back to its sender too");
    verb->callback([options, &exit_code] { exit_code = Switch(*options).run(); });
}

}  // namespace vagus::cli
