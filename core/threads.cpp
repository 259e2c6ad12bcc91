#include "core/threads.h"

#include "core/assert.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace cl {

namespace {

using tbb::global_control;

std::unique_ptr<global_control>& thread_limit() {
    static std::unique_ptr<global_control> limit;
    return limit;
}

#ifdef __SANITIZE_THREAD__
/// The thread sanitizer does not see inside Debian's TBB, and takes all that its tasks hand over for races.
void for_on_plain_threads(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    constexpr size_t kThreads = 3;
    const size_t part = std::max(grain, (count + kThreads - 1) / kThreads);
    std::vector<std::thread> threads;
    for (size_t begin = 0; begin < count; begin += part) {
        threads.emplace_back([&body, begin, end = std::min(begin + part, count)] { body(begin, end); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}
#endif

} // namespace

void set_thread_count(int count) {
    CL_ASSERT(count >= 0, "a negative number of threads");
    thread_limit().reset(); // two limits at once would give the smaller one
    if (count > 0) {
        thread_limit() = std::make_unique<global_control>(global_control::max_allowed_parallelism,
                                                          static_cast<size_t>(count));
    }
}

int thread_count() {
    return static_cast<int>(global_control::active_value(global_control::max_allowed_parallelism));
}

void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
    if (count == 0) {
        return;
    }
    grain = std::max<size_t>(grain, 1);
#ifdef __SANITIZE_THREAD__
    for_on_plain_threads(count, grain, body);
#else
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, grain),
                      [&body](const tbb::blocked_range<size_t>& part) { body(part.begin(), part.end()); });
#endif
}

void leave_one_core(const std::function<void()>& f) {
    tbb::task_arena arena(std::max(thread_count() - 1, 1));
    arena.execute(f);
}

/// One plain thread: a task scheduler would be free to run jobs side by side or not at all.
struct WorkerQueue::Impl {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<std::function<void()>> jobs; // the front one is running
    bool stopping = false;
    std::thread thread;

    void run() {
        std::unique_lock lock(mutex);
        for (;;) {
            changed.wait(lock, [this] { return stopping || !jobs.empty(); });
            if (jobs.empty()) {
                return;
            }
            std::function<void()> job = std::move(jobs.front()); // its empty place stays until it is done
            lock.unlock();
            job();
            job = nullptr; // what it holds may push when it goes
            lock.lock();
            jobs.pop_front();
            changed.notify_all();
        }
    }
};

WorkerQueue::WorkerQueue() : impl_(std::make_unique<Impl>()) {}

WorkerQueue::~WorkerQueue() {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->stopping = true;
    }
    impl_->changed.notify_all();
    if (impl_->thread.joinable()) {
        impl_->thread.join();
    }
}

void WorkerQueue::push(std::function<void()> job) {
    {
        const std::lock_guard lock(impl_->mutex);
        impl_->jobs.push_back(std::move(job));
        if (!impl_->thread.joinable()) { // no thread for a queue that is never used
            impl_->thread = std::thread([impl = impl_.get()] { impl->run(); });
        }
    }
    impl_->changed.notify_all();
}

void WorkerQueue::wait() {
    std::unique_lock lock(impl_->mutex);
    CL_ASSERT(std::this_thread::get_id() != impl_->thread.get_id(), "a job waits for its own queue");
    impl_->changed.wait(lock, [this] { return impl_->jobs.empty(); });
}

bool WorkerQueue::wait_for(double most_ms) {
    std::unique_lock lock(impl_->mutex);
    CL_ASSERT(std::this_thread::get_id() != impl_->thread.get_id(), "a job waits for its own queue");
    const std::chrono::duration<double, std::milli> most(most_ms);
    return impl_->changed.wait_for(lock, most, [this] { return impl_->jobs.empty(); });
}

} // namespace cl
