#include "core/string_name.h"

#include <doctest/doctest.h>

#include <thread>
#include <unordered_set>
#include <vector>

namespace cl {

TEST_SUITE("core/string_name") {
    TEST_CASE("equal texts give equal names and hashes, whatever they were made from") {
        const std::string text = "translation";
        const StringName a(text), b("translation"), c(std::string_view("translation (m)").substr(0, 11));
        CHECK(a == b);
        CHECK(b == c);
        CHECK(&a.str() == &c.str());
        CHECK(std::hash<StringName>{}(a) == std::hash<StringName>{}(c));
        CHECK_FALSE(a == StringName("rotation"));
    }

    TEST_CASE("a default name is the empty text") {
        CHECK(StringName().empty());
        CHECK(StringName() == StringName(""));
    }

    TEST_CASE("names sort by their text, not by when they were first seen") {
        const StringName late("zzz-first-seen"), early("aaa-seen-later");
        CHECK(early < late);
        CHECK_FALSE(late < early);
    }

    TEST_CASE("threads that intern the same texts at once agree on the names") {
        constexpr int kThreads = 4, kNames = 500;
        std::vector<std::vector<StringName>> names(kThreads);
        std::vector<std::thread> threads;
        for (int t = 0; t < kThreads; t++) {
            threads.emplace_back([&names, t] {
                for (int i = 0; i < kNames; i++) {
                    names[static_cast<size_t>(t)].emplace_back("thread-name-" + std::to_string(i));
                }
            });
        }
        for (std::thread& thread : threads) {
            thread.join();
        }
        for (int t = 1; t < kThreads; t++) {
            CHECK(names[static_cast<size_t>(t)] == names[0]);
        }
        const std::unordered_set<StringName> distinct(names[0].begin(), names[0].end());
        CHECK(distinct.size() == kNames);
    }
}

} // namespace cl
