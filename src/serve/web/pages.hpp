// The built pages, held in memory: what is not among them does not exist, so no path can lead out.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace vagus::serve {

constexpr size_t kPagesBytesMax = 64u << 20;  // all together
constexpr size_t kPagesMax = 5000;            // files

struct Page {
    std::string type;  // "text/html; charset=utf-8"
    std::string content;
    std::string gzipped;   // the same, if the build made FILE.gz; else empty
    bool lasting = false;  // its name has a hash of its content: a browser may keep it
};

class Pages {
public:
    // Reads a folder. One without index.html is an Error that says how the pages are made.
    static Result<Pages> read(const std::string& folder);

    // By the path of a request, "/" for index.html; nullptr if there is none.
    const Page* find(std::string_view path) const;

private:
    std::map<std::string, Page, std::less<>> pages_;
};

}  // namespace vagus::serve
