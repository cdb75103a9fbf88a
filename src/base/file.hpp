// Files: the only part of `base` that touches the system.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/result.hpp"

namespace vagus {

constexpr size_t kFileBytesMax = 256u << 20;

// The whole file. The Error names the file and the system's reason. "-" is standard input.
Result<std::string> read_file(const std::string& path);

// The bytes of a file, as the system pages them in: for files of any size that are only read. What
// somebody else cuts off meanwhile is read as zeros.
class MappedFile {
public:
    static Result<MappedFile> open(const std::string& path);
    ~MappedFile();
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&&) = delete;
    std::string_view bytes() const { return {data_, size_}; }

private:
    MappedFile(const char* data, size_t size) : data_(data), size_(size) {}
    const char* data_ = nullptr;  // owned
    size_t size_ = 0;
};

// A file is there, with something in it, and does not begin so: it is no older one of a kind that
// does, but another whose name was typed in the wrong place.
bool is_file_of_another_kind(const std::string& path, std::string_view begins);

// A new file that grows. What was in a file of that name is gone. Refused while another one writes
// it, in this process or elsewhere.
class GrowingFile {
public:
    static Result<GrowingFile> create(const std::string& path);
    ~GrowingFile();
    GrowingFile(GrowingFile&& other) noexcept;
    GrowingFile& operator=(GrowingFile&&) = delete;
    // They are with the system when it returns.
    Status append(std::string_view bytes);

private:
    GrowingFile(std::string path, int descriptor)
        : path_(std::move(path)), descriptor_(descriptor) {}
    std::string path_;
    int descriptor_ = -1;
};

// Keeps all that read_file() reads in this process, by path as it was named; of a file that is read
// again, what was read first. One at a time; from any thread.
//
//     FilesRead files;
//     …                                                  // a run is prepared
//     for (const auto& [path, content] : files.all()) pack(path, content);
class FilesRead {
public:
    FilesRead();
    ~FilesRead();
    FilesRead(const FilesRead&) = delete;
    FilesRead& operator=(const FilesRead&) = delete;
    std::map<std::string, std::string> all() const;
};

// What read_file() gives in place of what is on the disk, by path, however that is spelled: for a
// run that reads its files as they were once. One at a time; from any thread.
//
//     FilesInstead then;
//     then.put("/home/ann/hall/drive.aesl", text);
class FilesInstead {
public:
    FilesInstead();
    ~FilesInstead();
    FilesInstead(const FilesInstead&) = delete;
    FilesInstead& operator=(const FilesInstead&) = delete;
    void put(const std::string& path, std::string content);
};

// Writes beside the file and renames over it, so that a crash leaves the old file or the new one,
// never half of it.
// What is no file (/dev/stdout, a pipe) is written to as it is.
Status write_file(const std::string& path, std::string_view content);
// The same without waiting for the disk, which sync_file() does: a reader of the file gets the new
// content from now on, but a power cut before sync_file() may leave the old one, or none.
Status write_file_unsynced(const std::string& path, std::string_view content);

// Puts bytes behind the end of a file, which is made if it is not there. They are with the system
// then, whatever becomes of this process; sync_file() waits until they are on the disk. What was
// written half is taken back.
Status append_file(const std::string& path, std::string_view content);
// Waits for the disk: seconds, on a slow one. A file that is gone by now is no error.
Status sync_file(const std::string& path);

}  // namespace vagus
