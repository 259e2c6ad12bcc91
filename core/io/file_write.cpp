#include "core/io/file.h"
#include "core/io/posix_file.h"

#include <fmt/core.h>

#include <atomic>
#include <cerrno>
#include <fcntl.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace cl {

namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40; // as Linux follows
constexpr int kMaxNameTries = 1000;

Error write_error(const fs::path& path, std::string message) {
    return {ErrorCode::IoError, std::move(message), {path.string()}};
}

/// Where the symbolic links at `path` lead; the file itself need not exist.
Expected<fs::path> follow_links(const fs::path& path) {
    fs::path target = path;
    for (int i = 0; i < kMaxLinks; ++i) {
        std::error_code ec;
        if (!fs::is_symlink(fs::symlink_status(target, ec))) {
            return target;
        }
        const fs::path next = fs::read_symlink(target, ec);
        if (ec) {
            return write_error(path, "cannot write: " + ec.message());
        }
        target = target.parent_path() / next; // an absolute `next` replaces the folder
    }
    return write_error(path, "cannot write: too many symbolic links");
}

bool write_all(int fd, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t done = ::write(fd, bytes.data(), bytes.size());
        if (done < 0 && errno == EINTR) {
            continue;
        }
        if (done < 0) {
            return false;
        }
        bytes.remove_prefix(static_cast<size_t>(done));
    }
    return true;
}

/// A new file beside the target, removed again unless it was renamed over it.
class TemporaryFile {
public:
    explicit TemporaryFile(const fs::path& folder) {
        // Not mkstemp(): this way the kernel applies the umask, which cannot be read without setting it.
        static std::atomic<unsigned> counter{0};
        for (int i = 0; i < kMaxNameTries && !file_.is_open(); ++i) {
            path_ = folder / fmt::format(".conelight-{}-{}.tmp", ::getpid(), counter++);
            file_ = FileDescriptor(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
            if (!file_.is_open() && errno != EEXIST) {
                return;
            }
        }
        exists_ = file_.is_open();
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        if (exists_) {
            ::unlink(path_.c_str());
        }
    }

    [[nodiscard]] bool is_open() const noexcept { return file_.is_open(); }

    /// Takes over owner and permissions of the file that will be replaced.
    [[nodiscard]] bool take_after(const struct stat& old) {
        // Only root may give files away, and need not succeed everywhere: the permissions matter more.
        [[maybe_unused]] const int owned = ::fchown(file_.get(), old.st_uid, old.st_gid);
        return ::fchmod(file_.get(), old.st_mode & 07777) == 0;
    }

    /// False, with errno set, when a step fails.
    [[nodiscard]] bool commit(std::string_view bytes, const fs::path& target) {
        if (!write_all(file_.get(), bytes) || ::fsync(file_.get()) != 0 || !file_.close() ||
            ::rename(path_.c_str(), target.c_str()) != 0) {
            return false;
        }
        exists_ = false;
        return true;
    }

private:
    fs::path path_;
    FileDescriptor file_{-1};
    bool exists_ = false;
};

/// Makes the rename itself survive a power cut. Not every file system can; the content is safe either way.
void sync_folder(const fs::path& folder) {
    const FileDescriptor dir(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (dir.is_open()) {
        [[maybe_unused]] const int synced = ::fsync(dir.get());
    }
}

/// /dev/null and the like have no content to replace.
Status write_device(const fs::path& path, std::string_view bytes) {
    FileDescriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (!file.is_open() || !write_all(file.get(), bytes) || !file.close()) {
        return write_error(path, "cannot write: " + errno_text());
    }
    return {};
}

/// The file that is there now; empty if there is none.
Expected<std::optional<struct stat>> existing_file(const fs::path& target) {
    struct stat status {};
    if (::stat(target.c_str(), &status) != 0) {
        if (errno == ENOENT) {
            return std::optional<struct stat>();
        }
        return write_error(target, "cannot write: " + errno_text());
    }
    if (S_ISDIR(status.st_mode)) {
        return write_error(target, "cannot write: expected a file, found a directory");
    }
    if (!S_ISREG(status.st_mode) && !S_ISCHR(status.st_mode)) {
        return write_error(target, "cannot write: expected a regular file, found a device, pipe or socket");
    }
    if (::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) !=
        0) { // renaming over a read-only file would succeed
        return write_error(target, "cannot write: " + errno_text());
    }
    return std::optional<struct stat>(status);
}

} // namespace

Status write_file_atomic(const fs::path& path, std::string_view bytes) {
    const Expected<fs::path> target = follow_links(path);
    if (!target) {
        return target.error();
    }
    const Expected<std::optional<struct stat>> old = existing_file(*target);
    if (!old) {
        return old.error();
    }
    if (*old && S_ISCHR((*old)->st_mode)) {
        return write_device(*target, bytes);
    }
    const fs::path folder = target->has_parent_path() ? target->parent_path() : fs::path(".");
    TemporaryFile temporary(folder);
    if (!temporary.is_open()) {
        const std::string reason = errno == ENOENT || errno == ENOTDIR
                                       ? fmt::format("there is no folder \"{}\"", folder.string())
                                       : errno_text();
        return write_error(path, "cannot write: " + reason);
    }
    if ((*old && !temporary.take_after(**old)) || !temporary.commit(bytes, *target)) {
        return write_error(path, "cannot write: " + errno_text());
    }
    sync_folder(folder);
    return {};
}

} // namespace cl
