// What a board of QEMU keeps over a restart, in a file: the part of its memory that its firmware
// saves to. QEMU itself forgets it when it ends, in whatever way.
//
//     MemoryKeeper keeper("microbit 3", memory, started.take_line(), started.take_monitor());
//     // The board starts with what the file has.
//     if (keeper.begin().ok()) links.join(hub, keeper.take_line(), "microbit 3");
//
// A thread passes the bytes between board and switch on. Before the last byte of "Flashing OK" goes
// on, the memory is in the file: whoever reads that the board has saved finds it saved, whatever is
// killed from then on. A file is replaced as a whole.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <thread>

#include "base/result.hpp"

namespace vagus::cli {

// Where it lies in the board, and the file that has it.
struct KeptMemory {
    uint32_t at = 0;
    uint32_t bytes = 0;
    std::string file;
};

// What the file has; empty if there is none yet. Fails if it is not of that size.
Result<std::string> kept_bytes(const KeptMemory& memory);

// Finds a word in bytes that come in pieces.
class WordFinder {
public:
    explicit WordFinder(std::string_view word) : word_(word) {}
    // How many of these bytes come before the last one of the word; all, if it does not end here.
    size_t before_the_end(std::string_view bytes);

private:
    std::string_view word_;
    std::string last_;  // of the bytes before, less than the word has
};

// The memory of a board, by the line of QEMU for debuggers (GDB Remote Serial Protocol). The board
// is paused when QEMU is started with it, and runs from the first resume() on.
class BoardMonitor {
public:
    explicit BoardMonitor(int descriptor) : descriptor_(descriptor) {}
    ~BoardMonitor();
    BoardMonitor(const BoardMonitor&) = delete;
    BoardMonitor& operator=(const BoardMonitor&) = delete;

    Status write(uint32_t at, std::string_view bytes);
    Result<std::string> read(uint32_t at, uint32_t bytes);
    Status pause();
    Status resume();

private:
    Status send(std::string_view packet);
    Result<std::string> answer();
    Result<std::string> ask(std::string_view packet);

    int descriptor_;
    std::string bytes_;
};

class MemoryKeeper {
public:
    // Takes over both descriptors: the serial line of the board, and the line for debuggers.
    MemoryKeeper(std::string name, KeptMemory memory, int board, int monitor);
    ~MemoryKeeper();
    MemoryKeeper(const MemoryKeeper&) = delete;
    MemoryKeeper& operator=(const MemoryKeeper&) = delete;

    Status begin();
    // From now on the caller's; it is closed from the other side when the board is lost, or its
    // memory cannot be kept.
    int take_line();
    // Why it was closed, to be asked afterwards: empty if the board was lost. Waits for the thread.
    const std::string& trouble();

private:
    struct Way {
        int from;
        int to;
        std::string waiting = {};  // was read, and is to be written
    };

    void pass_on(int own);
    bool move(Way& way);
    bool write(Way& way, size_t count) const;
    Status keep();

    const std::string name_;
    const KeptMemory memory_;
    BoardMonitor monitor_;
    int board_;
    int line_ = -1;
    WordFinder saved_;
    std::string trouble_;
    std::atomic<bool> ended_ = false;
    std::jthread thread_;
};

}  // namespace vagus::cli
