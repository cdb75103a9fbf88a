// `vagus emulate`: emulated microcontrollers on the desk, each with the firmware of its board,
// joined by a switch.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "cli/emulate/board.hpp"
#include "cli/emulate/process.hpp"
#include "cli/options.hpp"
#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "net/links.hpp"
#include "serve/process.hpp"
#include "serve/workbench/door.hpp"

namespace vagus::cli {

namespace {

namespace fs = std::filesystem;

constexpr uint16_t kLastNodeId = wire::kInvalidId - 1;

struct EmulateOptions {
    std::vector<std::string> boards;
    int count = 1;
    uint16_t first_id = 1;
    std::string listen;
};

// One board after the other, numbers rising.
Result<std::vector<Emulation>> emulations_of(const EmulateOptions& options) {
    const fs::path programs = fs::path(serve::own_program()).parent_path();
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
            all.push_back(TRY(emulation_of(wish.board, static_cast<uint16_t>(id),
                                           serve::share_folder(), programs)));
        }
    }
    return all;
}

class Desk {
public:
    Status open(const EmulateOptions& options);
    // Until it is interrupted, or a board is lost.
    int run();

private:
    Status join(const Emulation& emulation);

    hub::Hub hub_;
    std::vector<EmulatorProcess> boards_;
    net::Links links_;              // behind the hub: it goes first
    std::set<net::PlaceId> lines_;  // of the boards
};

Status Desk::open(const EmulateOptions& options) {
    const auto emulations = TRY(emulations_of(options));
    TRY(links_.watch_signals());
    const net::Target target = TRY(net::parse_target(options.listen));
    const net::Listening listening = TRY(links_.listen(hub_, target));
    std::string text = "listening " + net::to_string(listening.target) + "\n";
    for (const Emulation& emulation : emulations) {
        TRY(join(emulation));
        text += "board " + emulation.name + "\n";
    }
    (void)print(text);
    return Status::done();
}

Status Desk::join(const Emulation& emulation) {
    boards_.push_back(TRY(EmulatorProcess::start(emulation)));
    lines_.insert(TRY(links_.join(hub_, boards_.back().take_line(), emulation.name)));
    return Status::done();
}

int Desk::run() {
    const OutputNeverWaits never;
    for (;;) {
        for (const net::Event& event : links_.poll(Time::max())) {
            if (event.kind == net::EventKind::Signal) return kExitDone;
            if (event.kind == net::EventKind::Failed) complain(event.what);
            if (event.kind == net::EventKind::Closed && lines_.contains(event.place)) {
                return complain(event.what + "; its emulator has ended, its last words are above");
            }
        }
    }
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
    verb.add_option("--listen", options.listen, "where hosts connect; port 0 is a free one")
        ->type_name("TARGET")
        ->capture_default_str();
}

}  // namespace

void add_emulate(CLI::App& app, int& exit_code) {
    CLI::App* verb = app.add_subcommand("emulate", "emulated microcontrollers on one bus");
    verb->footer(
        "Each board runs its firmware (docs/firmware.md) in an emulator, QEMU or simavr; a switch\n"
        "joins their serial lines. They end with this program.\n"
        "\n"
        "Example:\n"
        "  vagus emulate microbit:3 atmega1284p:2\n"
        "  vagus net tcp:127.0.0.1:33333 list");
    auto options = std::make_shared<EmulateOptions>();  // owners: the options below, the callback
    options->listen = "tcp:127.0.0.1:" + std::to_string(wire::kDefaultPort);
    add_options(*verb, *options);
    verb->callback([options, &exit_code] { exit_code = run_emulate(*options); });
}

}  // namespace vagus::cli
