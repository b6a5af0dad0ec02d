#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace probewright::simulation {

/// Does `work(i)` for all i below `count`, in any order, on as many cores as there are; `worthAThread` is how many it
/// takes to be worth another thread. If some of them throw, the exception of the lowest i is thrown again.
template <class Work>
void inParallel(std::size_t count, std::size_t worthAThread, const Work& work) {
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  std::size_t failedAt = count;
  std::exception_ptr failure;
  const auto some = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        work(i);
      } catch (...) {
        const std::scoped_lock lock(mutex);
        if (i < failedAt) {
          failedAt = i;
          failure = std::current_exception();
        }
      }
    }
  };
  {
    const std::size_t threads = std::min<std::size_t>(std::thread::hardware_concurrency(), 1 + count / worthAThread);
    std::vector<std::jthread> others;
    for (std::size_t i = 1; i < threads; ++i)
      others.emplace_back(some);
    some();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace probewright::simulation
