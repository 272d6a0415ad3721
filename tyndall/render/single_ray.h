#pragma once
// The parts of `single` along one ray: what it sees, and what each light scatters into it.
#include "tyndall/render/single.h"
#include "tyndall/render/single_airlight.h"
#include "tyndall/render/single_lights.h"
#include "tyndall/render/single_shadow.h"

namespace tyndall {

struct SingleContext::Prepared {
  Prepared(const Scene& scene, const Geometry& geometry, const SingleSettings& settings);

  const Scene& scene;
  const Geometry& geometry;
  SingleSettings settings;
  SingleMedium medium;
  ShadowIndex shadows;
  std::vector<SingleLamp> lamps, glow;  // point and spot lights; pieces of emissive surfaces
  SingleSky sky;
  std::vector<SingleSun> suns;  // of the scene and of the sky
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

 private:
  Spectrum from(const SingleLamp& lamp, double tolerance);
  Spectrum from_direction(const Vector& toward, double tolerance);
  Spectrum open_way(const Vector& from, const Vector& to);
  Spectrum open_way(const Ray& ray);

  const SingleContext::Prepared& context_;
  Ray ray_;
  double end_ = 0.0;
  bool cut_short_ = false;
  std::optional<Hit> hit_;
  RayMedium medium_;
  std::vector<Interval> lit_;
  std::vector<Stretch> scratch_;
  std::vector<double> shares_;
};

}  // namespace tyndall
