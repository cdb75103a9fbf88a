#include "sim/sd_card.hpp"

#include <algorithm>

#include "base/file.hpp"

namespace vagus::sim {

bool SdCard::open(int16_t number) {
    path_.clear();
    content_.clear();
    position_ = 0;
    if (number == -1) return true;
    if (number < 0 || !present()) return false;
    const std::string path = folder_ + "/U" + std::to_string(number) + ".DAT";
    Result<std::string> content = read_file(path);
    if (content.ok()) {
        if (content.value().size() > kCardFileBytesMax) return false;
        content_ = std::move(content.value());
    } else if (!write_file(path, "").ok()) {
        return false;
    }
    path_ = path;
    return true;
}

int16_t SdCard::write(std::span<const int16_t> words) {
    const size_t end = position_ + 2 * words.size();
    if (path_.empty() || end > kCardFileBytesMax) return 0;
    if (end > content_.size()) content_.resize(end, '\0');
    for (size_t i = 0; i < words.size(); ++i) {
        const auto word = static_cast<uint16_t>(words[i]);
        content_[position_ + 2 * i] = static_cast<char>(word & 0xff);
        content_[position_ + 2 * i + 1] = static_cast<char>(word >> 8);
    }
    if (!write_file(path_, content_).ok()) return 0;
    position_ = end;
    return static_cast<int16_t>(words.size());
}

int16_t SdCard::read(std::span<int16_t> words) {
    if (path_.empty()) return 0;
    const size_t left = position_ < content_.size() ? content_.size() - position_ : 0;
    const size_t count = std::min(words.size(), left / 2);
    for (size_t i = 0; i < count; ++i) {
        const auto low = static_cast<uint8_t>(content_[position_ + 2 * i]);
        const auto high = static_cast<uint8_t>(content_[position_ + 2 * i + 1]);
        words[i] = static_cast<int16_t>(low | high << 8);
    }
    position_ += 2 * count;
    return static_cast<int16_t>(count);
}

bool SdCard::seek(uint16_t position) {
    if (path_.empty()) return false;
    position_ = position;
    return true;
}

}  // namespace vagus::sim
