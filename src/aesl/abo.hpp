// Binary object files (`.abo`): a program for flashing without the tools, with the marks that tell
// which node it fits (docs/spec/aesl-language.md, section 5.3).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "aesl/target.hpp"
#include "base/result.hpp"

namespace vagus::aesl {

// What the file says of the node besides its name and description. A host reads product and
// firmware from the node's variables `_productId` and `_fwversion`; 0 where they are not known.
struct AboNode {
    uint16_t product_id = 0;
    uint16_t firmware_version = 0;
    uint16_t node_id = 0;
    friend bool operator==(const AboNode&, const AboNode&) = default;
};

struct Abo {
    uint16_t protocol_version = 0;
    AboNode node;
    uint16_t name_crc = 0;
    uint16_t description_crc = 0;
    std::vector<uint16_t> bytecode;
};

// CRC-16/XMODEM (polynomial 0x1021, initial 0, not reflected) over what is fed to it.
class Crc16 {
public:
    void word(uint16_t value);         // low byte first
    void name(std::string_view name);  // its UTF-8 bytes, a zero byte behind an odd number
    uint16_t value() const { return crc_; }

private:
    void byte(uint8_t value);
    uint16_t crc_ = 0;
};

uint16_t crc_of_name(std::string_view name);
uint16_t crc_of_description(const Target& target);

// The bytes of the file. At most 65535 words of bytecode.
std::string format_abo(const Target& target, const AboNode& node,
                       const std::vector<uint16_t>& bytecode);

// Refuses a file that is cut, has bytes too many, another format, or a wrong sum over its words.
Result<Abo> parse_abo(std::string_view bytes, std::string_view file);

// Whether a program from that file may be loaded on that node: name and description are the same.
Status check_abo(const Abo& abo, const Target& target, std::string_view file);

}  // namespace vagus::aesl
