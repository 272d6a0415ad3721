#pragma once
// Work shared among threads in numbered blocks; what a block computes must not depend on which thread takes it.
#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace tyndall {

/// Threads to use: `wanted`, or as many as the machine has when it is 0.
inline int thread_count(int wanted) {
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls work(block, thread) once for every block in [0, blocks), thread in [0, threads). Returns when all are done.
/// work must not throw.
inline void for_each_block(std::size_t blocks, int threads, const std::function<void(std::size_t, int)>& work) {
  std::atomic<std::size_t> next{0};
  const auto run = [&](int thread) {
    for (std::size_t block; (block = next.fetch_add(1)) < blocks;) work(block, thread);
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(run, i);
  run(0);
  for (std::thread& t : others) t.join();
}

}  // namespace tyndall
