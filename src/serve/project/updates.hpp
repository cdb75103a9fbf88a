// The last steps of a document's history, so that a page that has an older text gets what it lacks
// instead of the whole. The version counts steps, one by one.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "serve/project/text_change.hpp"

namespace vagus::serve {

constexpr size_t kUpdatesKept = 1000;          // steps of a document; the protocol names it, too
constexpr size_t kUpdateBytesKept = 2u << 20;  // of all that they put in

struct Update {
    uint32_t version = 0;  // that it leads to
    std::vector<TextChange> changes;
    std::string by;  // the page's name for itself; for:N, disk or server for what we do
    friend bool operator==(const Update&, const Update&) = default;
};

class Updates {
public:
    explicit Updates(uint32_t version = 1) : version_(version) {}

    uint32_t version() const { return version_; }
    const std::string& by() const { return by_; }  // the last one
    void add(std::vector<TextChange> changes, std::string by);
    // What leads from that version to this one; nothing if it lies too far back, or ahead.
    std::optional<std::vector<Update>> since(uint32_t version) const;

private:
    uint32_t version_;
    std::string by_;
    std::deque<Update> kept_;
    size_t bytes_ = 0;
};

}  // namespace vagus::serve
