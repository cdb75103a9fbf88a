// Where the lines of `--trace` and `--trace-all` go: a file, `-` for stdout, nowhere for an empty
// path.
#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace vagus::embed {

class TraceSink {
public:
    // `at_once`: every write has left the process when it returns, so that what a run in real time
    // did is there even if the process is killed.
    static Result<std::unique_ptr<TraceSink>> open(const std::string& path, bool at_once);
    TraceSink() = default;
    ~TraceSink();
    TraceSink(const TraceSink&) = delete;
    TraceSink& operator=(const TraceSink&) = delete;

    explicit operator bool() const { return file_ != nullptr; }
    // Whole lines, each with its newline.
    void write(std::string_view lines);

private:
    std::FILE* file_ = nullptr;
    bool owned_ = false;
    bool at_once_ = false;
};

}  // namespace vagus::embed
