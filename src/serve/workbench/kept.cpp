#include "serve/workbench/kept.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/file.hpp"
#include "serve/json.hpp"
#include "serve/protocol/depth.hpp"

namespace vagus::serve {

Kept::Kept(std::string file, DiskSync* disk) : file_(std::move(file)), disk_(disk) {
    std::error_code failed;
    if (!std::filesystem::is_regular_file(file_, failed)) return;
    if (std::filesystem::file_size(file_, failed) > kKeptBytesMax) return;
    const Result<std::string> text = read_file(file_);
    if (!text.ok() || depth_of(text.value()) > kKeptDepthMax) return;
    Json read = Json::parse(text.value(), nullptr, false);
    if (read.is_object()) values_ = std::move(read);
}

Json Kept::get(const std::string& key) const {
    return values_.value(key, Json());
}

Json Kept::object(const std::string& key) const {
    Json value = get(key);
    return value.is_object() ? value : Json::object();
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
    TRY(write_file_unsynced(file_, text));
    if (disk_) disk_->post(file_);
    return Status::done();
}

}  // namespace vagus::serve
