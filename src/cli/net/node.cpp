// `vagus node`: one software node on the network.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "aesl/node_file.hpp"
#include "base/file.hpp"
#include "base/folder_lock.hpp"
#include "cli/kept_file.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "net/links.hpp"
#include "session/live_node.hpp"
#include "session/standard_target.hpp"

namespace vagus::cli {

namespace {

constexpr uint16_t kLastNodeId = wire::kInvalidId - 1;
// Frames answered between two looks at the network: a flood must not keep commands waiting there.
constexpr int kFramesAtOnce = 256;

struct NodeOptions {
    uint16_t id = 1;
    std::string name;
    std::string description;
    std::string flash;
    std::string listen;
    std::string connect;
};

Result<aesl::Target> target_of(const NodeOptions& options) {
    aesl::Target target = session::standard_target("dummynode-" + std::to_string(options.id - 1));
    if (!options.description.empty()) {
        const std::string text = TRY(read_file(options.description));
        target = TRY(aesl::parse_node_file(text, options.description)).target;
    }
    if (!options.name.empty()) target.name = options.name;
    return target;
}

// A hub with two sides: the node, and what is connected.
class NodeProgram {
public:
    Status make_node(const NodeOptions& options);
    Status open_network(const NodeOptions& options);
    void run();

private:
    // True if frames still wait.
    bool answer();
    // False if it is time to end.
    bool notice(const net::Event& event);

    hub::Hub hub_;
    net::Links links_;  // behind the hub: it goes first
    hub::LinkId own_;
    std::unique_ptr<session::LiveNode> node_;
};

Status NodeProgram::make_node(const NodeOptions& options) {
    own_ = TRY(hub_.add({.name = "node", .only_node = options.id}));
    session::LiveNodeOptions live{.id = options.id, .flash = options.flash};
    live.transmit = [this](const wire::Frame& frame) { hub_.receive(own_, frame); };
    aesl::Target target = TRY(target_of(options));
    node_ = TRY(session::LiveNode::make(std::move(target), std::move(live)));
    if (!node_->flash_trouble().empty()) complain("--flash: " + node_->flash_trouble());
    return Status::done();
}

Status NodeProgram::open_network(const NodeOptions& options) {
    TRY(links_.watch_signals());
    if (!options.connect.empty()) {
        const net::Target target = TRY(net::parse_target(options.connect));
        TRY(links_.connect(hub_, target, {.retry = net::Retry::Forever}));
        return Status::done();
    }
    const net::Target target = TRY(net::parse_target(options.listen));
    const net::Listening listening =
        TRY(links_.listen(hub_, target, {.clients = net::Clients::One}));
    (void)print("listening " + net::to_string(listening.target) + "\n");
    return Status::done();
}

void NodeProgram::run() {
    const OutputNeverWaits never;
    Time next = node_->step(links_.now());
    for (;;) {
        for (const net::Event& event : links_.poll(next)) {
            if (!notice(event)) return;
        }
        const bool more = answer();
        next = node_->step(links_.now());
        if (more) next = links_.now();
    }
}

bool NodeProgram::answer() {
    wire::Frame frame;
    for (int i = 0; i < kFramesAtOnce; i++) {
        if (!hub_.take(own_, frame)) return false;
        node_->receive(frame);
    }
    return true;
}

bool NodeProgram::notice(const net::Event& event) {
    if (event.kind == net::EventKind::Closed) node_->host_left();
    const bool told = event.kind == net::EventKind::Failed || event.kind == net::EventKind::Skipped;
    if (told) complain(event.what);
    return event.kind != net::EventKind::Signal;
}

// The next program that a host saves would replace it.
Status check_flash(const std::string& flash) {
    if (!is_source_or_recording(flash)) return Status::done();
    return Error{Code::Refused,
                 fmt::format("--flash {}: expected a file that is not there yet, or that a node "
                             "has saved its program in; a program that is saved would replace "
                             "this one; name another file, as rover.abo, and load scripts with "
                             "`vagus net TARGET load`",
                             flash)};
}

int run_node(const NodeOptions& options) {
    if (const Status good = check_flash(options.flash); !good.ok()) {
        return complain(good.error(), kExitUsage);
    }
    std::optional<FolderLock> lock;  // as long as it runs: two would replace each other's programs
    if (!options.flash.empty()) {
        auto taken = FolderLock::take_file(options.flash);
        if (!taken.ok() && taken.error().code == Code::Refused) {
            return complain("--flash " + taken.error().what +
                                "; name another file, or end the node that keeps its program there",
                            kExitFailed);
        }
        if (taken.ok()) lock.emplace(std::move(taken.value()));
    }
    NodeProgram program;
    const Status made = program.make_node(options);
    if (!made.ok()) return complain(made.error(), kExitUsage);
    const Status opened = program.open_network(options);
    if (!opened.ok()) {
        const bool wrong = opened.error().code == Code::BadInput;
        return complain(opened.error(), wrong ? kExitUsage : kExitFailed);
    }
    program.run();
    return kExitDone;
}

void add_options(CLI::App& verb, NodeOptions& options) {
    CLI::Option* id = verb.add_option("--id", options.id, "its number on the bus");
    id->type_name("N")->capture_default_str();
    takes_whole_number(*id, 1, kLastNodeId);
    verb.add_option("--name", options.name, "its name (that of the node file, or dummynode-N)")
        ->type_name("NAME");
    takes_file(*verb.add_option("--describe", options.description,
                                "its variables, events and natives (node file)"),
               {".json"});
    takes_file(*verb.add_option("--flash", options.flash,
                                "keeps the program that a host saves, and runs it after a restart"),
               {".abo"});
    CLI::Option* listen =
        verb.add_option("--listen", options.listen, "waits here for a host, one at a time");
    listen->type_name("TARGET")->capture_default_str();
    verb.add_option("--connect", options.connect,
                    "connects to this switch, again when it comes back")
        ->type_name("TARGET")
        ->excludes(listen);
}

}  // namespace

void add_node(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("node", "a software node on the network");
    verb->footer(
        "Examples:\n"
        "  vagus node --id 3 --name rover --listen tcp:127.0.0.1:0\n"
        "  vagus node --describe node.json --flash rover.abo --connect tcp:127.0.0.1:33333");
    auto options = std::make_shared<NodeOptions>();  // owners: the options below, the callback
    options->listen = "tcp:127.0.0.1:" + std::to_string(wire::kDefaultPort);
    add_options(*verb, *options);
    verb->callback([options, &exit_code] { exit_code = run_node(*options); });
}

}  // namespace vagus::cli
