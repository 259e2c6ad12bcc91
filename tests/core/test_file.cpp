#include "tests/temporary_dir.h"

#include "core/io/file.h"

#include <doctest/doctest.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

using namespace cl;
namespace fs = std::filesystem;

namespace {

size_t count_files(const fs::path& folder) {
    return static_cast<size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

fs::perms permissions(const fs::path& path) {
    return fs::status(path).permissions();
}

} // namespace

TEST_SUITE("core/io/file") {
    TEST_CASE("what was written is read back, byte for byte") {
        const tests::TemporaryDir dir;
        const std::string bytes("a\0\r\n\xff", 5);
        REQUIRE(write_file_atomic(dir / "f", bytes));
        CHECK(*read_text_file(dir / "f") == bytes);
        CHECK(read_binary_file(dir / "f")->size() == 5);
        REQUIRE(write_file_atomic(dir / "f", ""));
        CHECK(read_text_file(dir / "f")->empty());
    }

    TEST_CASE("a file that cannot be read is named with the reason, in one line") {
        const tests::TemporaryDir dir;
        const auto error = [&](const fs::path& path, uint64_t limit = 100) {
            const Expected<std::string> text = read_text_file(path, limit);
            return text ? std::string("no error") : text.error().to_string();
        };
        const std::string at = dir.path().string();
        CHECK(error(dir / "none") == at + "/none: error: expected a file, found none");
        CHECK(error(dir.path()) == at + ": error: expected a file, found a directory");
        REQUIRE(write_file_atomic(dir / "big", std::string(101, 'x')));
        CHECK(error(dir / "big") == at + "/big: error: expected at most 100 bytes, found 101");
        CHECK(error(dir / "big", 101) == "no error");
        CHECK(error(dir / "big/child") == at + "/big/child: error: expected a file, found none");
        REQUIRE(::mkfifo((dir / "pipe").c_str(), 0600) == 0); // opening it must not wait for a writer
        CHECK(error(dir / "pipe") ==
              at + "/pipe: error: expected a regular file, found a device, pipe or socket");
        CHECK(error("/dev/zero") ==
              "/dev/zero: error: expected a regular file, found a device, pipe or socket");
    }

    TEST_CASE("a file without permission can neither be read nor replaced") {
        const tests::TemporaryDir dir;
        REQUIRE(write_file_atomic(dir / "f", "old"));
        fs::permissions(dir.path(), fs::perms::all);
        fs::permissions(dir / "f", fs::perms::none);
        const bool is_root = ::geteuid() == 0; // root may do everything: be nobody for a moment
        REQUIRE((!is_root || ::seteuid(65534) == 0));
        const Expected<std::string> text = read_text_file(dir / "f");
        const Status written = write_file_atomic(dir / "f", "new");
        REQUIRE((!is_root || ::seteuid(0) == 0));
        REQUIRE_FALSE(text);
        CHECK(text.error().message == "cannot read: Permission denied");
        REQUIRE_FALSE(written);
        CHECK(written.error().message == "cannot write: Permission denied");
        fs::permissions(dir / "f", fs::perms::owner_all);
        CHECK(*read_text_file(dir / "f") == "old");
        CHECK(count_files(dir.path()) == 1);
    }

    TEST_CASE("replacing a file keeps its permissions and leaves nothing beside it") {
        const tests::TemporaryDir dir;
        REQUIRE(write_file_atomic(dir / "f", "old"));
        const fs::perms mode = fs::perms::owner_read | fs::perms::owner_write | fs::perms::others_read;
        fs::permissions(dir / "f", mode);
        REQUIRE(write_file_atomic(dir / "f", "new"));
        CHECK(*read_text_file(dir / "f") == "new");
        CHECK(permissions(dir / "f") == mode);
        CHECK(count_files(dir.path()) == 1);
    }

    TEST_CASE("a new file has the permissions that the umask leaves") {
        const tests::TemporaryDir dir;
        const mode_t old_mask = ::umask(027);
        const bool written = write_file_atomic(dir / "f", "x").ok();
        ::umask(old_mask);
        REQUIRE(written);
        CHECK(permissions(dir / "f") == static_cast<fs::perms>(0640));
    }

    TEST_CASE("a reader that has the old file open keeps the whole old file") {
        const tests::TemporaryDir dir;
        REQUIRE(write_file_atomic(dir / "f", "old content"));
        std::ifstream reader(dir / "f");
        REQUIRE(write_file_atomic(dir / "f", "new"));
        CHECK(std::string(std::istreambuf_iterator<char>(reader), {}) == "old content");
    }

    TEST_CASE("a symbolic link stays one, and the file it leads to is written") {
        const tests::TemporaryDir dir;
        fs::create_directory(dir / "sub");
        REQUIRE(write_file_atomic(dir / "sub/target", "old"));
        fs::create_symlink("sub/target", dir / "link");
        fs::create_symlink(dir / "link", dir / "link2");
        REQUIRE(write_file_atomic(dir / "link2", "new"));
        CHECK(fs::is_symlink(dir / "link"));
        CHECK(fs::is_symlink(dir / "link2"));
        CHECK(*read_text_file(dir / "sub/target") == "new");

        fs::create_symlink("sub/made", dir / "dangling");
        REQUIRE(write_file_atomic(dir / "dangling", "made"));
        CHECK(*read_text_file(dir / "sub/made") == "made");
    }

    TEST_CASE("a write that fails leaves the old file and nothing else") {
        const tests::TemporaryDir dir;
        const std::string at = dir.path().string();
        const auto error = [](const fs::path& path) {
            const Status status = write_file_atomic(path, "new");
            return status ? std::string("no error") : status.error().to_string();
        };
        fs::create_directory(dir / "folder");
        CHECK(error(dir / "folder") ==
              at + "/folder: error: cannot write: expected a file, found a directory");
        CHECK(error(dir / "none/f") ==
              at + "/none/f: error: cannot write: there is no folder \"" + at + "/none\"");
        fs::create_symlink("loop", dir / "loop");
        CHECK(error(dir / "loop") == at + "/loop: error: cannot write: too many symbolic links");
        CHECK(count_files(dir.path()) == 2);
        CHECK(count_files(dir / "folder") == 0);
    }

    TEST_CASE("when the disk is full the old file stays and the new one's rest is removed") {
        // A file size limit stands in for the full disk: write() fails half way.
        const tests::TemporaryDir dir;
        REQUIRE(write_file_atomic(dir / "f", "old"));
        const pid_t child = ::fork();
        if (child == 0) {
            ::signal(SIGXFSZ, SIG_IGN);
            const rlimit limit{4096, 4096};
            ::setrlimit(RLIMIT_FSIZE, &limit);
            const bool failed = !write_file_atomic(dir / "f", std::string(100000, 'x'));
            ::_exit(failed ? 0 : 1);
        }
        int status = -1;
        ::waitpid(child, &status, 0);
        CHECK(status == 0);
        CHECK(*read_text_file(dir / "f") == "old");
        CHECK(count_files(dir.path()) == 1);
    }

    TEST_CASE("a device is written to, not replaced") {
        REQUIRE(write_file_atomic("/dev/null", "x"));
        CHECK(fs::is_character_file("/dev/null"));
    }
}
