// Bytes as letters (RFC 4648, 4), for messages that are text.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vagus {

std::string base64(std::string_view bytes);
// Nothing if that is no base64: a foreign letter, a length that is no multiple of four, bits that
// mean nothing.
std::optional<std::string> from_base64(std::string_view text);

}  // namespace vagus
