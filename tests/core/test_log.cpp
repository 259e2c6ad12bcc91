#include "tests/captured_stderr.h"

#include "core/io/log.h"

#include <doctest/doctest.h>

#include <string>
#include <thread>
#include <vector>

using namespace cl;

namespace {

/// Sets the level for one test.
class ScopedLogLevel {
public:
    explicit ScopedLogLevel(LogLevel level) : before_(log_level()) { set_log_level(level); }
    ScopedLogLevel(const ScopedLogLevel&) = delete;
    ScopedLogLevel& operator=(const ScopedLogLevel&) = delete;
    ~ScopedLogLevel() { set_log_level(before_); }

private:
    LogLevel before_;
};

std::string all_levels_at(LogLevel level) {
    const ScopedLogLevel scope(level);
    const tests::CapturedStderr captured;
    log_debug("detail");
    log_info("progress");
    log_warning("odd {}");
    log_error("bad %s");
    return captured.text();
}

} // namespace

TEST_SUITE("core/io/log") {
    TEST_CASE("lines below the level are left out, and the text is printed as it is") {
        CHECK(all_levels_at(LogLevel::Debug) == "detail\nprogress\nwarning: odd {}\nerror: bad %s\n");
        CHECK(all_levels_at(LogLevel::Info) == "progress\nwarning: odd {}\nerror: bad %s\n");
        CHECK(all_levels_at(LogLevel::Warning) == "warning: odd {}\nerror: bad %s\n");
        CHECK(all_levels_at(LogLevel::Error) == "error: bad %s\n");
        CHECK(all_levels_at(LogLevel::Off) == "");
    }

    TEST_CASE("the level that was set is the level that is asked") {
        for (const LogLevel level :
             {LogLevel::Debug, LogLevel::Info, LogLevel::Warning, LogLevel::Error, LogLevel::Off}) {
            const ScopedLogLevel scope(level);
            CHECK(log_level() == level);
        }
    }

    TEST_CASE("a line that names its kind itself gets no prefix") {
        const ScopedLogLevel scope(LogLevel::Info);
        const tests::CapturedStderr captured;
        log_line(LogLevel::Warning, "a.tscn:3:1: warning: odd");
        CHECK(captured.text() == "a.tscn:3:1: warning: odd\n");
    }

    TEST_CASE("lines of several threads do not mix") {
        const ScopedLogLevel scope(LogLevel::Info);
        const tests::CapturedStderr captured;
        std::vector<std::thread> threads;
        for (const char letter : {'a', 'b', 'c'}) {
            threads.emplace_back([letter] {
                for (int i = 0; i < 50; ++i) {
                    log_info(std::string(200, letter));
                }
            });
        }
        for (std::thread& thread : threads) {
            thread.join();
        }
        const std::string text = captured.text();
        REQUIRE(text.size() == size_t{3 * 50 * 201});
        for (size_t line = 0; line < 150; ++line) {
            const std::string one = text.substr(line * 201, 201);
            CHECK(one == std::string(200, one[0]) + "\n");
        }
    }
}
