// Binary object files: see abo.hpp. All numbers are 16 bits, low byte first.
#include "aesl/abo.hpp"

#include <fmt/format.h>

#include <cassert>

namespace vagus::aesl {
namespace {

constexpr std::string_view kMagic("ABO\0", 4);
constexpr uint16_t kFormatVersion = 0;
constexpr size_t kHeaderWords = 8;  // format version to number of words
constexpr size_t kHeaderBytes = kMagic.size() + 2 * kHeaderWords;
constexpr size_t kSumBytes = 2;

void put(std::string& bytes, uint16_t word) {
    bytes += static_cast<char>(word & 0xffu);
    bytes += static_cast<char>(word >> 8);
}

uint16_t word_at(std::string_view bytes, size_t offset) {
    const auto low = static_cast<uint8_t>(bytes[offset]);
    const auto high = static_cast<uint8_t>(bytes[offset + 1]);
    return static_cast<uint16_t>(low | (high << 8));
}

uint16_t crc_of_words(const std::vector<uint16_t>& words) {
    Crc16 crc;
    for (const uint16_t word : words) crc.word(word);
    return crc.value();
}

Error refused(std::string_view file, std::string_view why) {
    return {Code::BadInput, fmt::format("{}: {}", file, why)};
}

}  // namespace

void Crc16::byte(uint8_t value) {
    crc_ = static_cast<uint16_t>(crc_ ^ (value << 8));
    for (int bit = 0; bit < 8; ++bit)
        crc_ = static_cast<uint16_t>((crc_ & 0x8000u) != 0 ? (crc_ << 1) ^ 0x1021 : crc_ << 1);
}

void Crc16::word(uint16_t value) {
    byte(static_cast<uint8_t>(value & 0xffu));
    byte(static_cast<uint8_t>(value >> 8));
}

void Crc16::name(std::string_view name) {
    for (const char character : name) byte(static_cast<uint8_t>(character));
    if (name.size() % 2 != 0) byte(0);
}

uint16_t crc_of_name(std::string_view name) {
    Crc16 crc;
    crc.name(name);
    return crc.value();
}

uint16_t crc_of_description(const Target& target) {
    Crc16 crc;
    crc.word(target.bytecode_size);
    crc.word(target.variables_size);
    crc.word(target.stack_size);
    for (const NamedVariable& variable : target.variables) {
        crc.word(variable.size);
        crc.name(variable.name);
    }
    for (const LocalEvent& event : target.local_events) crc.name(event.name);
    for (const NativeFunction& native : target.natives) {
        crc.name(native.name);
        for (const NativeParameter& parameter : native.parameters) {
            crc.word(static_cast<uint16_t>(parameter.size));
            crc.name(parameter.name);
        }
    }
    return crc.value();
}

std::string format_abo(const Target& target, const AboNode& node,
                       const std::vector<uint16_t>& bytecode) {
    assert(bytecode.size() <= UINT16_MAX);
    std::string bytes(kMagic);
    for (const uint16_t word : {kFormatVersion, target.protocol_version, node.product_id,
                                node.firmware_version, node.node_id, crc_of_name(target.name),
                                crc_of_description(target), static_cast<uint16_t>(bytecode.size())})
        put(bytes, word);
    for (const uint16_t word : bytecode) put(bytes, word);
    put(bytes, crc_of_words(bytecode));
    return bytes;
}

Result<Abo> parse_abo(std::string_view bytes, std::string_view file) {
    if (!bytes.starts_with(kMagic))
        return refused(file,
                       "this is no .abo file: it does not begin with \"ABO\" and a zero "
                       "byte; make one with `vagus compile --format abo`");
    if (bytes.size() < kHeaderBytes)
        return refused(file, fmt::format("the file ends inside its header: {} bytes of {}; copy "
                                         "it again",
                                         bytes.size(), kHeaderBytes));
    const auto header = [bytes](size_t word) { return word_at(bytes, kMagic.size() + 2 * word); };
    if (header(0) != kFormatVersion)
        return refused(file, fmt::format("format version {} is unknown; this program reads {}",
                                         header(0), kFormatVersion));
    const size_t count = header(7);
    const size_t expected = kHeaderBytes + 2 * count + kSumBytes;
    if (bytes.size() != expected)
        return refused(file, fmt::format("the file has {} bytes, its {} words of bytecode need "
                                         "{}; copy it again",
                                         bytes.size(), count, expected));
    Abo abo{header(1), {header(2), header(3), header(4)}, header(5), header(6), {}};
    for (size_t i = 0; i < count; ++i) abo.bytecode.push_back(word_at(bytes, kHeaderBytes + 2 * i));
    const uint16_t sum = word_at(bytes, expected - kSumBytes);
    if (sum != crc_of_words(abo.bytecode))
        return refused(file, fmt::format("the sum over the bytecode is {:04x}, the file says "
                                         "{:04x}; copy it again",
                                         crc_of_words(abo.bytecode), sum));
    return abo;
}

Status check_abo(const Abo& abo, const Target& target, std::string_view file) {
    const bool same = abo.name_crc == crc_of_name(target.name) &&
                      abo.description_crc == crc_of_description(target);
    if (same) return Status::done();
    return Error{Code::Refused, fmt::format("{}: the program was made for another node than \"{}\" "
                                            "(its name or its description differs); compile it "
                                            "for this node",
                                            file, target.name)};
}

}  // namespace vagus::aesl
