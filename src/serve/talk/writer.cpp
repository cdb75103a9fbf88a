#include "serve/talk/writer.hpp"

#include <cmath>
#include <cstring>

#include "base/text.hpp"
#include "serve/talk/frames.hpp"

namespace vagus::serve::talk {

namespace {

constexpr std::string_view kReplacement = "\xef\xbf\xbd";  // U+FFFD

std::string well_formed(std::string_view text) {
    std::string made;
    while (const auto bad = malformed_utf8_at(text)) {
        made.append(text.substr(0, *bad)).append(kReplacement);
        text.remove_prefix(*bad + 1);
    }
    return made.append(text);
}

}  // namespace

bool BusFrame::operator==(const BusFrame& other) const {
    return frame.source == other.frame.source && frame.type == other.frame.type &&
           frame.size == other.frame.size &&
           std::memcmp(frame.payload, other.frame.payload, frame.size) == 0;
}

void Writer::put_size(size_t size) {
    append(bytes_, static_cast<uint32_t>(size));
}

void Writer::put(bool value) {
    put_kind(Kind::Bool);
    bytes_.push_back(value ? 1 : 0);
}

void Writer::put(double value) {
    put_kind(Kind::Number);
    append(bytes_, value);
}

void Writer::put(const std::string& text) {
    const std::string good = well_formed(text);
    put_kind(Kind::Text);
    put_size(good.size());
    bytes_.append(good);
}

void Writer::put(const Bytes& bytes) {
    put_kind(Kind::Bytes);
    put_size(bytes.bytes.size());
    bytes_.append(bytes.bytes);
}

void Writer::put(const BusFrame& frame) {
    put(Bytes{encode_frame(frame.frame)});
}

// An object stays in the run that holds it.
void Writer::put(const plan::Value& value) {
    switch (value.type()) {
        case plan::Type::Bool:
            return put(value.boolean());
        case plan::Type::Int:
            return put(value.integer());
        case plan::Type::Float:
            return put(value.number());
        case plan::Type::String:
            return put(value.string());
        case plan::Type::Object:
            return put_nothing();
    }
}

// As in a text of JSON, what is not finite is null.
void Writer::put(const nlohmann::json& json) {
    if (json.is_boolean()) return put(json.get<bool>());
    if (json.is_number_unsigned()) return put(json.get<uint64_t>());
    if (json.is_number_integer()) return put(json.get<int64_t>());
    if (json.is_number() && std::isfinite(json.get<double>())) return put(json.get<double>());
    if (json.is_string()) return put(json.get_ref<const std::string&>());
    if (json.is_array()) return put_list(json);
    if (!json.is_object()) return put_nothing();
    put_kind(Kind::Table);
    put_size(json.size());
    for (const auto& [name, value] : json.items()) {
        put(name);
        put(value);
    }
}

}  // namespace vagus::serve::talk
