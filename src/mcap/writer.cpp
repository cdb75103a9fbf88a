#include "mcap/writer.hpp"

#include <zstd.h>

#include <algorithm>
#include <array>
#include <cstring>

namespace vagus::mcap {

namespace {

constexpr int kLevel = 1;  // of zstd: the fastest

// Of `size` bytes, which are to follow.
Put begin_record(std::string& to, Opcode opcode, size_t size) {
    return Put(to).u8(static_cast<uint8_t>(opcode)).u64(size);
}

void append_record(std::string& to, Opcode opcode, std::string_view content) {
    begin_record(to, opcode, content.size()).bytes(content);
}

// What stands before the data of a message, as one piece: a run has a thousand messages a second.
class MessageHead {
public:
    MessageHead(uint16_t channel, uint32_t sequence, uint64_t log_time, uint64_t data_bytes) {
        put(static_cast<uint8_t>(Opcode::Message));
        put(kContent + data_bytes);
        put(channel);
        put(sequence);
        put(log_time);
        put(log_time);  // published then
    }
    std::string_view bytes() const { return {bytes_.data(), bytes_.size()}; }

private:
    static constexpr uint64_t kContent = 2 + 4 + 8 + 8;
    template <class Number>
    void put(Number number) {
        std::memcpy(bytes_.data() + size_, &number, sizeof number);
        size_ += sizeof number;
    }

    std::array<char, kRecordHeadBytes + kContent> bytes_;
    size_t size_ = 0;
};

}  // namespace

// Its tables and its room are a megabyte or two: made once, for all chunks.
class Writer::Packer {
public:
    Packer() : context_(ZSTD_createCCtx(), &ZSTD_freeCCtx) {
        if (!context_) throw std::bad_alloc();
    }
    // Valid until the next.
    std::string_view packed(std::string_view bytes) {
        room_.resize(std::max(room_.size(), ZSTD_compressBound(bytes.size())));
        const size_t size = ZSTD_compressCCtx(context_.get(), room_.data(), room_.size(),
                                              bytes.data(), bytes.size(), kLevel);
        // With as much room as the bound says it fails only for want of memory.
        if (ZSTD_isError(size) != 0) throw std::bad_alloc();
        return {room_.data(), size};
    }

private:
    std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> context_;
    std::vector<char> room_;
};

Writer::Writer(Sink sink, std::string_view library) : sink_(std::move(sink)) {
    packer_ = std::make_unique<Packer>();
    put(kMagic);
    std::string header;
    Put(header).string("").string(library);
    put_record(Opcode::Header, header);
}

Writer::~Writer() = default;

void Writer::put(std::string_view bytes) {
    if (!state_.ok()) return;
    state_ = sink_(bytes);
    offset_ += bytes.size();
}

void Writer::put_record(Opcode opcode, std::string_view content) {
    std::string record;
    append_record(record, opcode, content);
    put(record);
}

uint16_t Writer::add_schema(Schema schema) {
    if (schemas_.size() >= kSchemasMax) return 0;
    schema.id = static_cast<uint16_t>(schemas_.size() + 1);
    append_record(chunk_, Opcode::Schema, content_of(schema));
    schemas_.push_back(std::move(schema));
    return schemas_.back().id;
}

uint16_t Writer::add_channel(Channel channel) {
    if (channels_.size() >= kChannelsMax) return 0;
    channel.id = static_cast<uint16_t>(channels_.size() + 1);
    append_record(chunk_, Opcode::Channel, content_of(channel));
    channels_.push_back(std::move(channel));
    counts_.push_back(0);
    return channels_.back().id;
}

void Writer::write(uint16_t channel, uint64_t log_time, std::string_view data) {
    if (!state_.ok() || channel == 0 || channel > channels_.size()) return;
    const bool first = chunk_index_.empty();
    chunk_from_ = first ? log_time : std::min(chunk_from_, log_time);
    chunk_to_ = first ? log_time : std::max(chunk_to_, log_time);
    chunk_index_[channel].emplace_back(log_time, chunk_.size());
    const MessageHead head(channel, counts_[channel - 1u]++, log_time, data.size());
    chunk_.append(head.bytes()).append(data);
    if (chunk_.size() >= kChunkBytes) write_chunk();
}

void Writer::attach(const Attachment& attachment) {
    write_chunk();
    std::string content;
    Put put(content);
    put.u64(attachment.log_time).u64(0).string(attachment.name).string(attachment.media_type);
    put.u64(attachment.data.size()).bytes(attachment.data).u32(crc32(content));
    const uint64_t offset = offset_;
    put_record(Opcode::Attachment, content);
    attachments_.push_back({offset, offset_ - offset, attachment.log_time, attachment.data.size(),
                            attachment.name, attachment.media_type});
}

void Writer::write_chunk() {
    if (chunk_.empty()) return;
    const std::string_view packed = packer_->packed(chunk_);
    ChunkPlace place;
    place.from = chunk_from_;
    place.to = chunk_to_;
    place.offset = offset_;
    place.compressed = packed.size();
    place.uncompressed = chunk_.size();
    constexpr size_t kChunkHead = 8 + 8 + 8 + 4 + (4 + 4) + 8;
    record_.clear();
    begin_record(record_, Opcode::Chunk, kChunkHead + packed.size())
        .u64(place.from)
        .u64(place.to)
        .u64(place.uncompressed)
        .u32(crc32(chunk_))
        .string("zstd")
        .u64(packed.size())
        .bytes(packed);
    place.length = record_.size();
    add_indexes(place);
    // At once: a system call for each of a hundred indexes costs more than they do.
    put(record_);
    chunks_.push_back(std::move(place));
    chunk_.clear();
    chunk_index_.clear();
    chunk_from_ = chunk_to_ = 0;
}

// Behind the chunk.
void Writer::add_indexes(ChunkPlace& place) {
    constexpr size_t kIndexHead = 2 + 4;
    constexpr size_t kEntry = 8 + 8;
    for (const auto& [channel, entries] : chunk_index_) {
        place.indexes[channel] = place.offset + record_.size();
        const size_t bytes = kEntry * entries.size();
        Put index = begin_record(record_, Opcode::MessageIndex, kIndexHead + bytes);
        index.u16(channel).u32(static_cast<uint32_t>(bytes));
        for (const auto& [time, offset] : entries) index.u64(time).u64(offset);
    }
    place.indexes_length = record_.size() - place.length;
}

Status Writer::flush() {
    write_chunk();
    return state_;
}

std::string Writer::statistics() const {
    uint64_t messages = 0;
    uint64_t from = 0;
    uint64_t to = 0;
    bool some = false;
    for (const uint32_t count : counts_) messages += count;
    for (const ChunkPlace& chunk : chunks_) {
        if (chunk.indexes.empty()) continue;
        from = some ? std::min(from, chunk.from) : chunk.from;
        to = some ? std::max(to, chunk.to) : chunk.to;
        some = true;
    }
    std::string by_channel;
    for (const Channel& channel : channels_) {
        const uint32_t count = counts_[channel.id - 1u];
        if (count > 0) Put(by_channel).u16(channel.id).u64(count);
    }
    std::string content;
    Put put(content);
    put.u64(messages).u16(static_cast<uint16_t>(schemas_.size()));
    put.u32(static_cast<uint32_t>(channels_.size()));
    put.u32(static_cast<uint32_t>(attachments_.size())).u32(0);
    put.u32(static_cast<uint32_t>(chunks_.size())).u64(from).u64(to).string(by_channel);
    return content;
}

void Writer::put_summary() {
    std::string summary;
    std::string offsets;
    const uint64_t begin = offset_;
    const auto group = [&](Opcode opcode, const std::vector<std::string>& contents) {
        const uint64_t from = begin + summary.size();
        for (const std::string& content : contents) append_record(summary, opcode, content);
        if (contents.empty()) return;
        std::string content;
        Put put(content);
        put.u8(static_cast<uint8_t>(opcode)).u64(from).u64(begin + summary.size() - from);
        append_record(offsets, Opcode::SummaryOffset, content);
    };
    std::vector<std::string> contents;
    for (const Schema& schema : schemas_) contents.push_back(content_of(schema));
    group(Opcode::Schema, contents);
    contents.clear();
    for (const Channel& channel : channels_) contents.push_back(content_of(channel));
    group(Opcode::Channel, contents);
    group(Opcode::Statistics, {statistics()});
    contents.clear();
    for (const ChunkPlace& chunk : chunks_) {
        std::string indexes;
        for (const auto& [channel, offset] : chunk.indexes) Put(indexes).u16(channel).u64(offset);
        std::string content;
        Put put(content);
        put.u64(chunk.from).u64(chunk.to).u64(chunk.offset).u64(chunk.length).string(indexes);
        put.u64(chunk.indexes_length).string("zstd").u64(chunk.compressed).u64(chunk.uncompressed);
        contents.push_back(std::move(content));
    }
    group(Opcode::ChunkIndex, contents);
    contents.clear();
    for (const AttachmentPlace& one : attachments_) {
        std::string content;
        Put put(content);
        put.u64(one.offset).u64(one.length).u64(one.log_time).u64(0).u64(one.size);
        put.string(one.name).string(one.media_type);
        contents.push_back(std::move(content));
    }
    group(Opcode::AttachmentIndex, contents);
    const uint64_t offsets_begin = begin + summary.size();
    summary += offsets;
    // The footer's checksum is of the summary and of the footer up to it.
    Put put(summary);
    put.u8(static_cast<uint8_t>(Opcode::Footer)).u64(20).u64(begin).u64(offsets_begin);
    put.u32(crc32(summary));
    this->put(summary);
}

Status Writer::end() {
    if (std::exchange(ended_, true)) return state_;
    write_chunk();
    std::string content;
    Put(content).u32(0);  // no checksum of the data: each chunk has one
    put_record(Opcode::DataEnd, content);
    put_summary();
    put(kMagic);
    return state_;
}

}  // namespace vagus::mcap
