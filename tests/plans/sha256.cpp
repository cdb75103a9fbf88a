#include "tests/plans/sha256.hpp"

#include <openssl/evp.h>

#include <array>

namespace vagus {

std::string sha256_hex(std::string_view bytes) {
    std::array<unsigned char, 32> digest;
    unsigned int size = 0;
    EVP_Digest(bytes.data(), bytes.size(), digest.data(), &size, EVP_sha256(), nullptr);
    std::string hex;
    for (const unsigned char byte : digest) {
        constexpr std::string_view kDigits = "0123456789abcdef";
        hex += kDigits[byte >> 4];
        hex += kDigits[byte & 15];
    }
    return hex;
}

}  // namespace vagus
