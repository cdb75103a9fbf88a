#include "serve/web/pages.hpp"

#include <filesystem>

#include "base/file.hpp"

namespace vagus::serve {

namespace {

namespace fs = std::filesystem;

const std::map<std::string_view, std::string_view> kTypes = {
    {".html", "text/html; charset=utf-8"},
    {".js", "text/javascript; charset=utf-8"},
    {".css", "text/css; charset=utf-8"},
    {".json", "application/json"},
    {".svg", "image/svg+xml"},
    {".png", "image/png"},
    {".ico", "image/x-icon"},
    {".woff2", "font/woff2"},
    {".wasm", "application/wasm"},
    {".txt", "text/plain; charset=utf-8"},
    {".webmanifest", "application/manifest+json"},
};

std::string type_of(const fs::path& path) {
    const auto found = kTypes.find(path.extension().string());
    return std::string(found == kTypes.end() ? "application/octet-stream" : found->second);
}

Error cannot(const std::string& folder, const std::string& why) {
    return {Code::NotFound, folder + ": " + why};
}

}  // namespace

Result<Pages> Pages::read(const std::string& folder) {
    Pages pages;
    std::error_code error;
    size_t bytes = 0;
    for (auto entry = fs::recursive_directory_iterator(folder, error);
         !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
        std::error_code unknown;
        if (!entry->is_regular_file(unknown) || entry->path().extension() == ".gz") continue;
        const std::string path = entry->path().string();
        Page page;
        page.type = type_of(entry->path());
        page.content = TRY(read_file(path));
        if (fs::exists(path + ".gz", unknown)) page.gzipped = TRY(read_file(path + ".gz"));
        const std::string name = "/" + fs::relative(entry->path(), folder).generic_string();
        page.lasting = name.starts_with("/assets/");
        bytes += page.content.size() + page.gzipped.size();
        pages.pages_.emplace(name, std::move(page));
        if (bytes > kPagesBytesMax || pages.pages_.size() > kPagesMax) {
            return cannot(folder, "too much for pages; is it the right folder?");
        }
    }
    if (!pages.find("/")) {
        return cannot(folder, "the studio's pages are not there; ./run builds them");
    }
    return pages;
}

const Page* Pages::find(std::string_view path) const {
    const auto found = pages_.find(path == "/" ? "/index.html" : path);
    return found == pages_.end() ? nullptr : &found->second;
}

}  // namespace vagus::serve
