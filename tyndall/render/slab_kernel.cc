// Paths through a homogeneous slab, many at a time. Only the cosine to the axis matters: a deflection {mu, sin} at
// azimuth phi turns c into c mu + sqrt(1 - c^2) sin cos(phi).
#include "tyndall/render/slab_kernel.h"

#include <vector>

#include "tyndall/number/lanes.h"
#include "tyndall/phase/law.h"

namespace tyndall {
namespace TYNDALL_KERNEL_NAMESPACE {

constexpr int width = static_cast<int>(Lanes::size);

/// A number per lane, for what is done lane by lane.
struct alignas(64) PerLane {
  float value[width];
  Lanes load() const { return Lanes::load_aligned(value); }
  void store(const Lanes& x) { x.store_aligned(value); }
};

/// Generating vector of a rank-1 lattice of 2^10 points, found component by component (Sloan and Reztsov 2002): each
/// minimises the worst-case error P_2 with product weights 1, 1/2, 1/3, .. in order of importance: distances and
/// deflections of the first flights, then azimuths, then roulette. Rows are calls of LaneRandom, columns its words.
constexpr int lattice_calls = 4;
constexpr std::uint32_t lattice[lattice_calls][4] = {
    {1, 275, 175, 363}, {167, 403, 381, 139}, {317, 301, 419, 211}, {113, 337, 157, 373}};

/// Random numbers of `width` paths at once: four per call, each in (0, 1) with 23 bits, so that 1 - x is never 0. The
/// first calls of the paths of a replicate give the points of a lattice under one random shift (Cranley and Patterson
/// 1976): every path alone is as random as an independent one, but together they leave no part of the space out.
struct LaneRandom {
  alignas(64) std::uint32_t path[width], call[width];
  std::uint32_t key[2];
  std::uint32_t replicate_paths;

  void next(Lanes (&out)[4]) {
    const std::uint32_t within = replicate_paths - 1, spacing = ~std::uint32_t{0} / replicate_paths + 1;
    alignas(64) std::uint32_t c[4][width], step[4][width];
    for (int i = 0; i < width; ++i) {
      // 0 beyond the lattice; with one path per replicate there is nothing to spread.
      const std::uint32_t even = call[i] < lattice_calls ? ~std::uint32_t{0} : 0;
      const std::uint32_t place = even & ((path[i] & within) * spacing);
      for (int w = 0; w < 4; ++w) {
        std::uint32_t generator = lattice[0][w];
        for (std::uint32_t k = 1; k < lattice_calls; ++k) generator = call[i] == k ? lattice[k][w] : generator;
        step[w][i] = place * generator;
      }
      c[0][i] = call[i]++;
      c[1][i] = path[i] & ~(even & within);
      c[2][i] = 0x534C4142u;  // "SLAB": apart from the numbers of pictures
      c[3][i] = 0;
    }
    std::uint32_t k0 = key[0], k1 = key[1];
    for (int round = 0; round < 10; ++round) {
      for (int i = 0; i < width; ++i) {
        const std::uint64_t a = std::uint64_t{0xD2511F53u} * c[0][i], b = std::uint64_t{0xCD9E8D57u} * c[2][i];
        c[0][i] = static_cast<std::uint32_t>(b >> 32) ^ c[1][i] ^ k0;
        c[2][i] = static_cast<std::uint32_t>(a >> 32) ^ c[3][i] ^ k1;
        c[1][i] = static_cast<std::uint32_t>(b);
        c[3][i] = static_cast<std::uint32_t>(a);
      }
      k0 += 0x9E3779B9u;
      k1 += 0xBB67AE85u;
    }
    for (int w = 0; w < 4; ++w) {
      PerLane x;
      for (int i = 0; i < width; ++i) x.value[i] = (static_cast<float>((c[w][i] + step[w][i]) >> 9) + 0.5f) * 0x1p-23f;
      out[w] = x.load();
    }
  }
};

class Slab {
 public:
  Slab(const SlabTask& task, double* sums) : task_(task), sums_(sums) {
    for (int i = 0; i < task.lobe_count; ++i) lobes_.push_back(lobe_of<Lanes>(task.lobes[i].lobe));
    tallies_.resize(slab_tally_count(task.mu_count));
    random_.key[0] = static_cast<std::uint32_t>(task.seed);
    random_.key[1] = static_cast<std::uint32_t>(task.seed >> 32);
    random_.replicate_paths = task.replicate_paths;
  }

  void run() {
    const std::uint32_t end = task_.first_path + task_.path_count;
    std::uint32_t next_path = task_.first_path;
    LaneMask fresh = Lanes(0.0f) == Lanes(0.0f), idle = fresh;
    unsigned live = 0;
    for (int i = 0; i < width; ++i) {
      random_.path[i] = next_path;
      random_.call[i] = 0;
      if (next_path < end) ++next_path, live |= 1u << i;
    }
    start(fresh);
    idle = mask_of(~live);
    Lanes xi[4];
    while (live != 0) {
      random_.next(xi);
      step(xi, idle);
      // Lanes whose path is over hand in their tallies and take the next path.
      const unsigned done = bits(done_) & live;
      if (done == 0) continue;
      unsigned started = 0;
      for (int i = 0; i < width; ++i) {
        if (!(done >> i & 1u)) continue;
        hand_in(i);
        if (next_path < end) {
          random_.path[i] = next_path++;
          random_.call[i] = 0;
          started |= 1u << i;
        } else {
          live &= ~(1u << i);
        }
      }
      start(mask_of(started));
      for (Lanes& t : tallies_) t = xsimd::select(mask_of(done), Lanes(0.0f), t);
      idle = mask_of(~live);
    }
  }

 private:
  static LaneMask mask_of(unsigned set) {
    PerLane x;
    for (int i = 0; i < width; ++i) x.value[i] = (set >> i & 1u) ? 1.0f : 0.0f;
    return x.load() > Lanes(0.5f);
  }
  static unsigned bits(const LaneMask& mask) {
    PerLane x;
    x.store(xsimd::select(mask, Lanes(1.0f), Lanes(0.0f)));
    unsigned set = 0;
    for (int i = 0; i < width; ++i) set |= x.value[i] != 0.0f ? 1u << i : 0u;
    return set;
  }

  /// Puts new paths on the face: beta = 1, depth 0; a diffuse face gives mu = sqrt(xi).
  void start(const LaneMask& fresh) {
    Lanes mu(task_.mu0);
    if (task_.mu0 == 0.0f) {
      // The path's own first numbers; only fresh lanes may use them up.
      alignas(64) std::uint32_t before[width];
      for (int i = 0; i < width; ++i) before[i] = random_.call[i];
      Lanes xi[4];
      random_.next(xi);
      const unsigned set = bits(fresh);
      for (int i = 0; i < width; ++i) {
        if (!(set >> i & 1u)) random_.call[i] = before[i];
      }
      mu = xsimd::sqrt(xi[0]);
    }
    z_ = xsimd::select(fresh, Lanes(0.0f), z_);
    cosine_ = xsimd::select(fresh, mu, cosine_);
    scattered_ = xsimd::select(fresh, Lanes(0.0f), scattered_);
    beta_ = xsimd::select(fresh, Lanes(1.0f), beta_);
  }

  /// One flight and what ends it: leaving the top, the ground, or a collision.
  void step(const Lanes (&xi)[4], const LaneMask& idle) {
    const Lanes zero(0.0f), one(1.0f), depth(task_.depth);
    const LaneMask down = cosine_ > zero;
    const Lanes to_face = xsimd::select(down, depth - z_, z_) / xsimd::max(xsimd::abs(cosine_), Lanes(1e-12f));
    const Lanes flight = -xsimd::log(xi[0]);
    const LaneMask collides = flight < to_face;
    if (task_.mu_count > 0 && task_.lobe_count > 0) view(to_face, xi[2], idle);
    beta_ = beta_ * xsimd::select(collides, Lanes(task_.albedo), one);
    z_ = xsimd::select(collides, xsimd::max(zero, xsimd::min(depth, z_ + cosine_ * flight)), z_);

    LaneMask off = (beta_ <= zero) | idle;
    const LaneMask leaves = !collides, up = !down, top = leaves & up, bottom = leaves & down;
    tallies_[0] = tallies_[0] + xsimd::select(top, beta_, zero);
    tallies_[1] = tallies_[1] + xsimd::select(bottom, beta_ * scattered_, zero);
    off = off | top;
    if (task_.ground > 0.0f) {
      z_ = xsimd::select(bottom, depth, z_);
      cosine_ = xsimd::select(bottom, -xsimd::sqrt(xi[1]), cosine_);
      scattered_ = xsimd::select(bottom, one, scattered_);
      beta_ = xsimd::select(bottom, beta_ * Lanes(task_.ground), beta_);
      view_ground(bottom);
    } else {
      off = off | bottom;
    }

    scatter(collides, xi);
    // Russian roulette only for what has faded: it never enlarges a path's weight above 1.
    const LaneMask faint = beta_ < Lanes(0.05f);
    const Lanes survival(0.25f);
    const LaneMask dies = faint & (xi[3] >= survival);
    beta_ = xsimd::select(faint, beta_ / survival, beta_);
    done_ = off | dies;
  }

  void scatter(const LaneMask& collides, const Lanes (&xi)[4]) {
    const Lanes zero(0.0f), one(1.0f);
    const int count = task_.lobe_count;
    if (count == 0) return;
    Lanes rest = xi[1];
    Deflection<Lanes> d{one, zero, Lanes(2.0f)};
    LaneMask undecided = zero == zero;
    for (int k = 0; k < count; ++k) {
      const Lanes share(task_.lobes[k].share);
      const LaneMask here = k + 1 < count ? undecided & (rest < share) : undecided;
      const Lanes inside = xsimd::min(Lanes(1.0f - 0x1p-24f), xsimd::max(zero, rest / share));
      const Deflection<Lanes> candidate = std::visit([&](const auto& lobe) { return lobe.sample(inside); }, lobes_[k]);
      d.mu = xsimd::select(here, candidate.mu, d.mu);
      d.one_minus = xsimd::select(here, candidate.one_minus, d.one_minus);
      d.one_plus = xsimd::select(here, candidate.one_plus, d.one_plus);
      undecided = undecided & (rest >= share);
      rest = rest - share;
    }
    const Lanes azimuth = xsimd::cos(Lanes(std::numbers::pi_v<float>) * xi[2]);
    const Lanes sine = xsimd::sqrt(xsimd::max(zero, (one - cosine_) * (one + cosine_)));
    const Lanes turned = cosine_ * d.mu + sine * d.sine() * azimuth;
    cosine_ = xsimd::select(collides, xsimd::max(Lanes(-1.0f), xsimd::min(one, turned)), cosine_);
    scattered_ = xsimd::select(collides, one, scattered_);
  }

  /// Radiance toward each exit cosine mu_e from wherever on the flight ahead a collision may happen, in expectation:
  /// pi / mu_e p int_0^to_face e^-(t + optical depth from there to the face along mu_e) dt, p averaged over equidistant
  /// azimuths, the first of them random. The light that enters thus gives its first order without noise.
  void view(const Lanes& to_face, const Lanes& xi, const LaneMask& idle) {
    const Lanes zero(0.0f), one(1.0f), depth(task_.depth);
    const LaneMask down = cosine_ > zero;
    const Lanes sine = xsimd::sqrt(xsimd::max(zero, (one - cosine_) * (one + cosine_)));
    Lanes across[azimuths];
    for (int a = 0; a < azimuths; ++a) {
      constexpr float turn = 2.0f * std::numbers::pi_v<float> / azimuths;
      across[a] = sine * xsimd::cos(turn * (xi + Lanes(static_cast<float>(a))));
    }
    const Lanes beta = xsimd::select(idle, zero, beta_ * Lanes(task_.albedo));
    for (int m = 0; m < task_.mu_count; ++m) {
      const float mu = task_.mu[m], exit_sine = std::sqrt(std::max(0.0f, (1.0f - mu) * (1.0f + mu)));
      for (int side = 0; side < 2; ++side) {  // 0: up, reflection; 1: down, transmission
        if (side == 1 && !(task_.depth < std::numeric_limits<float>::infinity())) continue;
        const float out = side == 0 ? -mu : mu;
        const Lanes along = cosine_ * Lanes(out);
        Lanes p = zero;
        for (int k = 0; k < task_.lobe_count; ++k) {
          const Lanes lobe_density = std::visit(
              [&](const auto& lobe) {
                Lanes total(0.0f);
                for (const Lanes& x : across) {
                  const Lanes raw = along + Lanes(exit_sine) * x;
                  total =
                      total + lobe.density(Deflection<Lanes>::from_mu(xsimd::max(Lanes(-1.0f), xsimd::min(one, raw))));
                }
                return total;
              },
              lobes_[k]);
          p = p + Lanes(task_.lobes[k].share) * lobe_density;
        }
        // Optical depth of the way out by a collision at once (near) and at the face (far); it grows by `rate`.
        const Lanes near = (side == 0 ? z_ : depth - z_) / Lanes(mu);
        const Lanes far = to_face + xsimd::select(side == 0 ? down : !down, depth / Lanes(mu), zero);
        const Lanes rate = xsimd::abs(one - cosine_ / Lanes(out)), growth = rate * to_face;
        // int_0^s e^-rt dt = (1 - e^-rs) / r, whose digits cancel for small rs.
        const Lanes length = xsimd::select(growth > Lanes(0.01f), (one - xsimd::exp(-growth)) / rate,
                                           to_face * (one - growth * (Lanes(0.5f) - growth * Lanes(1.0f / 6.0f))));
        const Lanes seen =
            beta * p * Lanes(std::numbers::pi_v<float> / (azimuths * mu)) * xsimd::exp(-xsimd::min(near, far)) * length;
        Lanes& tally = tallies_[2 + 2 * m + side];
        tally = tally + seen;
      }
    }
  }

  /// The ground just lit by beta (its albedo included) seen from above through the slab.
  void view_ground(const LaneMask& reflected) {
    for (int m = 0; m < task_.mu_count; ++m) {
      const Lanes through(std::exp(-task_.depth / task_.mu[m]));
      Lanes& tally = tallies_[2 + 2 * m];
      tally = tally + xsimd::select(reflected, beta_ * through, Lanes(0.0f));
    }
  }

  void hand_in(int lane) {
    double* const sum = sums_ + (random_.path[lane] - task_.first_path) / task_.replicate_paths * tallies_.size();
    for (std::size_t i = 0; i < tallies_.size(); ++i) sum[i] += tallies_[i].get(static_cast<std::size_t>(lane));
  }

  // Fewer leave noise where lobes are narrow (g = 0.85: four times the variance with two), more buy next to nothing.
  static constexpr int azimuths = 8;
  const SlabTask& task_;
  double* sums_;
  std::vector<Lobe<Lanes>> lobes_;
  std::vector<Lanes> tallies_;
  LaneRandom random_;
  Lanes beta_ = Lanes(0.0f), z_ = Lanes(0.0f), cosine_ = Lanes(1.0f), scattered_ = Lanes(0.0f);
  LaneMask done_ = Lanes(0.0f) > Lanes(0.0f);
};

}  // namespace TYNDALL_KERNEL_NAMESPACE
}  // namespace tyndall

extern "C" void TYNDALL_KERNEL_ENTRY(const tyndall::SlabTask* task, double* sums) {
  tyndall::TYNDALL_KERNEL_NAMESPACE::Slab(*task, sums).run();
}
