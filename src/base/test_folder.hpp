// A folder of one test's own, for the tests of all modules: tests run side by side.
//
//     test::Folder folder;  // empty
//     const std::string path = folder.write("nodes/a.aesl", "var x\n");
//
// It goes with its content. Declare it above what works in it: members end in the other order, and
// a thread that still writes there has ended by then.
#pragma once

#include <stdlib.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
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
    // Its path. Folders on the way are made.
    std::string write(std::string_view name, std::string_view text) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << text;
        return file.string();
    }

private:
    std::filesystem::path path_;  // without links in it
};

}  // namespace vagus::test
