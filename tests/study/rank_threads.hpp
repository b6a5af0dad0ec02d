#pragma once

#include <barrier>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "study/crew.hpp"

namespace probewright::study::testing {

/// Calls `work` for each of `size` ranks, each on a thread of its own; what they exchange goes from thread to thread,
/// without MPI. Returns once all have ended.
inline void onRankThreads(int size, const std::function<void(const Ranks&)>& work) {
  std::barrier everybody(size);
  std::vector<std::string> board(static_cast<std::size_t>(size));
  std::vector<std::thread> threads;
  for (int rank = 0; rank < size; ++rank) {
    threads.emplace_back([&, rank] {
      work({rank, size, [&, rank](const std::string& mine) {
              board[static_cast<std::size_t>(rank)] = mine;
              everybody.arrive_and_wait();
              const std::vector<std::string> all = board;
              everybody.arrive_and_wait();
              return all;
            }});
    });
  }
  for (std::thread& thread : threads)
    thread.join();
}

}  // namespace probewright::study::testing
