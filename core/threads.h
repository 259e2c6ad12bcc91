#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace cl {

/// Number of worker threads for everything in the process; 0 = all cores. Call before the first parallel
/// work.
void set_thread_count(int count);
[[nodiscard]] int thread_count();

/// Calls body(begin, end) on disjoint ranges that cover [0, count), on all workers; returns when all are
/// done. The split depends on timing: results must not.
void parallel_for(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body);

/// Calls f(i) for i in [0, count) on all workers, in no order; each call is worth a task of its own.
template <typename F>
void parallel_for_each(size_t count, const F& f) {
    parallel_for(count, 1, [&f](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) {
            f(i);
        }
    });
}

/// Calls f on this thread; parallel work in it leaves one core to whoever draws meanwhile, where there are
/// two or more.
void leave_one_core(const std::function<void()>& f);

/// One job at a time off the calling thread, in the order they were pushed.
class WorkerQueue {
public:
    WorkerQueue();
    WorkerQueue(const WorkerQueue&) = delete;
    WorkerQueue& operator=(const WorkerQueue&) = delete;
    ~WorkerQueue(); ///< waits for the jobs that were pushed
    void push(std::function<void()> job);
    void wait(); ///< until all pushed jobs are done
    /// ... or so much time has passed. @return whether they are
    bool wait_for(double most_ms);

private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace cl
