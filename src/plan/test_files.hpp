// Where plans come from in tests, benchmarks and fuzz targets.
//
//     const plan::Checked checked = plan::check("p.plan.json", plan::OneText(kText), library);
#pragma once

#include <string>
#include <string_view>

#include "base/file.hpp"
#include "plan/check.hpp"

namespace vagus::plan {

// The same text, whichever file is asked for.
class OneText final : public Files {
public:
    explicit OneText(std::string_view text) : text_(text) {}
    Result<std::string> read(const std::string&) const override { return text_; }

private:
    std::string text_;
};

// Any file of this computer.
class Disk final : public Files {
public:
    Result<std::string> read(const std::string& path) const override { return read_file(path); }
};

}  // namespace vagus::plan
