// The memory card of a robot: files `U<number>.DAT` of 16-bit words, as the natives sd.* see them
// (docs/spec, section 4.6). The files lie in a folder of the host; the open one is held in memory
// and written back as a whole when it changes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace vagus::sim {

constexpr size_t kCardFileBytesMax = 1 << 20;

class SdCard {
public:
    // "": the slot is empty, and everything fails.
    explicit SdCard(std::string folder) : folder_(std::move(folder)) {}

    bool present() const { return !folder_.empty(); }
    // Closes the open file. -1 opens no other; from 0 on opens or creates one. False if that fails.
    bool open(int16_t number);
    // At the position, which moves on. Gives the number of words written: all or none.
    int16_t write(std::span<const int16_t> words);
    // Gives the number of whole words obtained.
    int16_t read(std::span<int16_t> words);
    // To that byte. False if no file is open.
    bool seek(uint16_t position);

private:
    std::string folder_;
    std::string path_;  // of the open file, "" if there is none
    std::string content_;
    size_t position_ = 0;
};

}  // namespace vagus::sim
