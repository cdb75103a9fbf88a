// Bytes as an MCAP file: whatever they are, reading ends, and what is told lies within them.
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "mcap/reader.hpp"
#include "mcap/writer.hpp"

using namespace vagus;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    std::string bytes(mcap::kMagic);
    bytes.append(reinterpret_cast<const char*>(data), size);
    const auto reader = mcap::Reader::open(bytes, "fuzz.mcap");
    if (!reader.ok()) std::abort();
    mcap::Cursor cursor(reader.value());
    while (const auto message = cursor.next()) {
        (void)reader.value().channel(message->channel);
    }
    // What was read can be written again.
    mcap::Writer writer([](std::string_view) { return Status::done(); });
    for (const auto& one : reader.value().attachments()) writer.attach(one);
    for (const auto& one : reader.value().channels()) (void)writer.add_channel(one);
    if (!writer.end().ok()) std::abort();
    return 0;
}
