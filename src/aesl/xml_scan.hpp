// Where the pieces of an XML text end: what reading a project and changing its text share.
#pragma once

#include <cstddef>
#include <string_view>

namespace vagus::aesl {

// Behind the > that ends the start tag at `offset`; a > in an attribute's value does not count.
inline size_t behind_start_tag(std::string_view text, size_t offset) {
    char quote = '\0';
    for (; offset < text.size(); ++offset) {
        const char character = text[offset];
        if (quote != '\0') {
            if (character == quote) quote = '\0';
        } else if (character == '"' || character == '\'') {
            quote = character;
        } else if (character == '>') {
            return offset + 1;
        } else {
            // Part of the tag.
        }
    }
    return offset;
}

// Comments, CDATA, processing instructions: in them an & means nothing.
struct Opaque {
    std::string_view opening;
    std::string_view closing;
};
inline constexpr Opaque kOpaque[] = {{"<!--", "-->"}, {"<![CDATA[", "]]>"}, {"<?", "?>"}};

// Behind the opaque part that begins at `offset`; `offset` itself if none does.
inline size_t skip_opaque(std::string_view text, size_t offset) {
    for (const Opaque& part : kOpaque) {
        if (!text.substr(offset).starts_with(part.opening)) continue;
        const size_t end = text.find(part.closing, offset + part.opening.size());
        return end == text.npos ? text.size() : end + part.closing.size();
    }
    return offset;
}

}  // namespace vagus::aesl
