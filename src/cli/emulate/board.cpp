#include "cli/emulate/board.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "base/nearest.hpp"

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
};

// firmware/BOARD says which address: kIdOfMaker.
constexpr Board kBoards[] = {
    {"microbit", Emulator::Qemu, "microbit", IdBy::File, "0x3dffc"},
    {"mps2-an385", Emulator::Qemu, "mps2-an385", IdBy::Value, "0x3ffffc"},
    {"atmega1284p", Emulator::Simavr, "", IdBy::Option, ""},
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

bool is_in_path(const std::string& program) {
    const char* const path = std::getenv("PATH");
    std::string_view folders = path == nullptr ? "" : path;
    while (!folders.empty()) {
        const size_t end = std::min(folders.find(':'), folders.size());
        if (access((fs::path(folders.substr(0, end)) / program).c_str(), X_OK) == 0) return true;
        folders.remove_prefix(std::min(end + 1, folders.size()));
    }
    return false;
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

Result<Emulation> emulation_of(const std::string& name, uint16_t id, const fs::path& share,
                               const fs::path& programs) {
    const Board* const board = find_board(name);
    if (board == nullptr) return no_board(name);
    const fs::path image = share / "firmware" / (name + ".elf");
    if (!fs::exists(image)) {
        return Error{Code::Unavailable,
                     fmt::format("{}: there is no {}; ./dev firmware, in the sources, installs the "
                                 "cross compilers and builds it",
                                 name, image.string())};
    }
    Emulation emulation{.name = fmt::format("{} {}", name, id), .words = {}, .id_bytes = {}};
    if (board->emulator == Emulator::Simavr) {
        const fs::path program = programs / kSimavr;
        if (!fs::exists(program)) {
            return Error{Code::Unavailable,
                         fmt::format("{}: there is no {}; apt-get install libsimavr-dev, then "
                                     "./dev firmware in the sources builds it",
                                     name, program.string())};
        }
        emulation.words = {program, image, "--id", std::to_string(id)};
        return emulation;
    }
    if (!is_in_path(kQemu)) {
        return Error{
            Code::Unavailable,
            fmt::format("{}: {} is not installed; apt-get install qemu-system-arm", name, kQemu)};
    }
    emulation.words = qemu_words(*board, id, image);
    if (board->id_by == IdBy::File) {
        emulation.id_bytes = {static_cast<char>(id & 0xff), static_cast<char>(id >> 8), 0, 0};
    }
    return emulation;
}

}  // namespace vagus::cli
