// The boards that can be emulated: which image runs on each, and by which program.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "cli/emulate/keep.hpp"

namespace vagus::cli {

// One word of `vagus emulate`: "microbit", "atmega1284p:2".
struct BoardWish {
    std::string board;
    int count = 0;  // 0: as --count says
};

constexpr int kBoardsMax = 32;  // of one command: each is a process that takes its share

std::vector<std::string> board_names();

Result<BoardWish> parse_board(std::string_view word);

// How one board is started. `id` goes to it as the number that its maker gave it.
struct Emulation {
    std::string name;                // "microbit 3"
    std::vector<std::string> words;  // program and arguments; its serial line is stdin and stdout
    // What the emulator reads from descriptor kIdDescriptor; empty if it takes the id in its words.
    std::string id_bytes;
    // What is kept over the end of the emulator, by a MemoryKeeper: the emulator is then started
    // paused, with its line for debuggers at descriptor kMonitorDescriptor.
    std::optional<KeptMemory> memory;
};
constexpr int kIdDescriptor = 3;
constexpr int kMonitorDescriptor = 4;

struct EmulationFolders {
    std::filesystem::path share;
    std::filesystem::path programs;
    std::filesystem::path keep;  // empty: nothing is kept
};

// Fails if the image or the emulator is not installed; says how to get it. Fails if the file with
// what the board kept is not of its size.
Result<Emulation> emulation_of(const std::string& board, uint16_t id,
                               const EmulationFolders& folders);

}  // namespace vagus::cli
