#include "core/threads.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <mutex>
#include <thread>
#include <vector>

using namespace cl;

TEST_SUITE("core/threads") {
    TEST_CASE("parallel_for covers every index exactly once, whatever the number of threads") {
        for (const int threads : {1, 3, 0}) {
            set_thread_count(threads);
            for (const size_t count : {size_t{0}, size_t{1}, size_t{1000}}) {
                for (const size_t grain : {size_t{0}, size_t{7}, size_t{5000}}) {
                    std::vector<std::atomic<int>> visits(count);
                    parallel_for(count, grain, [&](size_t begin, size_t end) {
                        for (size_t i = begin; i < end; ++i) {
                            ++visits[i];
                        }
                    });
                    bool once = true;
                    for (const std::atomic<int>& v : visits) {
                        once = once && v == 1;
                    }
                    CHECK(once);
                }
            }
        }
    }

    TEST_CASE("the thread count is what was set, and all cores for 0") {
        set_thread_count(1);
        CHECK(thread_count() == 1);
        set_thread_count(3);
        CHECK(thread_count() == 3);
        set_thread_count(0);
        CHECK(thread_count() >= 1);
    }

    TEST_CASE("with one thread all work is done by the caller") {
        set_thread_count(1);
        const std::thread::id caller = std::this_thread::get_id();
        bool elsewhere = false;
        parallel_for(1000, 1,
                     [&](size_t, size_t) { elsewhere = elsewhere || std::this_thread::get_id() != caller; });
        CHECK_FALSE(elsewhere);
        set_thread_count(0);
    }

    TEST_CASE("work that leaves one core is done in full, by one thread less than there are") {
        for (int count : {1, 2, 4}) {
            CAPTURE(count);
            set_thread_count(count);
            const std::thread::id caller = std::this_thread::get_id();
            std::atomic<size_t> done = 0;
            std::atomic<int> at_work = 0, most = 0;
            leave_one_core([&] {
                CHECK(std::this_thread::get_id() == caller);
                parallel_for(1000, 1, [&](size_t begin, size_t end) {
                    const int now = ++at_work;
                    for (int known = most; known < now && !most.compare_exchange_weak(known, now);) {
                    }
                    done += end - begin;
                    --at_work;
                });
            });
            CHECK(done == 1000);
            CHECK(most <= std::max(count - 1, 1));
        }
        set_thread_count(0);
    }

    TEST_CASE("jobs run one at a time, off the calling thread, in the order they were pushed") {
        std::vector<int> order; // not guarded: the queue is what keeps the jobs apart
        std::thread::id worker;
        WorkerQueue queue;
        for (int i = 0; i < 200; ++i) {
            queue.push([&, i] {
                order.push_back(i);
                worker = std::this_thread::get_id();
            });
        }
        queue.wait();
        REQUIRE(order.size() == 200);
        for (int i = 0; i < 200; ++i) {
            CHECK(order[static_cast<size_t>(i)] == i);
        }
        CHECK(worker != std::this_thread::get_id());
    }

    TEST_CASE("waiting for a while ends when the jobs do, or when the while does") {
        std::mutex held;
        WorkerQueue queue;
        CHECK(queue.wait_for(0.0)); // nothing was pushed
        held.lock();
        queue.push([&held] { const std::lock_guard lock(held); });
        CHECK_FALSE(queue.wait_for(1.0));
        held.unlock();
        CHECK(queue.wait_for(60000.0));
    }

    TEST_CASE("jobs may push jobs, and the queue ends only when all are done") {
        std::atomic<int> done{0};
        {
            WorkerQueue queue;
            queue.push([&] {
                queue.push([&] { ++done; });
                ++done;
            });
        }
        CHECK(done == 2);
        WorkerQueue never_used;
        never_used.wait();
    }
}
