// Paths that pages may name: inside the project and nowhere else. What a path says is checked
// first, then where it leads: links that leave the project are not followed.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace vagus::serve {

constexpr size_t kPathBytesMax = 512;
constexpr size_t kNameBytesMax = 128;         // of one part of a path
constexpr const char* kOwnFolder = ".vagus";  // journal, breakpoints, layouts: nobody else's

// A relative path with / between names, each of them visible characters without \ : * ? " < > |,
// not beginning with a dot, not ending in a dot or a space.
Status check_path(std::string_view path);
// Why it is none, without the path.
std::optional<std::string> fault_of_path(std::string_view path);

// One of two paths is the end of the other, from a folder on.
bool is_end_of(std::string_view end, std::string_view path);

// Where it leads. Fails if that is outside of `root`.
Result<std::filesystem::path> path_in(const std::filesystem::path& root, std::string_view path);

}  // namespace vagus::serve
