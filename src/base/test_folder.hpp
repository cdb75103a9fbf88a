// A folder of one test's own, for the tests of all modules: tests run side by side.
//
//     test::Folder folder;                              // empty
//     write_file((folder / "a.aesl").string(), "");
//
// It goes with its content. Declare it above what works in it: members end in the other order, and
// a thread that still writes there has ended by then.
#pragma once

#include <stdlib.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <system_error>

namespace vagus::test {

class Folder {
public:
    Folder() {
        std::string name = (std::filesystem::temp_directory_path() / "vagus-test-XXXXXX").string();
        if (!::mkdtemp(name.data())) throw std::system_error(errno, std::generic_category(), name);
        path_ = std::filesystem::canonical(name);
    }
    ~Folder() {
        std::error_code failed;
        std::filesystem::remove_all(path_, failed);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::string string() const { return path_.string(); }
    operator const std::filesystem::path&() const { return path_; }
    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

private:
    std::filesystem::path path_;  // without links in it
};

}  // namespace vagus::test
