// Frames out of a line on which bytes get lost: serial lines and radio. The stream of
// docs/spec/aseba-wire-and-vm.md, section 1.1, has no mark where a frame begins, so one byte that
// is lost or doubled would shift all that follows. This reader finds the boundary again by what
// frames look like, and counts what it skips.
//
//     LineReader reader;
//     uint16_t used = reader.feed(bytes, size, now_ms);  // as much as there is room for
//     Frame frame;
//     while (reader.next(frame)) use(frame);             // after each feed() and tick()
//     reader.tick(now_ms);                               // when no more bytes wait to be read
//
// While nothing is lost a frame is given as soon as its last byte is there. A header must be that
// of a legal size and, for the types of section 2, of a size and a sender that the type can have.
// What is only possible waits for a witness, the header behind it or silence: a user event of a
// source from which no message of section 2 has come, and a type that we do not know. Where no
// frame can begin, where a frame stops halfway for kLineQuiet_ms, or takes longer than any frame
// can, the boundary is lost. It is found where two good headers follow each other, or four
// possible ones, or where frames end with the last byte before a silence.
//
// What is damaged inside of a frame cannot be seen: there is no checksum.
//
// Freestanding, no heap: the same for a host and a microcontroller (about 630 bytes).
#pragma once

#include <stdint.h>

#include "wire/frame.hpp"

namespace vagus {
namespace wire {

// A sender writes a frame in one go: so long nobody pauses within one.
constexpr uint32_t kLineQuiet_ms = 100;
// The longest frame at 115,200 baud takes 46 ms, at 19,200 272 ms.
constexpr uint32_t kFrameWithin_ms = 500;
// The longest frame, and the header behind it.
constexpr uint16_t kLineBufferMax = kFrameMax + kHeaderSize;
constexpr uint16_t kHeardBits = 512;  // of a sieve for the sources that were heard: see bit_of()

class LineReader {
public:
    // `frame_within_ms`: so long may a frame take, by the speed of the line.
    explicit LineReader(uint32_t frame_within_ms = kFrameWithin_ms);

    // Gives how many of the bytes were taken: all, unless next() was not called until it is false.
    uint16_t feed(const uint8_t* bytes, uint16_t size, uint32_t now_ms);
    // Time has passed, and every byte that has arrived was fed. Times wrap.
    void tick(uint32_t now_ms);
    // The next frame; false if there is none yet.
    bool next(Frame& frame);

    // Bytes wait for more: tick() may be the one to decide, at the latest kLineQuiet_ms from now.
    bool waits() const { return have_ > 0; }
    // The boundary is not known at the moment.
    bool lost() const { return lost_; }
    // Bytes that belonged to no frame, since the beginning.
    uint32_t skipped() const { return skipped_; }

private:
    enum class Header : uint8_t { Impossible, Doubtful, Good };
    enum class Chain : uint8_t { Broken, Open, Likely, Sure };

    Header judge(uint16_t at) const;
    Chain follow(uint16_t at) const;
    bool is_sure_behind() const;
    bool find_boundary();
    bool is_whole(Header header, uint16_t size);
    void lose();
    void skip(uint16_t count);
    void remove(uint16_t count);
    bool is_heard(uint16_t source) const;
    void hear(uint16_t source);

    uint8_t buffer_[kLineBufferMax];
    uint8_t heard_[kHeardBits / 8];
    uint16_t have_;
    bool lost_;
    bool quiet_;    // since the last byte
    bool overdue_;  // the frame in front takes too long
    uint32_t within_ms_;
    uint32_t began_ms_;  // the frame in front
    uint32_t last_ms_;   // the last byte
    uint32_t skipped_;
};

}  // namespace wire
}  // namespace vagus
