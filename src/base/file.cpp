// Reading and writing whole files with POSIX calls: see file.hpp.
#include "base/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

namespace vagus {
namespace {

constexpr size_t kReadBytes = 64u << 10;

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

Status fill(const std::string& beside, std::string_view content, mode_t rights,
            const std::string& path, int descriptor) {
    const OpenFile file(descriptor);
    const Status written = write_all(file, content, path);
    if (!written.ok()) return written;
    if (::fchmod(file.get(), rights) != 0) return failure(beside, "given its rights");
    // Without this a crash of the machine could leave the new name with no bytes in it.
    if (::fsync(file.get()) != 0) return failure(path, "written");
    return Status::done();
}

}  // namespace

Result<std::string> read_file(const std::string& path) {
    if (path == "-") return read_all(OpenFile(STDIN_FILENO), "standard input");
    const OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (file.get() < 0) return failure(path, "read");
    TRY(refuse_pipe(file, path));
    return read_all(file, path);
}

Status write_file(const std::string& path, std::string_view content) {
    const std::string target = final_path(path);
    if (!is_replaceable(target)) return write_through(path, content);
    std::string beside = target + ".XXXXXX";
    const int descriptor = ::mkostemp(beside.data(), O_CLOEXEC);
    if (descriptor < 0) return failure(path, "written");
    Status filled = fill(beside, content, rights_for(target), path, descriptor);
    if (filled.ok() && ::rename(beside.c_str(), target.c_str()) == 0) return Status::done();
    const Status failed = filled.ok() ? Status(failure(path, "written")) : filled;
    ::unlink(beside.c_str());
    return failed;
}

}  // namespace vagus
