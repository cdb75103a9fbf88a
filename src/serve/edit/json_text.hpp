// A JSON text taken apart without losing a byte: every value with the blanks around it, so that one
// member can change and all else stays as somebody wrote it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/json.hpp"

namespace vagus::serve {

struct JsonText {
    struct Part;
    enum class Kind { Scalar, Array, Object };
    Kind kind = Kind::Scalar;
    std::string raw;          // Scalar: as written
    std::vector<Part> parts;  // Array, Object
    std::string tail;         // blanks before the closing bracket

    // `text` must be JSON (base/json.hpp); blanks around it are not kept.
    static JsonText read(std::string_view text);
    void write_to(std::string& text) const;
    std::string text() const;

    // The first part of that key.
    Part* find(std::string_view key);
    // Whether its parts are in lines of their own.
    bool is_open() const;
    // Takes the part away, or puts it before that index; blanks follow.
    Part take(size_t index);
    // `depth`: how many values are around this one.
    void insert(size_t index, Part part, size_t depth);
};

// An item or a member: before "key" between value after ,
struct JsonText::Part {
    std::string before;
    std::string key, raw_key;  // Object
    std::string between;       // Object: colon and blanks
    JsonText value;
    std::string after;
};

}  // namespace vagus::serve
