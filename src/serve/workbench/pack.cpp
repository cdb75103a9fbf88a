#include "serve/workbench/pack.hpp"

#include <fmt/format.h>

#include "base/file.hpp"
#include "serve/json.hpp"

namespace vagus::serve {

Result<std::string> pack(const CollectedBundle& collected) {
    std::string bytes = to_json(collected.bundle).dump() + "\n";
    for (const BundleFile& file : collected.bundle.files) {
        const std::string content = TRY(read_file((collected.root / file.path).string()));
        if (sha256_of(content) != file.sha256) {
            return Error{Code::Unavailable,
                         file.path + ": it was changed meanwhile; deploy once more"};
        }
        bytes += content;
    }
    return bytes;
}

Result<Packed> unpack(std::string_view bytes) {
    const size_t end = bytes.find('\n');
    const Json json =
        end == bytes.npos ? Json() : Json::parse(bytes.substr(0, end), nullptr, false);
    if (!json.is_object()) {
        return Error{Code::BadInput, "expected a version of a project: its list of files first"};
    }
    Packed packed{TRY(bundle_from(json)), {}};
    std::string_view rest = bytes.substr(end + 1);
    for (const BundleFile& file : packed.bundle.files) {
        if (file.size > rest.size()) {
            return Error{Code::BadInput, fmt::format("{}: expected {} bytes, found {}", file.path,
                                                     file.size, rest.size())};
        }
        packed.contents.emplace_back(rest.substr(0, file.size));
        rest.remove_prefix(file.size);
    }
    if (rest.empty()) return packed;
    return Error{Code::BadInput, fmt::format("{} bytes behind the last file", rest.size())};
}

}  // namespace vagus::serve
