// A recording that is damaged in its middle, or that somebody cuts off while it is read. Nobody may
// take what is missing then for something that did not happen.
//
//     mcap::Cursor cursor(reader);
//     while (const auto message = cursor.next()) show(*message);
//     TRY(check_read(cursor, reader));
#pragma once

#include "base/result.hpp"
#include "mcap/reader.hpp"

namespace vagus::record {

// The Error names the recording, the place, what is wrong there, and the command that writes what
// can be read of it. A file without an end that ends in a chunk that is not whole is no error.
Status check_read(const mcap::Cursor& cursor, const mcap::Reader& reader);

}  // namespace vagus::record
