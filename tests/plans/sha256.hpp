// SHA-256 (FIPS 180-4) for comparing long traces with their digests; for tests only.
#pragma once

#include <string>
#include <string_view>

namespace vagus {

std::string sha256_hex(std::string_view bytes);

}  // namespace vagus
