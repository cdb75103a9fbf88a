// Reading and writing whole files with POSIX calls: see file.hpp.
#include "base/file.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cassert>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>

#include "base/lost_pages.hpp"
#include "base/one_writer.hpp"

namespace vagus {
namespace {

constexpr size_t kReadBytes = 64u << 10;

using Contents = std::map<std::string, std::string>;

// Of the one FilesRead, and the one FilesInstead, that there may be.
std::mutex kept_mutex;
std::optional<Contents> kept_files;     // guarded by kept_mutex
std::optional<Contents> files_instead;  // the same; by as_one_path()

std::string as_one_path(const std::string& path) {
    std::error_code failed;
    const auto whole = std::filesystem::absolute(path, failed);
    return (failed ? std::filesystem::path(path) : whole).lexically_normal().string();
}

std::optional<std::string> content_instead(const std::string& path) {
    const std::lock_guard lock(kept_mutex);
    if (!files_instead) return std::nullopt;
    const auto found = files_instead->find(as_one_path(path));
    return found == files_instead->end() ? std::nullopt : std::optional(found->second);
}

void note_read(const std::string& path, const std::string& content) {
    const std::lock_guard lock(kept_mutex);
    if (kept_files) kept_files->emplace(path, content);
}

// Owns one open file; closes it at the end of the scope.
class OpenFile {
public:
    explicit OpenFile(int descriptor) : descriptor_(descriptor) {}
    ~OpenFile() {
        if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;
    int get() const { return descriptor_; }

private:
    int descriptor_;
};

Error failure(const std::string& path, const std::string& act) {
    const int reason = errno;
    const Code code = reason == ENOENT ? Code::NotFound : Code::Unavailable;
    return {code, path + ": cannot be " + act + ": " + std::strerror(reason)};
}

Error too_large(const std::string& path) {
    return {Code::Limit, path + ": is larger than " + std::to_string(kFileBytesMax >> 20) +
                             " MB, the most that is read; use a smaller file"};
}

// A pipe that this process was handed (`vagus plan check <(maker)`), not one that a file names.
bool is_handed_over(const std::string& path) {
    return path.starts_with("/dev/fd/") || path.starts_with("/proc/") || path == "/dev/stdin";
}

// Opening a pipe by its name would wait until somebody writes: a path in a plan could hang us. So
// it is opened without waiting, looked at, and only then read as any file.
Status refuse_pipe(const OpenFile& file, const std::string& path) {
    struct stat opened = {};
    if (::fstat(file.get(), &opened) != 0) return failure(path, "read");
    if (S_ISFIFO(opened.st_mode) && !is_handed_over(path)) {
        return Error{Code::Unavailable,
                     path + ": cannot be read: it is a pipe; name a file, or - for standard input"};
    }
    if (::fcntl(file.get(), F_SETFL, O_RDONLY) != 0) return failure(path, "read");
    return Status::done();
}

Result<std::string> read_all(const OpenFile& file, const std::string& path) {
    std::string content;
    std::string piece(kReadBytes, '\0');
    while (true) {
        const ssize_t count = ::read(file.get(), piece.data(), piece.size());
        if (count == 0) return content;
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return failure(path, "read");
        content.append(piece, 0, static_cast<size_t>(count));
        if (content.size() > kFileBytesMax) return too_large(path);
    }
}

Status write_all(const OpenFile& file, std::string_view content, const std::string& path) {
    while (!content.empty()) {
        const ssize_t count = ::write(file.get(), content.data(), content.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return failure(path, "written");
        content.remove_prefix(static_cast<size_t>(count));
    }
    return Status::done();
}

// Where the bytes go in the end: through symbolic links, so that saving does not replace a link by
// a file.
std::string final_path(const std::string& path) {
    std::error_code ignored;
    const auto real = std::filesystem::canonical(path, ignored);
    return ignored ? path : real.string();
}

// The rights of the file that will be replaced, else those that a new file gets.
mode_t rights_for(const std::string& path) {
    struct stat old = {};
    if (::stat(path.c_str(), &old) == 0) return old.st_mode & 07777u;
    const mode_t mask = ::umask(0);
    ::umask(mask);
    return 0666u & ~mask;
}

// Devices and pipes are written to; only files are replaced.
bool is_replaceable(const std::string& path) {
    struct stat old = {};
    return ::stat(path.c_str(), &old) != 0 || S_ISREG(old.st_mode);
}

Status write_through(const std::string& path, std::string_view content) {
    const OpenFile file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (file.get() < 0) return failure(path, "written");
    return write_all(file, content, path);
}

// A new file in the folder of another. Without a name where the system has such files: a program
// that is killed while writing leaves nothing behind.
struct Beside {
    int descriptor = -1;
    std::string name;    // what it is called, or will be
    bool named = false;  // is it called so already?
};

Beside open_beside(const std::string& target) {
    std::string folder = std::filesystem::path(target).parent_path().string();
    if (folder.empty()) folder = ".";
    Beside beside{::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600), ""};
    // No other open file has these two numbers.
    beside.name =
        target + "." + std::to_string(::getpid()) + "." + std::to_string(beside.descriptor);
    if (beside.descriptor >= 0) return beside;
    beside.name = target + ".XXXXXX";
    beside.descriptor = ::mkostemp(beside.name.data(), O_CLOEXEC);
    beside.named = beside.descriptor >= 0;
    return beside;
}

bool give_name(Beside& beside) {
    if (beside.named) return true;
    const std::string open = "/proc/self/fd/" + std::to_string(beside.descriptor);
    ::unlink(beside.name.c_str());  // of a process that had both numbers and ended right here
    beside.named =
        ::linkat(AT_FDCWD, open.c_str(), AT_FDCWD, beside.name.c_str(), AT_SYMLINK_FOLLOW) == 0;
    return beside.named;
}

enum class Disk { Wait, Later };

Status fill(Beside& beside, std::string_view content, mode_t rights, const std::string& path,
            Disk disk) {
    const OpenFile file(beside.descriptor);
    const Status written = write_all(file, content, path);
    if (!written.ok()) return written;
    if (::fchmod(file.get(), rights) != 0) return failure(beside.name, "given its rights");
    // Without this a crash of the machine could leave the new name with no bytes in it.
    if (disk == Disk::Wait && ::fsync(file.get()) != 0) return failure(path, "written");
    if (!give_name(beside)) return failure(path, "written");
    return Status::done();
}

Status write(const std::string& path, std::string_view content, Disk disk) {
    const std::string target = final_path(path);
    if (!is_replaceable(target)) return write_through(path, content);
    Beside beside = open_beside(target);
    if (beside.descriptor < 0) return failure(path, "written");
    Status filled = fill(beside, content, rights_for(target), path, disk);
    if (filled.ok() && ::rename(beside.name.c_str(), target.c_str()) == 0) return Status::done();
    const Status failed = filled.ok() ? Status(failure(path, "written")) : filled;
    if (beside.named) ::unlink(beside.name.c_str());
    return failed;
}

// A pipe would hold up who writes for as long as nobody reads, and lines for a person would stand
// between the bytes where standard output is that file, too.
Status need_file(int descriptor, const std::string& path) {
    struct stat found = {};
    struct stat output = {};
    if (::fstat(descriptor, &found) != 0) return failure(path, "written");
    const bool is_pipe = S_ISFIFO(found.st_mode) || S_ISSOCK(found.st_mode);
    const bool is_output = S_ISREG(found.st_mode) && ::fstat(STDOUT_FILENO, &output) == 0 &&
                           output.st_dev == found.st_dev && output.st_ino == found.st_ino;
    if (!is_pipe && !is_output) return Status::done();
    return Error{Code::Refused, path + ": expected the name of a file, found " +
                                    (is_pipe ? "a pipe" : "where standard output goes") +
                                    "; name a file of its own"};
}

}  // namespace

bool is_file_of_another_kind(const std::string& path, std::string_view begins) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) return false;
    std::string found(begins.size(), '\0');
    std::ifstream file(path, std::ios::binary);
    file.read(found.data(), static_cast<std::streamsize>(found.size()));
    found.resize(static_cast<size_t>(file.gcount()));
    return !begins.starts_with(found);
}

Result<std::string> read_file(const std::string& path) {
    if (path == "-") return read_all(OpenFile(STDIN_FILENO), "standard input");
    if (auto content = content_instead(path)) {
        note_read(path, *content);
        return std::move(*content);
    }
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.get() < 0) return failure(path, "read");
    TRY(refuse_pipe(file, path));
    std::string content = TRY(read_all(file, path));
    note_read(path, content);
    return content;
}

FilesRead::FilesRead() {
    const std::lock_guard lock(kept_mutex);
    assert(!kept_files);
    kept_files.emplace();
}

FilesRead::~FilesRead() {
    const std::lock_guard lock(kept_mutex);
    kept_files.reset();
}

std::map<std::string, std::string> FilesRead::all() const {
    const std::lock_guard lock(kept_mutex);
    return *kept_files;
}

FilesInstead::FilesInstead() {
    const std::lock_guard lock(kept_mutex);
    assert(!files_instead);
    files_instead.emplace();
}

FilesInstead::~FilesInstead() {
    const std::lock_guard lock(kept_mutex);
    files_instead.reset();
}

void FilesInstead::put(const std::string& path, std::string content) {
    const std::lock_guard lock(kept_mutex);
    files_instead->insert_or_assign(as_one_path(path), std::move(content));
}

// ---- files of any size ----

Result<MappedFile> MappedFile::open(const std::string& path) {
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat opened = {};
    if (file.get() < 0 || ::fstat(file.get(), &opened) != 0) return failure(path, "read");
    if (!S_ISREG(opened.st_mode)) {
        return Error{Code::BadInput, path + ": cannot be read: expected a file"};
    }
    const auto size = static_cast<size_t>(opened.st_size);
    if (size == 0) return MappedFile(nullptr, 0);
    void* const data = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
    if (data == MAP_FAILED) return failure(path, "read");
    guard_pages(data, size);
    return MappedFile(static_cast<const char*>(data), size);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}

MappedFile::~MappedFile() {
    if (data_ == nullptr) return;
    unguard_pages(data_);
    // munmap asks for memory that may be written; it does not.
    ::munmap(const_cast<char*>(data_), size_);
}

Result<GrowingFile> GrowingFile::create(const std::string& path) {
    if (path == "-") {
        return Error{Code::Refused,
                     "-: expected the name of a file, found that of standard output; name a file "
                     "of its own (./- for one of this name)"};
    }
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
    if (descriptor < 0) return failure(path, "written");
    GrowingFile file(path, descriptor);
    TRY(need_file(descriptor, path));
    TRY(begin_to_write(descriptor, path));
    return file;
}

GrowingFile::GrowingFile(GrowingFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

GrowingFile::~GrowingFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

Status GrowingFile::append(std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return failure(path_, "written");
        bytes.remove_prefix(static_cast<size_t>(count));
    }
    return Status::done();
}

Status write_file(const std::string& path, std::string_view content) {
    return write(path, content, Disk::Wait);
}

Status write_file_unsynced(const std::string& path, std::string_view content) {
    return write(path, content, Disk::Later);
}

Status append_file(const std::string& path, std::string_view content) {
    const OpenFile file(::open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600));
    if (file.get() < 0) return failure(path, "written");
    struct stat before = {};
    if (::fstat(file.get(), &before) != 0) return failure(path, "written");
    const Status written = write_all(file, content, path);
    // Half a record at its end would hide those that follow.
    if (!written.ok() && ::ftruncate(file.get(), before.st_size) != 0) {
        return failure(path, "written");
    }
    return written;
}

Status sync_file(const std::string& path) {
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (file.get() < 0) return errno == ENOENT ? Status::done() : failure(path, "written");
    if (::fsync(file.get()) != 0) return failure(path, "written");
    return Status::done();
}

}  // namespace vagus
