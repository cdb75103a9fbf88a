// A recording that was cut off, is damaged in its middle, or is cut off by somebody while it is
// read. Nobody may take what is missing then for something that did not happen.
//
//     mcap::Cursor cursor(reader);
//     while (const auto message = cursor.next()) show(*message);
//     TRY(check_read(cursor, reader));
#pragma once

#include "base/result.hpp"
#include "mcap/reader.hpp"
#include "mcap/writer.hpp"

namespace vagus::record {

// The Error names the recording, the place, what is wrong there, and the command that writes what
// can be read of it. A file without an end that ends in a chunk that is not whole is no error.
Status check_read(const mcap::Cursor& cursor, const mcap::Reader& reader);

// What is said of a recording that is not is_whole().
constexpr std::string_view kHasNoEnd =
    "has no end (the run was killed, or the file is cut off); it is compared up to its last whole "
    "chunk";

// Whether all is in it up to the end of what was recorded. One that was repaired is a file with an
// end, but a recording without: mark_as_cut() has said so.
bool is_whole(const mcap::Reader& reader);
// In a file that has what could be read of another one, up to `at`, in ns.
void mark_as_cut(mcap::Writer& writer, uint64_t at);

}  // namespace vagus::record
