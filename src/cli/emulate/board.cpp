#include "cli/emulate/board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/nearest.hpp"
#include "cli/programs.hpp"

namespace vagus::cli {

namespace {

namespace fs = std::filesystem;

enum class Emulator { Qemu, Simavr };
// How a board learns its number: QEMU puts it into the flash or the RAM of the board, the emulator
// of AVR boards takes an option.
enum class IdBy { File, Value, Option };

struct Board {
    std::string_view name;
    Emulator emulator;
    std::string_view machine;  // of QEMU
    IdBy id_by;
    std::string_view id_at;
    uint32_t kept_at;  // its two slots, or its EEPROM
    uint32_t kept_bytes;
    std::string_view kept_in;  // the ending of the file
};

// firmware/BOARD says which address: kIdOfMaker, kSlotsAt, two times kSlotBytes.
constexpr Board kBoards[] = {
    {"microbit", Emulator::Qemu, "microbit", IdBy::File, "0x3dffc", 0x3e000, 0x2000, "flash"},
    {"mps2-an385", Emulator::Qemu, "mps2-an385", IdBy::Value, "0x3ffffc", 0x300000, 0x8000,
     "flash"},
    {"atmega1284p", Emulator::Simavr, "", IdBy::Option, "", 0, 0x1000, "eeprom"},
};

constexpr const char* kQemu = "qemu-system-arm";
constexpr const char* kSimavr = "vagus-avr";

const Board* find_board(std::string_view name) {
    const auto* const found = std::ranges::find(kBoards, name, &Board::name);
    return found == std::end(kBoards) ? nullptr : found;
}

Error no_board(std::string_view name) {
    const std::vector<std::string> names = board_names();
    const std::string near =
        nearest(name, std::vector<std::string_view>(names.begin(), names.end()));
    return Error{Code::BadInput,
                 fmt::format("{}: no such board; there are {}{}", name, fmt::join(names, ", "),
                             near.empty() ? "" : ". Did you mean " + near + "?")};
}

std::vector<std::string> qemu_words(const Board& board, uint16_t id, const fs::path& image) {
    const std::string what = board.id_by == IdBy::File
                                 ? fmt::format("file=/dev/fd/{},force-raw=on", kIdDescriptor)
                                 : fmt::format("data={},data-len=4", id);
    return {kQemu,
            "-M",
            std::string(board.machine),
            "-icount",  // 2^6 ns for an instruction: time is stopped where the computer is busy
            "shift=6",
            "-kernel",
            image,
            "-display",
            "none",
            "-monitor",
            "none",
            "-serial",
            "stdio",
            "-device",
            fmt::format("loader,addr={},{}", board.id_at, what)};
}

void add_monitor(std::vector<std::string>& words) {
    const std::string channel = fmt::format("socket,id=keep,fd={}", kMonitorDescriptor);
    for (const std::string& word : {std::string("-S"), std::string("-chardev"), channel,
                                    std::string("-gdb"), std::string("chardev:keep")}) {
        words.push_back(word);
    }
}

Result<Emulation> with_simavr(Emulation emulation, const Board& board, const fs::path& image,
                              uint16_t id, const EmulationFolders& folders) {
    const fs::path program = folders.programs / kSimavr;
    if (!fs::exists(program)) {
        return Error{Code::Unavailable,
                     fmt::format("{}: there is no {}; apt-get install libsimavr-dev, then "
                                 "./dev firmware in the sources builds it",
                                 board.name, program.string())};
    }
    emulation.words = {program, image, "--id", std::to_string(id)};
    if (emulation.memory) {  // vagus-avr keeps it itself
        emulation.words.insert(emulation.words.end(), {"--eeprom", emulation.memory->file});
        emulation.memory.reset();
    }
    return emulation;
}

Result<Emulation> with_qemu(Emulation emulation, const Board& board, const fs::path& image,
                            uint16_t id) {
    if (!find_program(kQemu)) {
        return Error{Code::Unavailable,
                     fmt::format("{}: {} is not installed; apt-get install qemu-system-arm",
                                 board.name, kQemu)};
    }
    emulation.words = qemu_words(board, id, image);
    if (emulation.memory) add_monitor(emulation.words);
    if (board.id_by == IdBy::File) {
        emulation.id_bytes = {static_cast<char>(id & 0xff), static_cast<char>(id >> 8), 0, 0};
    }
    return emulation;
}

}  // namespace

std::vector<std::string> board_names() {
    std::vector<std::string> names;
    for (const Board& board : kBoards) names.emplace_back(board.name);
    return names;
}

Result<BoardWish> parse_board(std::string_view word) {
    const size_t colon = word.find(':');
    BoardWish wish{.board = std::string(word.substr(0, colon))};
    if (find_board(wish.board) == nullptr) return no_board(wish.board);
    if (colon == std::string_view::npos) return wish;
    const std::string_view count = word.substr(colon + 1);
    const auto [end, error] = std::from_chars(count.begin(), count.end(), wish.count);
    if (error != std::errc() || end != count.end() || wish.count < 1 || wish.count > kBoardsMax) {
        return Error{
            Code::BadInput,
            fmt::format("{}: expected a number from 1 to {} behind the colon, found \"{}\"", word,
                        kBoardsMax, count)};
    }
    return wish;
}

Result<Emulation> emulation_of(const std::string& name, uint16_t id,
                               const EmulationFolders& folders) {
    const Board* const board = find_board(name);
    if (board == nullptr) return no_board(name);
    const fs::path image = folders.share / "firmware" / (name + ".elf");
    if (!fs::exists(image)) {
        return Error{Code::Unavailable,
                     fmt::format("{}: there is no {}; ./dev firmware, in the sources, installs the "
                                 "cross compilers and builds it",
                                 name, image.string())};
    }
    Emulation emulation{
        .name = fmt::format("{} {}", name, id), .words = {}, .id_bytes = {}, .memory = {}};
    if (!folders.keep.empty()) {
        const fs::path file = folders.keep / fmt::format("{}-{}.{}", name, id, board->kept_in);
        emulation.memory = KeptMemory{board->kept_at, board->kept_bytes, file};
        (void)TRY(kept_bytes(*emulation.memory));
    }
    if (board->emulator == Emulator::Simavr) {
        return with_simavr(std::move(emulation), *board, image, id, folders);
    }
    return with_qemu(std::move(emulation), *board, image, id);
}

}  // namespace vagus::cli
