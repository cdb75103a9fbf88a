// What a file of MCAP 1 is made of (https://mcap.dev/spec), as values, and how they are written as
// bytes: all numbers little endian, a string is its length (u32) and its bytes.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <map>
#include <string>
#include <string_view>

namespace vagus::mcap {

constexpr std::string_view kMagic("\x89MCAP0\r\n", 8);

enum class Opcode : uint8_t {
    Header = 0x01,
    Footer = 0x02,
    Schema = 0x03,
    Channel = 0x04,
    Message = 0x05,
    Chunk = 0x06,
    MessageIndex = 0x07,
    ChunkIndex = 0x08,
    Attachment = 0x09,
    AttachmentIndex = 0x0a,
    Statistics = 0x0b,
    Metadata = 0x0c,
    MetadataIndex = 0x0d,
    SummaryOffset = 0x0e,
    DataEnd = 0x0f,
};

constexpr size_t kRecordHeadBytes = 9;  // opcode u8, length of what follows u64

struct Schema {
    uint16_t id = 0;
    std::string name;
    std::string encoding;
    std::string data;
};

struct Channel {
    uint16_t id = 0;
    uint16_t schema = 0;  // 0: none
    std::string topic;
    std::string encoding;
    std::map<std::string, std::string> metadata = {};
};

struct Message {
    uint16_t channel = 0;
    uint32_t sequence = 0;  // of its channel
    uint64_t log_time = 0;  // ns
    std::string_view data;
};

struct Attachment {
    std::string name;
    std::string media_type;
    uint64_t log_time = 0;  // ns
    std::string_view data;
};

// Appends numbers and strings to bytes.
class Put {
public:
    explicit Put(std::string& to) : to_(to) {}
    Put& u8(uint8_t value) { return little<1>(value); }
    Put& u16(uint16_t value) { return little<2>(value); }
    Put& u32(uint32_t value) { return little<4>(value); }
    Put& u64(uint64_t value) { return little<8>(value); }
    Put& bytes(std::string_view value) {
        to_.append(value);
        return *this;
    }
    Put& string(std::string_view value) {
        return u32(static_cast<uint32_t>(value.size())).bytes(value);
    }

private:
    template <size_t kBytes>
    Put& little(uint64_t value) {
        static_assert(std::endian::native == std::endian::little);
        std::array<char, sizeof value> bytes;
        std::memcpy(bytes.data(), &value, sizeof value);
        to_.append(bytes.data(), kBytes);
        return *this;
    }

    std::string& to_;
};

// Takes them from bytes again. What is read beyond the end is 0 or empty, and bad() from then on.
class Take {
public:
    explicit Take(std::string_view from) : from_(from) {}
    uint8_t u8() { return static_cast<uint8_t>(little(1)); }
    uint16_t u16() { return static_cast<uint16_t>(little(2)); }
    uint32_t u32() { return static_cast<uint32_t>(little(4)); }
    uint64_t u64() { return little(8); }
    std::string_view bytes(uint64_t count) {
        if (count > from_.size()) {
            bad_ = true;
            from_ = {};
            return {};
        }
        const std::string_view taken = from_.substr(0, count);
        from_.remove_prefix(count);
        return taken;
    }
    std::string_view string() { return bytes(u32()); }
    std::string_view rest() { return bytes(from_.size()); }
    size_t left() const { return from_.size(); }
    bool bad() const { return bad_; }

private:
    uint64_t little(size_t count) {
        const std::string_view taken = bytes(count);
        uint64_t value = 0;
        for (size_t i = taken.size(); i-- > 0;) {
            value = value << 8 | static_cast<uint8_t>(taken[i]);
        }
        return value;
    }

    std::string_view from_;
    bool bad_ = false;
};

// The CRC-32 of zlib, as the format asks for.
uint32_t crc32(std::string_view bytes, uint32_t before = 0);

// The content of these records, and back; the length of a record stands before it.
std::string content_of(const Schema& schema);
std::string content_of(const Channel& channel);
Schema schema_of(Take content);
Channel channel_of(Take content);

}  // namespace vagus::mcap
