#pragma once
// Work shared among threads in numbered blocks; what a block computes must not depend on which thread takes it.
#if defined(__linux__)
#include <sched.h>
#endif

#include <algorithm>
#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace tyndall {

/// Threads to use: `wanted`, or as many as there are processors that this process may run on when it is 0 (taskset,
/// mpirun's binding).
inline int thread_count(int wanted) {
  if (wanted > 0) return wanted;
#if defined(__linux__)
  cpu_set_t mine;
  if (sched_getaffinity(0, sizeof mine, &mine) == 0) return std::max(1, CPU_COUNT(&mine));
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

/// Calls work(block, thread) for the blocks from `next` on, below `blocks`, thread in [0, threads); others may take
/// blocks from `next` as well. Returns when those taken here are done. work must not throw.
inline void take_blocks(std::atomic<std::size_t>& next, std::size_t blocks, int threads,
                        const std::function<void(std::size_t, int)>& work) {
  const auto run = [&](int thread) {
    for (std::size_t block; (block = next.fetch_add(1)) < blocks;) work(block, thread);
  };
  std::vector<std::thread> others;
  for (int i = 1; i < threads; ++i) others.emplace_back(run, i);
  run(0);
  for (std::thread& t : others) t.join();
}

/// Calls work(block, thread) once for every block in [0, blocks).
inline void for_each_block(std::size_t blocks, int threads, const std::function<void(std::size_t, int)>& work) {
  std::atomic<std::size_t> next{0};
  take_blocks(next, blocks, threads, work);
}

}  // namespace tyndall
