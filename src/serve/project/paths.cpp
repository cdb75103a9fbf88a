#include "serve/project/paths.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/text.hpp"

namespace vagus::serve {

namespace fs = std::filesystem;

namespace {

using Why = std::optional<std::string>;

Error refuse(std::string_view path, const std::string& why) {
    return {Code::BadInput, fmt::format("“{}”: {}", path.substr(0, 200), why)};
}

Why fault_of_name(std::string_view name) {
    if (name.empty()) return "a part of the path is empty; write it as folder/file";
    if (name.size() > kNameBytesMax) {
        return fmt::format("a name of {} bytes; use at most {}", name.size(), kNameBytesMax);
    }
    if (name.front() == '.') return "a name begins with a dot; such files are not the studio's";
    if (name.back() == '.' || name.back() == ' ' || name.front() == ' ') {
        return "a name begins or ends in a space or a dot; leave it out";
    }
    const bool odd = std::any_of(name.begin(), name.end(), [](char letter) {
        return static_cast<unsigned char>(letter) < 0x20 || letter == 0x7f ||
               std::string_view("\\:*?\"<>|#").find(letter) != std::string_view::npos;
    });
    if (odd) return "a name has an odd character; use letters, digits, - and _";
    return std::nullopt;
}

bool is_inside(const fs::path& root, const fs::path& path) {
    const auto [end, rest] = std::mismatch(root.begin(), root.end(), path.begin(), path.end());
    return end == root.end();
}

}  // namespace

std::optional<std::string> fault_of_path(std::string_view path) {
    if (path.empty()) return "the path is empty";
    if (path.size() > kPathBytesMax) {
        return fmt::format("{} bytes; use at most {}", path.size(), kPathBytesMax);
    }
    if (path.front() == '/') return "the path must begin inside the project";
    if (malformed_utf8_at(path)) return "the path is not UTF-8";
    for (const std::string_view name : split(path, '/')) {
        if (auto why = fault_of_name(name)) return why;
    }
    return std::nullopt;
}

Status check_path(std::string_view path) {
    const auto why = fault_of_path(path);
    if (!why) return Status::done();
    return refuse(malformed_utf8_at(path) ? "" : path, *why);
}

bool is_end_of(std::string_view end, std::string_view path) {
    if (!path.ends_with(end)) return false;
    return path.size() == end.size() || path[path.size() - end.size() - 1] == '/';
}

Result<fs::path> path_in(const fs::path& root, std::string_view path) {
    TRY(check_path(path));
    std::error_code failed;
    const fs::path real_root = fs::canonical(root, failed);
    const fs::path real = fs::weakly_canonical(root / fs::path(std::string(path)), failed);
    if (!failed && is_inside(real_root, real)) return root / fs::path(std::string(path));
    return refuse(path, "it leads out of the project; the studio does not follow it");
}

}  // namespace vagus::serve
