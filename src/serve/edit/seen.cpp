#include "serve/edit/seen.hpp"

#include <fmt/format.h>

namespace vagus::serve {

bool seen_all(const Call& call, Files& files, const std::string& epoch) {
    const auto seen = call.in.find("seen");
    if (seen == call.in.end() || seen->is_null()) return true;
    for (const auto& one : *seen) {
        const std::string doc = one["doc"];
        const uint32_t version = one["version"];
        const uint32_t now = files.version(doc);
        const bool ours = !one.contains("epoch") || one["epoch"] == epoch;
        if (ours && version == now) continue;
        call.fail("behind", fmt::format("{}: the text is at version {} by now, what was asked is "
                                        "for version {}{}; look at the new text and ask again",
                                        doc, now, version,
                                        ours ? "" : " of the server before it was restarted"));
        return false;
    }
    return true;
}

}  // namespace vagus::serve
