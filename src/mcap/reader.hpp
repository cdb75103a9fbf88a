// Reads a file of MCAP 1, whole or cut off anywhere, by Vagus or by others.
//
//     const mcap::Reader reader = TRY(mcap::Reader::open(bytes, "run.mcap"));   // bytes: borrowed
//     mcap::Cursor messages(reader);
//     while (const std::optional<mcap::Message> message = messages.next()) show(*message);
//     if (messages.trouble()) complain(*messages.trouble());
//     if (!reader.is_complete()) complain("cut off; read up to its last whole chunk");
//
// Bytes are from outside: nothing in them is taken for granted, and no size is believed beyond
// its limit.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.hpp"
#include "mcap/records.hpp"

namespace vagus::mcap {

constexpr size_t kChunkBytesMax = 256u << 20;  // uncompressed

class Reader {
public:
    // The Error says that it is no MCAP file. `name` is for sentences.
    static Result<Reader> open(std::string_view bytes, std::string name);

    const std::string& name() const { return name_; }
    // It has its end; else the writer was killed, or the file is cut off.
    bool is_complete() const { return complete_; }
    const std::vector<Schema>& schemas() const { return schemas_; }
    // In the order of the file. A channel that is only in chunks that cannot be read is not here.
    const std::vector<Channel>& channels() const { return channels_; }
    const Channel* channel(uint16_t id) const;
    const Channel* find(std::string_view topic) const;
    const std::vector<Attachment>& attachments() const { return attachments_; }
    const Attachment* attachment(std::string_view name) const;

private:
    friend class Cursor;
    // Records that hold messages, in the order of the file: a chunk, or one message outside of any.
    struct Piece {
        bool chunk = false;
        std::string_view content;
        uint64_t at = 0;  // of the record, in the file
    };

    explicit Reader(std::string name) : name_(std::move(name)) {}
    void learn_from_chunks();
    bool learn(Opcode opcode, std::string_view content);

    std::string name_;
    bool complete_ = false;
    std::vector<Schema> schemas_;
    std::vector<Channel> channels_;
    std::vector<Attachment> attachments_;
    std::vector<Piece> pieces_;
};

// Goes through the messages in the order of the file, one decompressed chunk at a time.
class Cursor {
public:
    explicit Cursor(const Reader& reader) : reader_(reader) {}
    // Nothing at the end, and where a chunk cannot be read. Valid until the next call.
    std::optional<Message> next();
    // Why it ended before the end of the file.
    const std::optional<Error>& trouble() const { return trouble_; }
    // That trouble is damage: not the last chunk of a file without an end, which its writer was
    // writing when it was killed.
    bool is_damaged() const;

private:
    bool open_next_piece();

    const Reader& reader_;
    size_t piece_ = 0;
    std::string chunk_;
    std::string_view rest_;  // of chunk_, or of a message outside
    std::optional<Error> trouble_;
};

}  // namespace vagus::mcap
