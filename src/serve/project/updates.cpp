#include "serve/project/updates.hpp"

namespace vagus::serve {

namespace {

constexpr size_t kChangeBytes = 32;  // of a change without its text

size_t bytes_of(const Update& update) {
    size_t bytes = kChangeBytes;
    for (const TextChange& change : update.changes) bytes += kChangeBytes + change.text.size();
    return bytes;
}

}  // namespace

void Updates::add(std::vector<TextChange> changes, std::string by) {
    by_ = by;
    kept_.push_back({++version_, std::move(changes), std::move(by)});
    bytes_ += bytes_of(kept_.back());
    while (!kept_.empty() && (kept_.size() > kUpdatesKept || bytes_ > kUpdateBytesKept)) {
        bytes_ -= bytes_of(kept_.front());
        kept_.pop_front();
    }
}

std::optional<std::vector<Update>> Updates::since(uint32_t version) const {
    if (version > version_ || version_ - version > kept_.size()) return std::nullopt;
    const auto missing = static_cast<long>(version_ - version);
    return std::vector<Update>(kept_.end() - missing, kept_.end());
}

}  // namespace vagus::serve
