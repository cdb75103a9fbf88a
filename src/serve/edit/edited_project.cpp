#include "serve/edit/edited_project.hpp"

#include <filesystem>

namespace vagus::serve {

namespace fs = std::filesystem;

std::string made_for(uint32_t member) {
    return "for:" + std::to_string(member);
}

std::string folder_of_path(const std::string& path) {
    const size_t slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
}

std::string path_from(const std::string& file, const std::string& named) {
    return (fs::path(folder_of_path(file)) / named).lexically_normal().generic_string();
}

bool is_border(const std::string& path) {
    return path == ".";
}

std::string name_from(const std::string& file, const std::string& path) {
    return fs::path(path).lexically_relative(folder_of_path(file)).generic_string();
}

bool is_below(const std::string& folder, const std::string& path) {
    return folder.empty() || path == folder || path.starts_with(folder + "/");
}

}  // namespace vagus::serve
