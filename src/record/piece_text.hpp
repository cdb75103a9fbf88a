// A text that grows at its end, read again from its beginning: in pieces, so that nothing that is
// there is moved when it grows.
//
//     PieceText text;
//     text.append("ab");
//     text.append("cde");
//     PieceText::Reading reading(text);
//     reading.next(2);                           // "ab"
//     reading.next(3);                           // "cde"
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace vagus::record {

constexpr size_t kPieceBytes = 512u << 10;

class PieceText {
public:
    void append(std::string_view text) {
        if (pieces_.empty() || !has_room(pieces_.back(), text.size())) {
            pieces_.emplace_back().reserve(std::max(kPieceBytes, text.size()));
        }
        pieces_.back() += text;
    }
    // Keeps the room of one piece.
    void clear() {
        const bool keeps = !pieces_.empty() && pieces_.front().capacity() < 2 * kPieceBytes;
        pieces_.resize(keeps ? 1 : 0);
        if (keeps) pieces_.front().clear();
    }

    // By the sizes with which it was appended.
    class Reading {
    public:
        explicit Reading(const PieceText& of) : of_(of) {}
        std::string_view next(size_t bytes) {
            if (bytes == 0) return {};
            while (at_ + bytes > of_.pieces_[piece_].size()) {
                ++piece_;
                at_ = 0;
            }
            const std::string_view text = std::string_view(of_.pieces_[piece_]).substr(at_, bytes);
            at_ += bytes;
            return text;
        }

    private:
        const PieceText& of_;
        size_t piece_ = 0, at_ = 0;
    };

private:
    static bool has_room(const std::string& piece, size_t bytes) {
        return piece.capacity() - piece.size() >= bytes;
    }

    std::vector<std::string> pieces_;
};

}  // namespace vagus::record
