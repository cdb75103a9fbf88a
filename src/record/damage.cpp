#include "record/damage.hpp"

#include <fmt/format.h>

#include "base/shell_word.hpp"

namespace vagus::record {

Status check_read(const mcap::Cursor& cursor, const mcap::Reader& reader) {
    if (!cursor.is_damaged()) return Status::done();
    return Error{Code::BadInput,
                 fmt::format("{}; write that to a file of its own, by `vagus replay {} --repair "
                             "WHOLE.mcap`",
                             cursor.trouble()->what, shell_word(reader.name()))};
}

}  // namespace vagus::record
