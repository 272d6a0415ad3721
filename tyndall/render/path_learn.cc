// Learning where a picture's sunlight comes in, before it is made.
#include "tyndall/render/camera.h"
#include "tyndall/render/parallel.h"
#include "tyndall/render/path_prepared.h"

namespace tyndall {

void PathContext::learn(const CameraRays& camera, const Film& film, std::uint64_t paths, std::uint64_t seed,
                        int threads) {
  constexpr std::uint64_t block_paths = 256;
  constexpr std::uint64_t other_stream = 0x9E3779B97F4A7C15;  // the picture's own paths must not know these
  if (prepared_->lights.suns.empty() || prepared_->scene.meshes.empty()) return;
  const std::uint64_t blocks = paths / block_paths;
  std::vector<std::vector<SunLesson>> found(blocks);
  std::vector<std::uint64_t> tries(blocks);
  for_each_block(blocks, thread_count(threads), [&](std::size_t block, int) {
    PathTracer tracer(*this);
    tracer.teach(found[block]);
    for (std::uint64_t i = block * block_paths; i < (block + 1) * block_paths; ++i) {
      RandomStream random(seed + other_stream, 0, static_cast<std::uint32_t>(i), RandomStream::Samples::even);
      const double x = random.next() * film.width, y = random.next() * film.height;
      tracer.trace(camera.through(x, y), infinity, random);
    }
    tries[block] = tracer.sun_tries();
  });
  std::vector<SunLesson> lessons;
  std::uint64_t all_tries = 0;
  for (std::size_t block = 0; block < blocks; ++block) {  // in order, for the same sums whoever found them
    lessons.insert(lessons.end(), found[block].begin(), found[block].end());
    all_tries += tries[block];
  }
  const auto suns = static_cast<std::uint32_t>(prepared_->lights.suns.size());
  std::vector<SunBeams> beams;
  for (std::uint32_t i = 0; i < suns; ++i) beams.emplace_back(prepared_->scene, i, lessons, all_tries / suns);
  if (std::ranges::any_of(beams, &SunBeams::useful)) prepared_->beams = std::move(beams);
}

}  // namespace tyndall
