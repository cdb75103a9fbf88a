// `vagus emulate`: emulated microcontrollers on the desk, each with the firmware of its board,
// joined by a switch.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/folder_lock.hpp"
#include "cli/emulate/board.hpp"
#include "cli/emulate/keep.hpp"
#include "cli/emulate/process.hpp"
#include "cli/net/switch.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "net/links.hpp"
#include "serve/process.hpp"
#include "serve/workbench/door.hpp"

namespace vagus::cli {

namespace {

namespace fs = std::filesystem;

const std::string kPlaceOfBoards = "tcp:127.0.0.1:" + std::to_string(wire::kDefaultPort);
constexpr uint16_t kLastNodeId = wire::kInvalidId - 1;

struct EmulateOptions {
    std::vector<std::string> boards;
    int count = 1;
    uint16_t first_id = 1;
    std::string listen;   // empty: kPlaceOfBoards, unless `connect` is there
    std::string connect;  // a switch; empty: none
    std::string keep;     // a folder; empty: what boards save is lost with their emulators
};

// One board after the other, numbers rising.
Result<std::vector<Emulation>> emulations_of(const EmulateOptions& options) {
    const EmulationFolders folders{.share = serve::share_folder(),
                                   .programs = fs::path(serve::own_program()).parent_path(),
                                   .keep = options.keep};
    std::vector<Emulation> all;
    for (const std::string& word : options.boards) {
        const BoardWish wish = TRY(parse_board(word));
        const int count = wish.count > 0 ? wish.count : options.count;
        for (int i = 0; i < count; ++i) {
            const size_t id = options.first_id + all.size();
            if (all.size() == kBoardsMax || id > kLastNodeId) {
                return Error{
                    Code::BadInput,
                    fmt::format("{}: more than {} boards, or a number above {}; start fewer, "
                                "or give a lower --id",
                                word, kBoardsMax, kLastNodeId)};
            }
            all.push_back(TRY(emulation_of(wish.board, static_cast<uint16_t>(id), folders)));
        }
    }
    return all;
}

// No other command keeps boards in it, until the process ends in whatever way.
Result<FolderLock> take_folder(const std::string& path) {
    auto lock = FolderLock::take(path);
    if (!lock.ok() && lock.error().code == Code::Refused) {
        return Error{Code::Unavailable, "--keep " + path +
                                            ": another vagus emulate keeps its boards there; end "
                                            "it, or give another folder"};
    }
    if (!lock.ok()) return Error{Code::Unavailable, "--keep " + lock.error().what};
    if (!lock.value().holds()) {
        return Error{Code::Unavailable, "--keep " + path + ": " + std::strerror(ENOLCK)};
    }
    return lock;
}

class Desk {
public:
    Status open(const EmulateOptions& options);
    // Until it is interrupted, or a board is lost.
    int run();

private:
    // Gives what to print of it.
    Result<std::string> open_network(const EmulateOptions& options);
    Status join(const Emulation& emulation);
    // An exit code if this is the end.
    std::optional<int> notice(const net::Event& event);
    int complain_of_board(const net::Event& event);

    hub::Hub hub_;
    std::vector<EmulatorProcess> boards_;
    std::vector<std::unique_ptr<MemoryKeeper>> keepers_;  // of these
    net::Links links_;                                    // behind the hub: it goes first
    std::map<net::PlaceId, MemoryKeeper*> lines_;         // of the boards; null: none is needed
    std::optional<net::PlaceId> switch_;                  // that was connected to
    std::optional<FolderLock> folder_;
};

Status Desk::open(const EmulateOptions& options) {
    if (!options.keep.empty()) folder_.emplace(TRY(take_folder(options.keep)));
    const auto emulations = TRY(emulations_of(options));
    TRY(links_.watch_signals());
    std::string text = TRY(open_network(options));
    for (const Emulation& emulation : emulations) {
        TRY(join(emulation));
        text += "board " + emulation.name + "\n";
    }
    (void)print(text);
    return Status::done();
}

Result<std::string> Desk::open_network(const EmulateOptions& options) {
    std::string text;
    std::optional<net::Target> own;
    if (options.connect.empty() || !options.listen.empty()) {
        const std::string listen = options.listen.empty() ? kPlaceOfBoards : options.listen;
        const net::Target target = TRY(net::parse_target(listen));
        own = TRY(links_.listen(hub_, target)).target;
        text = "listening " + net::to_string(*own) + "\n";
    }
    if (options.connect.empty()) return text;
    const net::Target target = TRY(net::parse_target(options.connect));
    if (own && is_ourselves(target, *own)) {
        return Error{Code::BadInput, "--connect " + options.connect +
                                         ": these boards listen there themselves; give --listen "
                                         "another place, or leave it out"};
    }
    switch_ = TRY(links_.connect(hub_, target, {.retry = net::Retry::Forever}));
    return text;
}

Status Desk::join(const Emulation& emulation) {
    boards_.push_back(TRY(EmulatorProcess::start(emulation)));
    EmulatorProcess& board = boards_.back();
    if (!emulation.memory) {
        const auto place = TRY(links_.join(hub_, board.take_line(), emulation.name));
        lines_.emplace(place, nullptr);
        return Status::done();
    }
    keepers_.push_back(std::make_unique<MemoryKeeper>(emulation.name, *emulation.memory,
                                                      board.take_line(), board.take_monitor()));
    MemoryKeeper& keeper = *keepers_.back();
    TRY(keeper.begin());
    lines_.emplace(TRY(links_.join(hub_, keeper.take_line(), emulation.name)), &keeper);
    return Status::done();
}

int Desk::run() {
    const OutputNeverWaits never;
    for (;;) {
        for (const net::Event& event : links_.poll(Time::max())) {
            if (const auto end = notice(event)) return *end;
        }
    }
}

std::optional<int> Desk::notice(const net::Event& event) {
    const bool of_switch = switch_ == event.place;
    switch (event.kind) {
        case net::EventKind::Signal:
            return kExitDone;
        case net::EventKind::Opened:
            if (of_switch) complain(event.what + ": connected");
            break;
        case net::EventKind::Failed:
            complain(event.what + (of_switch ? "; trying again" : ""));
            break;
        case net::EventKind::Closed:
            if (lines_.contains(event.place)) return complain_of_board(event);
            if (of_switch) complain(event.what + "; trying to reach it again");
            break;
        case net::EventKind::Skipped:
        case net::EventKind::Readable:
            break;
    }
    return std::nullopt;
}

int Desk::complain_of_board(const net::Event& event) {
    MemoryKeeper* const keeper = lines_.at(event.place);
    if (keeper != nullptr && !keeper->trouble().empty()) return complain(keeper->trouble());
    return complain(event.what + "; its emulator has ended, its last words are above");
}

int run_emulate(const EmulateOptions& options) {
    Desk desk;
    const Status opened = desk.open(options);
    if (!opened.ok()) {
        const bool wrong = opened.error().code == Code::BadInput;
        return complain(opened.error(), wrong ? kExitUsage : kExitFailed);
    }
    return desk.run();
}

void add_options(CLI::App& verb, EmulateOptions& options) {
    verb.add_option("BOARD", options.boards,
                    one_of(board_names()) + "; microbit:3 is three of them")
        ->type_name("")
        ->required();
    CLI::Option* count = verb.add_option("--count", options.count, "so many of each");
    count->type_name("N")->capture_default_str();
    takes_whole_number(*count, 1, kBoardsMax);
    CLI::Option* id =
        verb.add_option("--id", options.first_id, "the first one's number on the bus");
    id->type_name("N")->capture_default_str();
    takes_whole_number(*id, 1, kLastNodeId);
    verb.add_option("--listen", options.listen,
                    "where hosts connect; " + kPlaceOfBoards +
                        " unless given, or --connect is; port 0 is a free one")
        ->type_name("TARGET");
    verb.add_option("--connect", options.connect, "joins this switch, again when it comes back")
        ->type_name("TARGET");
    verb.add_option("--keep", options.keep,
                    "what boards save is kept in this folder, and there at the next start")
        ->type_name("FOLDER");
}

}  // namespace

void add_emulate(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("emulate", "emulated microcontrollers on one bus");
    verb->footer(
        "Each board runs its firmware (docs/firmware.md) in an emulator, QEMU or simavr; a switch\n"
        "joins their serial lines. They end with this program.\n"
        "\n"
        "Example:\n"
        "  vagus emulate microbit:3 atmega1284p:2 --keep boards\n"
        "  vagus net tcp:127.0.0.1:33333 list");
    auto options = std::make_shared<EmulateOptions>();  // owners: the options below, the callback
    add_options(*verb, *options);
    verb->callback([options, &exit_code] { exit_code = run_emulate(*options); });
}

}  // namespace vagus::cli
