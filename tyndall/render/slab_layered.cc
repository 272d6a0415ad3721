#include "tyndall/render/slab_layered.h"

#include "tyndall/medium/free_flight.h"
#include "tyndall/medium/scatter.h"
#include "tyndall/sampling/direction.h"
#include "tyndall/sampling/random_stream.h"

namespace tyndall {
namespace {

class LayeredSlab {
 public:
  LayeredSlab(const SlabRequest& request, const LoweredMedium& medium)
      : request_(request), medium_(medium), tally_(layered_tally_count(request.mu.size())) {}

  const std::vector<double>& trace(std::uint32_t replicate, std::uint32_t path) {
    std::fill(tally_.begin(), tally_.end(), 0.0);
    // "SLAB": apart from the numbers of pictures.
    const std::uint64_t sequence = std::uint64_t{0x534C4142u} << 32 | replicate;
    RandomStream random(request_.seed, sequence, path, RandomStream::Samples::even);
    const double mu0 = request_.diffuse ? std::sqrt(random.next()) : request_.mu0;
    Ray ray{{0.0, request_.thickness, 0.0}, {std::sqrt((1.0 - mu0) * (1.0 + mu0)), -mu0, 0.0}};
    Spectrum beta = Spectrum::grey(1.0);
    bool scattered = false;
    for (;;) {
      const bool down = ray.direction.y < 0.0;
      const double to_face = (down ? -ray.origin.y : request_.thickness - ray.origin.y) / ray.direction.y;
      stretches_along(medium_, ray, to_face, stretches_);
      const Flight flight = sample_flight(stretches_, beta, to_face, false, random.next(), random.next());
      beta *= flight.weight;
      if (flight.t < to_face) {
        scatter_.set(medium_, stretches_, flight.t);
        ray.origin = ray.at(flight.t);
        if (is_zero(beta * scatter_.scattering())) break;
        view(ray, beta, random.next());
        scatter_.aim(beta);
        const Deflection<double> d = scatter_.sample(random.next());
        beta *= scatter_.scattered(d) / scatter_.density(d);
        ray.direction = normalized(around(Frame::around(ray.direction), d.mu, d.sine(), random.next()));
        scattered = true;
      } else if (!down) {
        add(0, beta);
        break;
      } else {
        if (scattered) add(1, beta);
        if (request_.ground <= 0.0) break;
        beta *= request_.ground;
        view_ground(beta);
        ray = {{0.0, 0.0, 0.0}, sample_cosine({{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, random.next(), random.next())};
        scattered = true;
      }
      if (mean(beta) < 0.05) {
        if (random.next() >= 0.25) break;
        beta *= 4.0;
      }
    }
    return tally_;
  }

 private:
  void add(std::size_t group, const Spectrum& x) {
    for (std::size_t c = 0; c < channel_count; ++c) tally_[group * channel_count + c] += x[c];
  }

  /// Expected radiance out of both faces from a collision, at a random azimuth.
  void view(const Ray& ray, const Spectrum& beta, double xi) {
    for (std::size_t m = 0; m < request_.mu.size(); ++m) {
      const double mu = request_.mu[m];
      const Vector up = around({{1, 0, 0}, {0, 0, 1}, {0, 1, 0}}, mu, std::sqrt((1.0 - mu) * (1.0 + mu)), xi);
      for (int side = 0; side < 2; ++side) {
        const Vector out = side == 0 ? up : Vector{up.x, -up.y, up.z};
        const double path = (side == 0 ? request_.thickness - ray.origin.y : ray.origin.y) / mu;
        const Spectrum through = transmittance(medium_, {ray.origin, out}, path, scratch_);
        const Spectrum seen = scatter_.scattered(deflection_between(ray.direction, out)) * through;
        add(2 + 2 * m + static_cast<std::size_t>(side), beta * seen * (std::numbers::pi / mu));
      }
    }
  }

  void view_ground(const Spectrum& beta) {
    for (std::size_t m = 0; m < request_.mu.size(); ++m) {
      const double mu = request_.mu[m];
      const Ray up{{0.0, 0.0, 0.0}, {std::sqrt((1.0 - mu) * (1.0 + mu)), mu, 0.0}};
      add(2 + 2 * m, beta * transmittance(medium_, up, request_.thickness / mu, scratch_));
    }
  }

  const SlabRequest& request_;
  const LoweredMedium& medium_;
  std::vector<double> tally_;
  std::vector<Stretch> stretches_, scratch_;
  ScatterPoint scatter_;
};

}  // namespace

void trace_layered_slab(const SlabRequest& request, const LoweredMedium& medium, std::uint32_t first,
                        std::uint32_t count, std::uint32_t replicate_paths, double* sums) {
  LayeredSlab slab(request, medium);
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::vector<double>& tally = slab.trace((first + i) / replicate_paths, i % replicate_paths);
    double* const sum = sums + i / replicate_paths * tally.size();
    for (std::size_t k = 0; k < tally.size(); ++k) sum[k] += tally[k];
  }
}

}  // namespace tyndall
