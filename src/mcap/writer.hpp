// Writes a file of MCAP 1: messages in chunks compressed with zstd, an index of chunks and
// messages, statistics. Files opened by others (Foxglove, PlotJuggler, `mcap`) and by reader.hpp.
//
//     mcap::Writer writer([&file](std::string_view bytes) { return file.append(bytes); });
//     const uint16_t trace = writer.add_channel({.topic = "/plan/trace", .encoding = "json"});
//     writer.write(trace, time_ns, "{\"t\":0.5}");
//     const Status flushed = writer.flush();          // what was written so far survives a crash
//     const Status ended = writer.end();
//
// A file without its end is whole up to its last flush(). It knows no files and no clock.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/result.hpp"
#include "mcap/records.hpp"

namespace vagus::mcap {

constexpr size_t kChunkBytes = 1u << 20;  // uncompressed; then a chunk is written by itself
constexpr size_t kChannelsMax = 65535;    // an id has 16 bits
constexpr size_t kSchemasMax = 65535;

class Writer {
public:
    using Sink = std::function<Status(std::string_view bytes)>;

    // `library` is who writes, for people.
    explicit Writer(Sink sink, std::string_view library = "vagus");
    ~Writer();
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;

    // They are given their ids, from 1 on; 0 if there are as many as there can be.
    uint16_t add_schema(Schema schema);
    uint16_t add_channel(Channel channel);
    void write(uint16_t channel, uint64_t log_time, std::string_view data);
    // Not compressed; what was written before is flushed.
    void attach(const Attachment& attachment);
    // The chunk that is begun goes to the sink. The first failure of the sink since the beginning,
    // or done; after a failure nothing more is written.
    Status flush();
    // The index and the end of the file; nothing may follow.
    Status end();

    uint64_t bytes() const { return offset_; }  // written so far

private:
    class Packer;
    struct ChunkPlace {
        uint64_t from = 0;
        uint64_t to = 0;
        uint64_t offset = 0;
        uint64_t length = 0;
        std::map<uint16_t, uint64_t> indexes;
        uint64_t indexes_length = 0;
        uint64_t compressed = 0;
        uint64_t uncompressed = 0;
    };
    struct AttachmentPlace {
        uint64_t offset = 0;
        uint64_t length = 0;
        uint64_t log_time = 0;
        uint64_t size = 0;
        std::string name;
        std::string media_type;
    };
    using Index = std::vector<std::pair<uint64_t, uint64_t>>;  // time, offset in the chunk

    void put(std::string_view bytes);
    void put_record(Opcode opcode, std::string_view content);
    void write_chunk();
    void add_indexes(ChunkPlace& place);
    std::string statistics() const;
    void put_summary();

    Sink sink_;
    Status state_ = Status::done();
    uint64_t offset_ = 0;
    std::vector<Schema> schemas_;
    std::vector<Channel> channels_;
    std::vector<uint32_t> counts_;  // of messages, by channel
    std::unique_ptr<Packer> packer_;
    std::string chunk_;   // as it will be compressed
    std::string record_;  // a chunk and its indexes, as they are written
    uint64_t chunk_from_ = 0;
    uint64_t chunk_to_ = 0;
    std::map<uint16_t, Index> chunk_index_;
    std::vector<ChunkPlace> chunks_;
    std::vector<AttachmentPlace> attachments_;
    bool ended_ = false;
};

}  // namespace vagus::mcap
