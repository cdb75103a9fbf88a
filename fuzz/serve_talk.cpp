// Any bytes as a message between the server and the process of a run: refused with a sentence, or a
// message that is written again and read again as it was. The first byte is the kind of the packet.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "serve/talk/codec.hpp"

using namespace vagus;

namespace {

template <typename Message>
void check(const Result<Message>& read, Result<Message> (*decode)(const serve::Packet&)) {
    if (!read.ok()) {
        if (read.error().what.find("expected ") == std::string::npos) std::abort();
        return;
    }
    const serve::Packet once = serve::talk::encode(read.value());
    const auto again = decode(once);
    if (!again.ok() || !(again.value() == read.value())) std::abort();
    if (serve::talk::encode(again.value()).bytes != once.bytes) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size == 0) return 0;
    const auto* bytes = reinterpret_cast<const char*>(data);
    const serve::Packet packet{bytes[0], std::string(bytes + 1, size - 1)};
    check(serve::talk::decode_order(packet), serve::talk::decode_order);
    check(serve::talk::decode_news(packet), serve::talk::decode_news);
    return 0;
}
