#include "record/damage.hpp"

#include <fmt/format.h>

#include "base/shell_word.hpp"
#include "record/topics.hpp"

namespace vagus::record {

Status check_read(const mcap::Cursor& cursor, const mcap::Reader& reader) {
    if (!cursor.is_damaged()) return Status::done();
    return Error{Code::BadInput,
                 fmt::format("{}; write that to a file of its own, by `vagus replay {} --repair "
                             "WHOLE.mcap`",
                             cursor.trouble()->what, shell_word(reader.name()))};
}

bool is_whole(const mcap::Reader& reader) {
    return reader.is_complete() && reader.find(kCutTopic) == nullptr;
}

void mark_as_cut(mcap::Writer& writer, uint64_t at) {
    const uint16_t channel =
        writer.add_channel({.topic = std::string(kCutTopic), .encoding = "json"});
    writer.write(channel, at, R"({"why":"the recording that was repaired ends here"})");
}

}  // namespace vagus::record
