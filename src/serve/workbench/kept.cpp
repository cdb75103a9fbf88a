#include "serve/workbench/kept.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/file.hpp"

namespace vagus::serve {

using Json = nlohmann::json;

Kept::Kept(std::string file) : file_(std::move(file)) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file_, failed)) return;
    if (std::filesystem::file_size(file_, failed) > kKeptBytesMax) return;
    const Result<std::string> text = read_file(file_);
    if (!text.ok()) return;
    Json read = Json::parse(text.value(), nullptr, false);
    if (read.is_object()) values_ = std::move(read);
}

Json Kept::get(const std::string& key) const {
    return values_.value(key, Json());
}

Status Kept::put(const std::string& key, Json value) {
    const Json before = values_;
    if (value.is_null()) {
        values_.erase(key);
    } else {
        values_[key] = std::move(value);
    }
    if (values_ == before) return Status::done();
    const std::string text = values_.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    if (text.size() > kKeptBytesMax) {
        values_ = before;
        return Error{Code::Limit, fmt::format("{}: more than {} bytes are kept; \"{}\" is not",
                                              file_, kKeptBytesMax, key)};
    }
    if (file_.empty()) return Status::done();
    std::error_code failed;
    std::filesystem::create_directories(std::filesystem::path(file_).parent_path(), failed);
    return write_file(file_, text);
}

}  // namespace vagus::serve
