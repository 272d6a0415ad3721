// Paths through a homogeneous slab, many at a time. Only the cosine to the axis matters: a deflection {mu, sin} at
// azimuth phi turns c into c mu + sqrt(1 - c^2) sin cos(phi).
#include "tyndall/render/slab_kernel.h"

#include <vector>

#include "tyndall/number/lanes.h"
#include "tyndall/phase/law.h"
#include "tyndall/sampling/philox.h"

namespace tyndall {
namespace TYNDALL_KERNEL_NAMESPACE {

constexpr int width = static_cast<int>(Lanes::size);

/// A number per lane, for what is done lane by lane.
struct alignas(64) PerLane {
  float value[width];
  Lanes load() const { return Lanes::load_aligned(value); }
  void store(const Lanes& x) { x.store_aligned(value); }
};

/// Random numbers of `width` paths at once: four per call, each in (0, 1) with 23 bits, so that 1 - x is never 0.
struct LaneRandom {
  alignas(64) std::uint32_t path[width], block[width];
  std::uint32_t key[2];

  void next(Lanes (&out)[4]) {
    alignas(64) std::uint32_t c[4][width];
    for (int i = 0; i < width; ++i) {
      c[0][i] = block[i]++;
      c[1][i] = path[i];
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
      for (int i = 0; i < width; ++i) x.value[i] = (static_cast<float>(c[w][i] >> 9) + 0.5f) * 0x1p-23f;
      out[w] = x.load();
    }
  }
};

template <int N>
class Slab {
 public:
  Slab(const SlabTask& task, double* sum, double* squares) : task_(task), sum_(sum), squares_(squares) {
    for (int i = 0; i < task.lobe_count; ++i) lobes_.push_back(lobe_of<Lanes>(task.lobes[i].lobe));
    tallies_.resize(slab_tally_count(N, task.mu_count));
    random_.key[0] = static_cast<std::uint32_t>(task.seed);
    random_.key[1] = static_cast<std::uint32_t>(task.seed >> 32);
  }

  void run() {
    const std::uint32_t end = task_.first_path + task_.path_count;
    std::uint32_t next_path = task_.first_path;
    LaneMask fresh = Lanes(0.0f) == Lanes(0.0f), idle = fresh;
    unsigned live = 0;
    for (int i = 0; i < width; ++i) {
      random_.path[i] = next_path;
      random_.block[i] = 0;
      if (next_path < end) ++next_path, live |= 1u << i;
    }
    start(fresh);
    idle = mask_of(~live);
    Lanes xi[4], more[4];
    while (live != 0) {
      random_.next(xi);
      if (N > 1) random_.next(more);
      step(xi, more, idle);
      // Lanes whose path is over hand in their tallies and take the next path.
      const unsigned done = bits(done_) & live;
      if (done == 0) continue;
      unsigned started = 0;
      for (int i = 0; i < width; ++i) {
        if (!(done >> i & 1u)) continue;
        hand_in(i);
        if (next_path < end) {
          random_.path[i] = next_path++;
          random_.block[i] = 0;
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
      for (int i = 0; i < width; ++i) before[i] = random_.block[i];
      Lanes xi[4];
      random_.next(xi);
      const unsigned set = bits(fresh);
      for (int i = 0; i < width; ++i) {
        if (!(set >> i & 1u)) random_.block[i] = before[i];
      }
      mu = xsimd::sqrt(xi[0]);
    }
    z_ = xsimd::select(fresh, Lanes(0.0f), z_);
    cosine_ = xsimd::select(fresh, mu, cosine_);
    scattered_ = xsimd::select(fresh, Lanes(0.0f), scattered_);
    for (int c = 0; c < N; ++c) beta_[c] = xsimd::select(fresh, Lanes(1.0f), beta_[c]);
  }

  Lanes total(const Lanes (&x)[N]) const {
    Lanes s = x[0];
    for (int c = 1; c < N; ++c) s = s + x[c];
    return s;
  }

  /// One flight and what ends it: leaving the top, the ground, or a collision.
  void step(const Lanes (&xi)[4], const Lanes (&more)[4], const LaneMask& idle) {
    const Lanes zero(0.0f), one(1.0f);
    const LaneMask down = cosine_ > zero;
    const Lanes to_face =
        xsimd::select(down, Lanes(task_.thickness) - z_, z_) / xsimd::max(xsimd::abs(cosine_), Lanes(1e-12f));

    // Spectral MIS: one channel, picked in proportion to beta, chooses the distance; all channels share its density.
    Lanes picked(task_.extinction[0]);
    const Lanes all = total(beta_);
    if (N > 1) {
      Lanes rest = more[0] * all - beta_[0];
      for (int c = 1; c < N; ++c) {
        picked = xsimd::select(rest >= zero, Lanes(task_.extinction[c]), picked);
        rest = rest - beta_[c];
      }
    }
    const Lanes t = -xsimd::log(xi[0]) / picked;  // infinite where the picked channel sees nothing
    const LaneMask collides = t < to_face;
    const Lanes flight = xsimd::select(collides, t, to_face);
    if (N > 1) {
      Lanes survived[N], mixture = zero;
      for (int c = 0; c < N; ++c) {
        const Lanes extinction(task_.extinction[c]);
        // inf * 0 for a half space seen through a channel without extinction: nothing is lost there.
        survived[c] = task_.extinction[c] > 0.0f ? xsimd::exp(-(extinction * flight)) : one;
        mixture = mixture + beta_[c] * survived[c] * xsimd::select(collides, extinction, one);
      }
      const Lanes scale = xsimd::select(mixture > zero, all / mixture, zero);
      for (int c = 0; c < N; ++c) {
        beta_[c] = beta_[c] * survived[c] * scale * xsimd::select(collides, Lanes(task_.scattering[c]), one);
      }
    } else {
      beta_[0] = beta_[0] * xsimd::select(collides, Lanes(task_.scattering[0] / task_.extinction[0]), one);
    }
    z_ = xsimd::select(collides, xsimd::max(zero, xsimd::min(Lanes(task_.thickness), z_ + cosine_ * flight)), z_);

    LaneMask off = (total(beta_) <= zero) | idle;
    const LaneMask passes = !collides;
    const LaneMask top = passes & !down, bottom = passes & down;
    for (int c = 0; c < N; ++c) {
      tallies_[c] = tallies_[c] + xsimd::select(top, beta_[c], zero);
      tallies_[N + c] = tallies_[N + c] + xsimd::select(bottom, beta_[c] * scattered_, zero);
    }
    off = off | top;
    if (task_.ground > 0.0f) {
      const LaneMask reflected = bottom & (Lanes(task_.thickness) < Lanes(std::numeric_limits<float>::infinity()));
      z_ = xsimd::select(reflected, Lanes(task_.thickness), z_);
      cosine_ = xsimd::select(reflected, -xsimd::sqrt(xi[1]), cosine_);
      scattered_ = xsimd::select(reflected, one, scattered_);
      for (int c = 0; c < N; ++c) beta_[c] = xsimd::select(reflected, beta_[c] * Lanes(task_.ground), beta_[c]);
      view_ground(reflected);
    } else {
      off = off | bottom;
    }

    scatter(collides, xi);
    // Russian roulette only for what has faded: it never enlarges a path's weight above 1.
    const Lanes weight = total(beta_) * Lanes(1.0f / N);
    const LaneMask faint = weight < Lanes(0.05f);
    const Lanes survival(0.25f);
    const Lanes& chance = N > 1 ? more[1] : xi[3];
    const LaneMask dies = faint & (chance >= survival);
    for (int c = 0; c < N; ++c) beta_[c] = xsimd::select(faint, beta_[c] / survival, beta_[c]);
    done_ = off | dies;
  }

  void scatter(const LaneMask& collides, const Lanes (&xi)[4]) {
    const Lanes zero(0.0f), one(1.0f);
    const int count = task_.lobe_count;
    if (count == 0) return;
    // beta already carries sigma_s; per lobe it is beta * share, share_c = scattering_k,c / scattering_c.
    Lanes rest = xi[1] * total(beta_);
    Deflection<Lanes> d{one, zero, Lanes(2.0f)};
    LaneMask undecided = zero == zero;
    for (int k = 0; k < count; ++k) {
      const Lanes weight = lobe_weight(k);
      const LaneMask here = k + 1 < count ? undecided & (rest < weight) : undecided;
      const Lanes inside =
          xsimd::min(Lanes(1.0f - 0x1p-24f), xsimd::max(zero, rest / xsimd::max(weight, Lanes(1e-30f))));
      const Deflection<Lanes> candidate = std::visit([&](const auto& lobe) { return lobe.sample(inside); }, lobes_[k]);
      d.mu = xsimd::select(here, candidate.mu, d.mu);
      d.one_minus = xsimd::select(here, candidate.one_minus, d.one_minus);
      d.one_plus = xsimd::select(here, candidate.one_plus, d.one_plus);
      undecided = undecided & (rest >= weight);
      rest = rest - weight;
    }
    for (int m = 0; m < task_.mu_count; ++m) view(m, collides, xi[2]);
    if (N > 1) weigh(d, collides);
    const Lanes azimuth = xsimd::cos(Lanes(std::numbers::pi_v<float>) * xi[2]);
    const Lanes sine = xsimd::sqrt(xsimd::max(zero, (one - cosine_) * (one + cosine_)));
    const Lanes turned = cosine_ * d.mu + sine * d.sine() * azimuth;
    cosine_ = xsimd::select(collides, xsimd::max(Lanes(-1.0f), xsimd::min(one, turned)), cosine_);
    scattered_ = xsimd::select(collides, one, scattered_);
  }

  /// Throughput-weighted share of lobe k, over the channels.
  Lanes lobe_weight(int k) const {
    Lanes weight(0.0f);
    for (int c = 0; c < N; ++c) weight = weight + beta_[c] * Lanes(share(k, c));
    return weight;
  }
  float share(int k, int c) const {
    return task_.scattering[c] > 0.0f ? task_.lobes[k].scattering[c] / task_.scattering[c] : 0.0f;
  }

  /// beta_c *= sum_k share_kc p_k / sum_k q_k p_k: the balance heuristic over lobes and channels.
  void weigh(const Deflection<Lanes>& d, const LaneMask& collides) {
    Lanes scattered[N], chance(0.0f);
    for (int c = 0; c < N; ++c) scattered[c] = Lanes(0.0f);
    for (int k = 0; k < task_.lobe_count; ++k) {
      const Lanes p = std::visit([&](const auto& lobe) { return lobe.density(d); }, lobes_[k]);
      chance = chance + lobe_weight(k) * p;
      for (int c = 0; c < N; ++c) scattered[c] = scattered[c] + Lanes(share(k, c)) * p;
    }
    const Lanes all = total(beta_);
    for (int c = 0; c < N; ++c) {
      beta_[c] = xsimd::select(collides & (chance > Lanes(0.0f)), beta_[c] * scattered[c] * all / chance, beta_[c]);
    }
  }

  /// Expected radiance toward exit cosine m from a collision at z: pi / mu_e p e^{-sigma z / mu_e}, at a random
  /// azimuth.
  void view(int m, const LaneMask& collides, const Lanes& xi) {
    const Lanes zero(0.0f), one(1.0f), mu(task_.mu[m]);
    const Lanes azimuth = xsimd::cos(Lanes(std::numbers::pi_v<float>) * (one - xi));
    const Lanes sine = xsimd::sqrt(xsimd::max(zero, (one - cosine_) * (one + cosine_)));
    const float exit_sine = std::sqrt(std::max(0.0f, (1.0f - task_.mu[m]) * (1.0f + task_.mu[m])));
    for (int side = 0; side < 2; ++side) {  // 0: up, reflection; 1: down, transmission
      if (side == 1 && !(task_.thickness < std::numeric_limits<float>::infinity())) continue;
      const Lanes out = side == 0 ? -mu : mu;
      const Lanes raw = cosine_ * out + sine * Lanes(exit_sine) * azimuth;
      const Deflection<Lanes> d = Deflection<Lanes>::from_mu(xsimd::max(Lanes(-1.0f), xsimd::min(one, raw)));
      Lanes p[N];
      for (int c = 0; c < N; ++c) p[c] = zero;
      for (int k = 0; k < task_.lobe_count; ++k) {
        const Lanes lobe_density = std::visit([&](const auto& lobe) { return lobe.density(d); }, lobes_[k]);
        for (int c = 0; c < N; ++c) p[c] = p[c] + Lanes(share(k, c)) * lobe_density;
      }
      const Lanes path = (side == 0 ? z_ : Lanes(task_.thickness) - z_) / mu;
      for (int c = 0; c < N; ++c) {
        const Lanes seen =
            beta_[c] * p[c] * Lanes(std::numbers::pi_v<float>) / mu * xsimd::exp(-(Lanes(task_.extinction[c]) * path));
        Lanes& tally = tallies_[2 * N + (2 * m + side) * N + c];
        tally = tally + xsimd::select(collides, seen, zero);
      }
    }
  }

  /// The ground just lit by beta (its albedo included) seen from above through the slab.
  void view_ground(const LaneMask& reflected) {
    for (int m = 0; m < task_.mu_count; ++m) {
      for (int c = 0; c < N; ++c) {
        const Lanes through(std::exp(-task_.extinction[c] * task_.thickness / task_.mu[m]));
        Lanes& tally = tallies_[2 * N + 2 * m * N + c];
        tally = tally + xsimd::select(reflected, beta_[c] * through, Lanes(0.0f));
      }
    }
  }

  void hand_in(int lane) {
    for (std::size_t i = 0; i < tallies_.size(); ++i) {
      const double x = tallies_[i].get(static_cast<std::size_t>(lane));
      sum_[i] += x;
      squares_[i] += x * x;
    }
  }

  const SlabTask& task_;
  double *sum_, *squares_;
  std::vector<Lobe<Lanes>> lobes_;
  std::vector<Lanes> tallies_;
  LaneRandom random_;
  Lanes beta_[N], z_ = Lanes(0.0f), cosine_ = Lanes(1.0f), scattered_ = Lanes(0.0f);
  LaneMask done_ = Lanes(0.0f) > Lanes(0.0f);
};

}  // namespace TYNDALL_KERNEL_NAMESPACE
}  // namespace tyndall

extern "C" void TYNDALL_KERNEL_ENTRY(const tyndall::SlabTask* task, double* sum, double* squares) {
  using namespace tyndall::TYNDALL_KERNEL_NAMESPACE;
  if (task->channels == 1) {
    Slab<1>(*task, sum, squares).run();
  } else {
    Slab<3>(*task, sum, squares).run();
  }
}
