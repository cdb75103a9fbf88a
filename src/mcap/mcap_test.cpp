// Files that we write and read; what others read of them: tests/recordings.
#include <gtest/gtest.h>

#include "base/rng.hpp"
#include "mcap/reader.hpp"
#include "mcap/writer.hpp"

namespace vagus::mcap {
namespace {

struct Written {
    std::string bytes;
    std::vector<std::string> messages;  // "TOPIC TIME DATA"
    std::vector<size_t> flushed;        // sizes of the file at each flush …
    std::vector<size_t> until;          // … and how many messages were in it by then
};

Written write_some(bool end) {
    Written written;
    Writer writer([&](std::string_view bytes) {
        written.bytes += bytes;
        return Status::done();
    });
    const uint16_t schema =
        writer.add_schema({.name = "s", .encoding = "jsonschema", .data = "{}"});
    const uint16_t trace =
        writer.add_channel({.schema = schema, .topic = "/trace", .encoding = "json"});
    const uint16_t raw = writer.add_channel(
        {.topic = "/raw", .encoding = "", .metadata = {{"a", "1"}, {"b", "two"}}});
    writer.attach({"plan.json", "application/json", 5, "{\"plan\":1}"});
    for (uint64_t i = 0; i < 30; ++i) {
        const std::string data = std::string(i * 7 % 40, 'x') + std::to_string(i);
        writer.write(i % 3 == 0 ? raw : trace, 1000 + i, data);
        written.messages.push_back((i % 3 == 0 ? "/raw " : "/trace ") + std::to_string(1000 + i) +
                                   " " + data);
        if (i % 10 != 9) continue;
        EXPECT_TRUE(writer.flush().ok());
        written.flushed.push_back(written.bytes.size());
        written.until.push_back(written.messages.size());
    }
    if (end) {
        EXPECT_TRUE(writer.end().ok());
    }
    return written;
}

std::vector<std::string> read_all(const Reader& reader) {
    std::vector<std::string> all;
    Cursor cursor(reader);
    while (const auto message = cursor.next()) {
        const Channel* const channel = reader.channel(message->channel);
        all.push_back((channel ? channel->topic : "?") + " " + std::to_string(message->log_time) +
                      " " + std::string(message->data));
    }
    return all;
}

TEST(Mcap, WhatIsWrittenIsRead) {
    const Written written = write_some(true);
    const auto reader = Reader::open(written.bytes, "a.mcap");
    ASSERT_TRUE(reader.ok()) << reader.error().what;
    EXPECT_TRUE(reader.value().is_complete());
    EXPECT_EQ(read_all(reader.value()), written.messages);
    ASSERT_EQ(reader.value().channels().size(), 2u);
    EXPECT_EQ(reader.value().find("/raw")->metadata.at("b"), "two");
    ASSERT_EQ(reader.value().schemas().size(), 1u);
    EXPECT_EQ(reader.value().schemas()[0].name, "s");
    ASSERT_NE(reader.value().attachment("plan.json"), nullptr);
    EXPECT_EQ(reader.value().attachment("plan.json")->data, "{\"plan\":1}");
}

// Cut at each byte: all that was flushed before is there, and nothing that is made up.
TEST(Mcap, AFileCutAnywhereIsReadUpToItsLastWholeChunk) {
    const Written written = write_some(true);
    for (size_t size = kMagic.size(); size < written.bytes.size(); ++size) {
        const std::string cut = written.bytes.substr(0, size);
        const auto reader = Reader::open(cut, "cut.mcap");
        ASSERT_TRUE(reader.ok()) << size;
        EXPECT_FALSE(reader.value().is_complete()) << size;
        size_t whole = 0;
        for (size_t i = 0; i < written.flushed.size(); ++i) {
            if (written.flushed[i] <= size) whole = written.until[i];
        }
        const std::vector<std::string> all = read_all(reader.value());
        ASSERT_GE(all.size(), whole) << size;
        for (size_t i = 0; i < all.size(); ++i) ASSERT_EQ(all[i], written.messages[i]) << size;
    }
}

TEST(Mcap, ANonRecordingIsRefused) {
    for (const std::string bytes : {"", "{}", "\x89MCAP1\r\n", "\x89MCA"}) {
        const auto reader = Reader::open(bytes, "x.mcap");
        ASSERT_FALSE(reader.ok());
        EXPECT_NE(reader.error().what.find("x.mcap: is no recording"), std::string::npos);
    }
}

// One flipped bit is noticed or does not matter; nothing that was not written appears.
TEST(Mcap, DamageIsNoticed) {
    const Written written = write_some(true);
    SplitMix64 random(7);
    for (int i = 0; i < 3000; ++i) {
        std::string bytes = written.bytes;
        const size_t at = random.next() % bytes.size();
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << (random.next() % 8)));
        const auto reader = Reader::open(bytes, "damaged.mcap");
        if (!reader.ok()) continue;
        Cursor cursor(reader.value());
        while (const auto message = cursor.next()) {
            const std::string line =
                std::to_string(message->log_time) + " " + std::string(message->data);
            bool known = false;
            for (const std::string& one : written.messages) known |= one.ends_with(line);
            ASSERT_TRUE(known) << "byte " << at << " seed 7: " << line;
        }
    }
}

TEST(Mcap, AnAttachmentInAChunkIsNoAttachment) {
    std::string attachment;
    Put(attachment)
        .u64(1)
        .u64(1)
        .string("a")
        .string("text/plain")
        .u64(100)
        .bytes(std::string(100, 'x'));
    Put(attachment).u32(0);
    std::string records;
    Put(records).u8(static_cast<uint8_t>(Opcode::Attachment)).u64(attachment.size());
    records += attachment;
    std::string chunk;
    Put(chunk).u64(0).u64(0).u64(records.size()).u32(0).string("").u64(records.size());
    chunk += records;
    std::string file(kMagic);
    Put(file).u8(static_cast<uint8_t>(Opcode::Chunk)).u64(chunk.size());
    file += chunk;
    const auto reader = Reader::open(file, "a.mcap");
    ASSERT_TRUE(reader.ok());
    EXPECT_TRUE(reader.value().attachments().empty());
    EXPECT_TRUE(read_all(reader.value()).empty());
}

TEST(Mcap, AChunkLargerThanTheLimitIsNotUnpacked) {
    std::string bytes(kMagic);
    std::string content;
    Put(content).u64(0).u64(0).u64(kChunkBytesMax + 1).u32(0).string("zstd").u64(0);
    Put(bytes).u8(static_cast<uint8_t>(Opcode::Chunk)).u64(content.size()).bytes(content);
    const auto reader = Reader::open(bytes, "big.mcap");
    ASSERT_TRUE(reader.ok());
    Cursor cursor(reader.value());
    EXPECT_FALSE(cursor.next());
    ASSERT_TRUE(cursor.trouble());
    EXPECT_EQ(cursor.trouble()->what,
              "big.mcap: the chunk at byte 8 cannot be read: it says that it holds 268435457 "
              "bytes, more than 268435456; what was recorded before it can be used");
}

// As a mapped file reads from where somebody has cut it off (base/lost_pages.hpp).
TEST(Mcap, ZerosInsteadOfChunksAreNoEmptyChunks) {
    Written written = write_some(true);
    ASSERT_GE(written.flushed.size(), 2u);
    const auto reader = Reader::open(written.bytes, "cut.mcap");
    ASSERT_TRUE(reader.value().is_complete());
    const auto from = static_cast<std::ptrdiff_t>(written.flushed[0]);
    std::fill(written.bytes.begin() + from, written.bytes.end(), '\0');
    Cursor cursor(reader.value());
    size_t count = 0;
    while (cursor.next()) ++count;
    EXPECT_EQ(count, written.until[0]);
    ASSERT_TRUE(cursor.is_damaged());
    EXPECT_NE(cursor.trouble()->what.find("it says that it is empty"), std::string::npos);
}

// Its writer was killed: that is no damage, unless something follows.
TEST(Mcap, ALastChunkThatIsNotWholeIsNoDamageOfAFileWithoutAnEnd) {
    const Written written = write_some(true);
    ASSERT_GE(written.flushed.size(), 2u);
    std::string bytes = written.bytes.substr(0, written.flushed[1]);
    const auto damaged = [&bytes](size_t begin, size_t end) {
        std::string some = bytes;
        some[(begin + end) / 2] = static_cast<char>(some[(begin + end) / 2] ^ 1);
        const auto reader = Reader::open(some, "killed.mcap");
        EXPECT_FALSE(reader.value().is_complete());
        Cursor cursor(reader.value());
        while (cursor.next()) {
        }
        EXPECT_TRUE(cursor.trouble());
        return cursor.is_damaged();
    };
    EXPECT_FALSE(damaged(written.flushed[0], written.flushed[1]));
    EXPECT_TRUE(damaged(0, written.flushed[0]));
}

TEST(Mcap, AFullDiskEndsTheWriting) {
    size_t left = 200;
    Writer writer([&](std::string_view bytes) -> Status {
        if (bytes.size() > left) return Error{Code::Unavailable, "a.mcap: no space"};
        left -= bytes.size();
        return Status::done();
    });
    const uint16_t channel = writer.add_channel({.topic = "/a", .encoding = "json"});
    for (uint64_t i = 0; i < 1000; ++i) writer.write(channel, i, std::to_string(i * 7919));
    EXPECT_EQ(writer.flush().error().what, "a.mcap: no space");
    EXPECT_FALSE(writer.end().ok());
}

// Known value of the standard check string.
TEST(Mcap, Checksum) {
    EXPECT_EQ(crc32("123456789"), 0xcbf43926u);
}

}  // namespace
}  // namespace vagus::mcap
