// A file has one writer at a time: the bytes of two would be mixed up, and both files lost.
#pragma once

#include <string>

#include "base/result.hpp"

namespace vagus {

// Of a file that was opened to be written: it is empty, and nobody else begins to write it as long
// as the descriptor is open. Refused while another one writes it. What is no regular file (a pipe,
// /dev/null) stays as it is, for everybody.
Status begin_to_write(int descriptor, const std::string& path);

}  // namespace vagus
