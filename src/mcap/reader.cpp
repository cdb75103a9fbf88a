#include "mcap/reader.hpp"

#include <zstd.h>

#include <algorithm>

namespace vagus::mcap {

namespace {

struct Record {
    Opcode opcode{};
    std::string_view content;
};

// The record at the front, which is taken off; nothing if it is not whole.
std::optional<Record> take_record(std::string_view& bytes) {
    Take head(bytes);
    Record record;
    record.opcode = static_cast<Opcode>(head.u8());
    const uint64_t length = head.u64();
    record.content = head.bytes(length);
    if (head.bad()) return std::nullopt;
    bytes.remove_prefix(kRecordHeadBytes + record.content.size());
    return record;
}

Error broken_chunk(const std::string& file, uint64_t at, const std::string& why) {
    return {Code::BadInput, file + ": the chunk at byte " + std::to_string(at) +
                                " cannot be read: " + why +
                                "; what was recorded before it can be used"};
}

Result<std::string> unpack(std::string_view packed, std::string_view how, uint64_t size) {
    if (size > kChunkBytesMax) {
        return Error{Code::Limit, "it says that it holds " + std::to_string(size) +
                                      " bytes, more than " + std::to_string(kChunkBytesMax)};
    }
    if (how.empty()) {
        if (packed.size() == size) return std::string(packed);
        return Error{Code::BadInput, "its size is not what it says"};
    }
    if (how != "zstd") {
        return Error{Code::BadInput, "it is compressed with \"" + std::string(how) +
                                         "\"; expected zstd or nothing"};
    }
    std::string bytes(size, '\0');
    const size_t got = ZSTD_decompress(bytes.data(), bytes.size(), packed.data(), packed.size());
    if (ZSTD_isError(got) != 0 || got != size) {
        return Error{Code::BadInput, "its compressed bytes are damaged"};
    }
    return bytes;
}

Result<std::string> open_chunk(std::string_view content) {
    Take chunk(content);
    (void)chunk.u64();  // first and last time
    (void)chunk.u64();
    const uint64_t size = chunk.u64();
    const uint32_t crc = chunk.u32();
    const std::string_view how = chunk.string();
    const std::string_view packed = chunk.bytes(chunk.u64());
    if (chunk.bad()) return Error{Code::BadInput, "it is shorter than it says"};
    // What was cut off a file while it is read is zeros: lengths of nothing, and no checksum.
    if (size == 0 && chunk.left() > 0) {
        return Error{Code::BadInput, "it says that it is empty, and has " +
                                         std::to_string(chunk.left()) + " bytes more"};
    }
    std::string bytes = TRY(unpack(packed, how, size));
    if (crc == 0 || crc == crc32(bytes)) return bytes;
    return Error{Code::BadInput, "its checksum is wrong: expected " + std::to_string(crc) +
                                     ", found " + std::to_string(crc32(bytes))};
}

Message message_of(std::string_view content) {
    Take take(content);
    Message message;
    message.channel = take.u16();
    message.sequence = take.u32();
    message.log_time = take.u64();
    (void)take.u64();  // when it was published
    message.data = take.rest();
    return message;
}

}  // namespace

Result<Reader> Reader::open(std::string_view bytes, std::string name) {
    Reader reader(std::move(name));
    if (!bytes.starts_with(kMagic)) {
        return Error{Code::BadInput, reader.name_ +
                                         ": is no recording: expected an MCAP file, which begins "
                                         "with the bytes 89 4D 43 41 50"};
    }
    std::string_view rest = bytes.substr(kMagic.size());
    while (!rest.empty() && !reader.complete_) {
        const uint64_t at = bytes.size() - rest.size();
        const std::optional<Record> record = take_record(rest);
        if (!record) break;
        if (record->opcode == Opcode::Footer) {
            reader.complete_ = rest == kMagic;
            break;
        }
        if (record->opcode == Opcode::Chunk) {
            reader.pieces_.push_back({true, record->content, at});
        } else if (record->opcode == Opcode::Message) {
            // Nobody writes both, and outside of a chunk no checksum tells a damaged record.
            const bool chunks = !reader.pieces_.empty() && reader.pieces_.front().chunk;
            if (!chunks) reader.pieces_.push_back({false, record->content, at});
        } else if (!reader.learn(record->opcode, record->content)) {
            break;  // not what it says: there the file ends
        }
    }
    // The summary names all channels; without one they are where they were first used.
    if (!reader.complete_ || reader.channels_.empty()) reader.learn_from_chunks();
    return reader;
}

// A chunk that is damaged is told by the cursor.
void Reader::learn_from_chunks() {
    for (const Piece& piece : pieces_) {
        if (!piece.chunk) continue;
        const Result<std::string> chunk = open_chunk(piece.content);
        if (!chunk.ok()) continue;
        std::string_view rest = chunk.value();
        while (const std::optional<Record> record = take_record(rest)) {
            // The format has no attachments there; the data of one would end with these bytes.
            if (record->opcode != Opcode::Attachment) (void)learn(record->opcode, record->content);
        }
    }
}

bool Reader::learn(Opcode opcode, std::string_view content) {
    if (opcode == Opcode::Schema) {
        Schema schema = schema_of(Take(content));
        const bool known = std::any_of(schemas_.begin(), schemas_.end(),
                                       [&](const auto& each) { return each.id == schema.id; });
        if (!known && schema.id != 0) schemas_.push_back(std::move(schema));
    } else if (opcode == Opcode::Channel) {
        Channel one = channel_of(Take(content));
        if (channel(one.id) == nullptr) channels_.push_back(std::move(one));
    } else if (opcode == Opcode::Attachment) {
        Take take(content);
        Attachment attachment;
        attachment.log_time = take.u64();
        (void)take.u64();  // when the file was made
        attachment.name = take.string();
        attachment.media_type = take.string();
        attachment.data = take.bytes(take.u64());
        const uint32_t crc = take.u32();
        if (take.bad()) return false;
        if (crc != 0 && crc != crc32(content.substr(0, content.size() - sizeof crc))) return false;
        attachments_.push_back(std::move(attachment));
    }
    return true;
}

const Channel* Reader::channel(uint16_t id) const {
    const auto found = std::find_if(channels_.begin(), channels_.end(),
                                    [id](const Channel& each) { return each.id == id; });
    return found == channels_.end() ? nullptr : &*found;
}

const Channel* Reader::find(std::string_view topic) const {
    const auto found = std::find_if(channels_.begin(), channels_.end(),
                                    [topic](const Channel& each) { return each.topic == topic; });
    return found == channels_.end() ? nullptr : &*found;
}

const Attachment* Reader::attachment(std::string_view name) const {
    const auto found = std::find_if(attachments_.begin(), attachments_.end(),
                                    [name](const Attachment& each) { return each.name == name; });
    return found == attachments_.end() ? nullptr : &*found;
}

bool Cursor::open_next_piece() {
    if (trouble_ || piece_ == reader_.pieces_.size()) return false;
    const Reader::Piece& piece = reader_.pieces_[piece_++];
    if (!piece.chunk) {
        chunk_.clear();
        Put(chunk_).u8(static_cast<uint8_t>(Opcode::Message)).u64(piece.content.size());
        chunk_ += piece.content;
    } else {
        Result<std::string> chunk = open_chunk(piece.content);
        if (!chunk.ok()) {
            trouble_ = broken_chunk(reader_.name(), piece.at, chunk.error().what);
            return false;
        }
        chunk_ = std::move(chunk.value());
    }
    rest_ = chunk_;
    return true;
}

bool Cursor::is_damaged() const {
    const bool was_last = piece_ == reader_.pieces_.size();
    return trouble_.has_value() && (reader_.is_complete() || !was_last);
}

std::optional<Message> Cursor::next() {
    while (true) {
        while (const std::optional<Record> record = take_record(rest_)) {
            if (record->opcode == Opcode::Message) return message_of(record->content);
        }
        if (!open_next_piece()) return std::nullopt;
    }
}

}  // namespace vagus::mcap
