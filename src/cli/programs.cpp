#include "cli/programs.hpp"

#include <unistd.h>

#include <cstdlib>

#include "base/text.hpp"

namespace vagus::cli {

constexpr const char* kFurtherFolder = "/usr/sbin";

std::optional<std::string> find_program(const std::string& name) {
    const char* const path = std::getenv("PATH");
    const std::string folders = std::string(path == nullptr ? "" : path) + ":" + kFurtherFolder;
    for (const std::string_view folder : split(folders, ':')) {
        const std::string file = std::string(folder) + "/" + name;
        if (!folder.empty() && access(file.c_str(), X_OK) == 0) return file;
    }
    return std::nullopt;
}

}  // namespace vagus::cli
