#include "cli/record/chain_text.hpp"

#include <fmt/format.h>

namespace vagus::cli {

std::string chain_text(const record::Chain& chain, std::string_view more) {
    const bool whole = more.empty() || chain.size() <= kLinksShown + 1;
    std::string text;
    for (size_t i = 0; i < chain.size(); ++i) {
        if (!whole && i == kLinksShown) {
            text += fmt::format("{:>14} {} more ({}), and it began with:\n", "…",
                                chain.size() - kLinksShown - 1, more);
            i = chain.size() - 1;
        }
        text += record::format_link(chain[i]) + "\n";
    }
    return text;
}

}  // namespace vagus::cli
