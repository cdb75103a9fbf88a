#include "mcap/records.hpp"

#include <libdeflate.h>

namespace vagus::mcap {

uint32_t crc32(std::string_view bytes, uint32_t before) {
    return libdeflate_crc32(before, bytes.data(), bytes.size());
}

std::string content_of(const Schema& schema) {
    std::string content;
    Put(content).u16(schema.id).string(schema.name).string(schema.encoding).string(schema.data);
    return content;
}

std::string content_of(const Channel& channel) {
    std::string metadata;
    for (const auto& [key, value] : channel.metadata) Put(metadata).string(key).string(value);
    std::string content;
    Put put(content);
    put.u16(channel.id).u16(channel.schema).string(channel.topic).string(channel.encoding);
    put.string(metadata);
    return content;
}

Schema schema_of(Take content) {
    Schema schema;
    schema.id = content.u16();
    schema.name = content.string();
    schema.encoding = content.string();
    schema.data = content.string();
    return schema;
}

Channel channel_of(Take content) {
    Channel channel;
    channel.id = content.u16();
    channel.schema = content.u16();
    channel.topic = content.string();
    channel.encoding = content.string();
    Take metadata(content.string());
    while (metadata.left() > 0) {
        std::string key(metadata.string());
        channel.metadata[std::move(key)] = metadata.string();
    }
    return channel;
}

}  // namespace vagus::mcap
