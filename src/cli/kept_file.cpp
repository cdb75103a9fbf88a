#include "cli/kept_file.hpp"

#include <filesystem>

#include "serve/project/open_text.hpp"
#include "trial/test_file.hpp"

namespace vagus::cli {

bool is_source_or_recording(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return false;
    const std::string kind = serve::kind_of_file(path);
    const bool is_source = kind != "picture" && kind != "text" && kind != "other";
    return is_source || path.ends_with(trial::kTestEnding) || path.ends_with(".mcap");
}

}  // namespace vagus::cli
