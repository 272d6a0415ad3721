#pragma once
// The parts of `single` along one ray: what it sees, and what each light scatters into it.
#include "tyndall/render/bsdf.h"
#include "tyndall/render/single.h"
#include "tyndall/render/single_airlight.h"
#include "tyndall/render/single_glow.h"
#include "tyndall/render/single_lights.h"
#include "tyndall/render/single_shadow.h"

namespace tyndall {

/// Quadratures of lights that fill an angle err by far more than this; panels along their many rays need not be finer.
inline constexpr double coarse_tolerance = 1e-3;

struct SingleContext::Prepared {
  Prepared(const Scene& scene, const Geometry& geometry, const SingleSettings& settings);

  const Scene& scene;
  const Geometry& geometry;
  SingleSettings settings;
  SingleMedium medium;
  ShadowIndex shadows;
  std::vector<SingleLamp> lamps;  // point and spot lights
  GlowTree glow;                  // emissive surfaces
  SingleSky sky;
  std::vector<SingleSun> suns;  // of the scene and of the sky
};

/// Of how many directions it was asked whether the sky is seen there, and of how many it is.
struct SkySeen {
  double asked = 0.0, open = 0.0;
};

/// A ray with what it meets. set() may be called again and again.
class SingleRay {
 public:
  explicit SingleRay(const SingleContext::Prepared& context) : context_(context) {}

  /// The ray ends at `distance` or the first surface.
  void set(const Ray& ray, double distance);

  double end() const { return end_; }
  double depth() const { return hit_ ? hit_->t : infinity; }
  Spectrum transmittance() const { return medium_.transmittance_to(end_); }

  /// Radiance that arrives unscattered: of the surface or the surroundings at the ray's end, attenuated. Without
  /// sources: only what surfaces reflect and the smooth rest of the sky, for those who add lights by themselves.
  Spectrum surface(bool sources = true);
  /// Radiance scattered once: of one of the point and spot lights, of one of the suns, of all emissive surfaces, of the
  /// smooth sky; of all but the lamps.
  Spectrum from_lamp(std::size_t index);
  Spectrum from_sun(std::size_t index);
  Spectrum from_glow();
  Spectrum from_sky();
  Spectrum from_the_rest();

  /// Light of every lamp, sun, glowing point and of the sky that a surface point reflects toward `out`, unit.
  Spectrum reflected(const Hit& hit, const Vector& out);
  /// Of emissive surfaces only. `start` is the point moved off its surface; `others` is what it reflects besides: what
  /// is small beside that may be left out.
  Spectrum reflected_glow(const SurfacePoint& surface, const Vector& start, const Vector& out, const Spectrum& others);
  /// Fluence rate that emissive surfaces give to a point directly.
  Spectrum glow_around(const Vector& point);

 private:
  Spectrum from(const SingleLamp& lamp, double tolerance);
  Spectrum from_direction(const Vector& toward, double tolerance);
  Spectrum open_way(const Vector& from, const Vector& to);
  Spectrum open_way(const Ray& ray);
  Spectrum visible(const Vector& from, const Spectrum& others);
  void set_stations();
  double set_shares();
  std::pair<double, double> glow_estimate(const GlowCell& cell, double along, double aside, double reach) const;
  Spectrum open_share(const Vector& toward, int turn);
  Spectrum reflected_sky(const SurfacePoint& surface, const Vector& start, const Vector& out);
  Spectrum scattered_sky(const std::vector<double>& shares, double whole, int count, SkySeen& seen);

  struct Station {
    Vector point;
    Spectrum light;  // scattered to the eye there, per density of the stations
  };

  const SingleContext::Prepared& context_;
  Ray ray_;
  double end_ = 0.0;
  bool cut_short_ = false;
  std::optional<Hit> hit_;
  RayMedium medium_;
  std::vector<Interval> lit_;
  std::vector<Stretch> scratch_;
  std::vector<double> shares_;
  std::vector<GlowPart> cut_;
  std::vector<Station> stations_;
};

}  // namespace tyndall
