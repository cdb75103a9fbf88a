#include "serve/talk/codec.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "serve/follow/record.hpp"
#include "serve/talk/reader.hpp"

namespace vagus::serve::talk {

namespace {

constexpr uint8_t kFirst = 1;  // the kind of packet of the first message of a list

template <typename List>
Packet packet_of(const List& message) {
    Writer writer;
    std::visit([&](const auto& one) { std::decay_t<decltype(one)>::layout(writer, one); }, message);
    return {static_cast<char>(message.index() + kFirst), writer.take()};
}

// ---- what a layout cannot say ----

template <typename Message>
std::optional<std::string> fault_in(const Message&) {
    return std::nullopt;
}

std::optional<std::string> fault_in(const Records& records) {
    if (each_record(records.bytes.bytes, {})) return std::nullopt;
    return fmt::format("records.bytes: expected whole records, found {} bytes that are none",
                       records.bytes.bytes.size());
}

// ---- reading ----

template <typename List, typename Message>
Result<List> read(std::string_view bytes) {
    Message message;
    Reader reader(Message::kName, bytes);
    Message::layout(reader, message);
    auto fault = reader.finish();
    if (!fault) fault = fault_in(message);
    if (fault) return Error{Code::BadInput, std::move(*fault)};
    return List(std::move(message));
}

template <typename List, size_t... kIndices>
Result<List> read_one(size_t index, std::string_view bytes, std::index_sequence<kIndices...>) {
    using Read = Result<List> (*)(std::string_view);
    static constexpr std::array<Read, sizeof...(kIndices)> kAll = {
        &read<List, std::variant_alternative_t<kIndices, List>>...};
    return kAll[index](bytes);
}

template <typename List>
Result<List> decode(const Packet& packet) {
    constexpr size_t kCount = std::variant_size_v<List>;
    const size_t number = static_cast<uint8_t>(packet.kind);
    if (number < kFirst || number >= kFirst + kCount) {
        return Error{Code::BadInput, fmt::format("a message: expected one of the numbers {} to {}, "
                                                 "found {}",
                                                 kFirst, kFirst + kCount - 1, number)};
    }
    return read_one<List>(number - kFirst, packet.bytes, std::make_index_sequence<kCount>());
}

}  // namespace

Packet encode(const Order& order) {
    return packet_of(order);
}

Packet encode(const News& news) {
    return packet_of(news);
}

Result<Order> decode_order(const Packet& packet) {
    return decode<Order>(packet);
}

Result<News> decode_news(const Packet& packet) {
    return decode<News>(packet);
}

}  // namespace vagus::serve::talk
