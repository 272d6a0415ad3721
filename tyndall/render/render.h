#pragma once
// Making a picture of a scene.
#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tyndall/image/image.h"
#include "tyndall/render/film.h"
#include "tyndall/scene/geometry.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

struct RenderSettings {
  std::string integrator = "path";  // one of integrator_names
  int spp = 64;                     // samples per pixel at most, > 0
  double until_noise = 0.0;         // no more when SampleFilm::noise is not above this; 0: all spp (path only)
  double seconds = 0.0;             // no more after this long; 0: all spp
  int max_depth = 0;                // 0: no limit (path only)
  int threads = 0;                  // 0: all; the picture does not depend on it
  std::uint64_t seed = 1;
  std::uint32_t tile_order = 0;  // 0: by rows; otherwise shuffled by this number, with the same picture
};

struct RenderProgress {
  double fraction, seconds, noise;  // of what is asked for; of this run; SampleFilm::noise, 0 when unknown
  int spp;                          // samples that every pixel has
};

struct Tile;

/// The tiles of a pass that nobody has taken yet, for any number of threads.
struct TileSource {
  const std::vector<Tile>& tiles;
  int level;                                         // samples that their pixels shall have
  std::function<std::optional<std::size_t>()> take;  // the number of the next one
  std::function<bool()> empty;
};

/// Others who take tiles of a pass (ranks.h).
class TileHelpers {
 public:
  virtual ~TileHelpers() = default;
  /// Takes tiles until there are none, has their pixels brought to their level and puts them into the film. Called on a
  /// thread of its own while others work at other tiles; returns when every tile taken is back.
  virtual void work(const TileSource& source, SampleFilm& film) = 0;
};

/// What a caller wants while a picture is made. All are called from the calling thread.
struct RenderHooks {
  std::function<void(const RenderProgress&)> report;  // now and then
  /// Asked now and then whether there is use for the film as it is; if so, `save` gets it while no thread writes to it.
  std::function<bool()> wants_film;
  std::function<void(const SampleFilm&)> save;
  const std::atomic<bool>* stop = nullptr;  // no more samples once it is true
  TileHelpers* helpers = nullptr;
};

/// Adds samples to `film` (of the size scene.film) until every pixel has settings.spp, or another end is reached. The
/// film says what it has, so that work is stopped and gone on with at any sample; the sums are the same to the last bit
/// as if it had been done at once. With `seconds` pixels may differ by a pass in their number of samples. True where
/// it came to an end by itself.
bool render(const Scene& scene, const Geometry& geometry, const RenderSettings& settings, SampleFilm& film,
            const RenderHooks& hooks);

/// The film as a picture whose notes say how it was made; ended: render() has said so.
Image developed(const SampleFilm& film, const RenderSettings& settings, bool ended);

/// Both, from nothing. When `stop` becomes true the picture is returned as it is.
Image render(const Scene& scene, const Geometry& geometry, const RenderSettings& settings,
             const std::function<void(const RenderProgress&)>& report = {}, const std::atomic<bool>* stop = nullptr);

}  // namespace tyndall
