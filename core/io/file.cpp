#include "core/io/file.h"

#include "core/io/posix_file.h"

#include <fmt/core.h>

#include <cerrno>
#include <fcntl.h>
#include <new>
#include <sys/stat.h>
#include <unistd.h>

namespace cl {

namespace {

Error read_error(const std::filesystem::path& path, ErrorCode code, std::string message) {
    return {code, std::move(message), {path.string()}};
}

/// An open regular file and its size, or why there is none.
struct OpenFile {
    FileDescriptor file;
    uint64_t size = 0;
};

Expected<OpenFile> open_for_reading(const std::filesystem::path& path, uint64_t max_bytes) {
    // Without O_NONBLOCK opening a FIFO would wait for a writer.
    FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    if (!file.is_open()) {
        const bool missing = errno == ENOENT || errno == ENOTDIR;
        return read_error(path, missing ? ErrorCode::NotFound : ErrorCode::IoError,
                          missing ? "expected a file, found none" : "cannot read: " + errno_text());
    }
    struct stat status {};
    if (::fstat(file.get(), &status) != 0) {
        return read_error(path, ErrorCode::IoError, "cannot read: " + errno_text());
    }
    if (!S_ISREG(status.st_mode)) {
        return read_error(path, ErrorCode::IoError,
                          S_ISDIR(status.st_mode)
                              ? "expected a file, found a directory"
                              : "expected a regular file, found a device, pipe or socket");
    }
    const auto size = static_cast<uint64_t>(status.st_size);
    if (size > max_bytes) {
        return read_error(path, ErrorCode::OutOfMemory,
                          fmt::format("expected at most {} bytes, found {}", max_bytes, size));
    }
    return OpenFile{std::move(file), size};
}

template <typename Buffer>
Expected<Buffer> read_file(const std::filesystem::path& path, uint64_t max_bytes) {
    Expected<OpenFile> open = open_for_reading(path, max_bytes);
    if (!open) {
        return open.error();
    }
    Buffer buffer;
    try {
        buffer.resize(open->size);
    } catch (const std::bad_alloc&) {
        return read_error(path, ErrorCode::OutOfMemory, fmt::format("no memory for {} bytes", open->size));
    }
    size_t done = 0;
    while (done < buffer.size()) {
        const ssize_t got = ::read(open->file.get(), buffer.data() + done, buffer.size() - done);
        if (got < 0 && errno == EINTR) {
            continue;
        }
        if (got < 0) {
            return read_error(path, ErrorCode::IoError, "cannot read: " + errno_text());
        }
        if (got == 0) { // the file shrank since fstat()
            buffer.resize(done);
            break;
        }
        done += static_cast<size_t>(got);
    }
    return buffer;
}

} // namespace

Expected<std::string> read_text_file(const std::filesystem::path& path, uint64_t max_bytes) {
    return read_file<std::string>(path, max_bytes);
}

Expected<std::vector<uint8_t>> read_binary_file(const std::filesystem::path& path, uint64_t max_bytes) {
    return read_file<std::vector<uint8_t>>(path, max_bytes);
}

} // namespace cl
