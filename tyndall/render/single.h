#pragma once
// The integrator `single`: surfaces in their direct light and one scattering in the medium, without random numbers.
#include <memory>
#include <string>

#include "tyndall/medium/lowered_medium.h"
#include "tyndall/scene/geometry.h"
#include "tyndall/scene/scene.h"

namespace tyndall {

/// How finely `single` integrates. Point, spot and parallel sun lights need nothing but the tolerance; the counts are
/// the fixed quadratures of lights that fill an angle.
struct SingleSettings {
  double tolerance = 1e-9;       // relative, of each adaptive integral along a ray
  int sky_directions = 512;      // of the surroundings, shared by the lobes of the medium
  int sky_shadows = 8;           // places along the ray where it is asked whether a surface hides one of these
  int sky_suns = 64;             // cells of a panorama too bright for that, each treated as a sun of its own
  int emissive_points = 64;      // at most twice as many emissive cells per ray, four times per surface point
  int sun_rings = 3;             // directions over the disc of a sun with an angular diameter: rings ...
  int sun_azimuth = 8;           // ... times azimuth
  int surface_directions = 256;  // of the surroundings, for a surface
};

/// What `single` prepares once per scene; read only afterwards, by any number of threads.
class SingleContext {
 public:
  /// Both must outlive the context.
  SingleContext(const Scene& scene, const Geometry& geometry, const SingleSettings& settings = {});
  ~SingleContext();
  SingleContext(const SingleContext&) = delete;
  SingleContext& operator=(const SingleContext&) = delete;

  struct Prepared;
  const Prepared& prepared() const { return *prepared_; }

 private:
  std::unique_ptr<Prepared> prepared_;
};

/// Radiance along a ray, or averaged over a pixel, in layers; beauty = surface + single.
struct PixelLayers {
  Spectrum surface;         // not scattered by the medium [W/(m^2 sr)]: what is seen at the ray's end, attenuated
  Spectrum single;          // scattered by the medium exactly once, no surface bounce
  Spectrum transmittance;   // of the medium up to the ray's end
  double depth = infinity;  // distance to the surface seen [m]; of a pixel, that of its centre
};

/// Radiance arriving at ray.origin from ray.direction (a unit vector). The ray ends at `distance` or the first surface;
/// with a finite `distance`, nothing at or beyond it is added, but lights and media beyond it still light the segment.
/// Infinite where the ray passes exactly through a visible lamp inside a medium.
PixelLayers single_radiance(const SingleContext& context, const Ray& ray, double distance = infinity);

/// The average over pixel (x, y) of the scene's film, (0, 0) top left. Samples stand on a regular grid of
/// ceil(sqrt(spp))^2 points; the light of lamps within the pixel, which goes as 1/angle, is integrated around them.
PixelLayers single_pixel(const SingleContext& context, int x, int y, int spp);

/// Fluence rate at a point [W/m^2]: radiance integrated over all directions, scattered at most once.
Spectrum single_fluence(const SingleContext& context, const Vector& point);

/// The text for image headers: what the fixed quadratures were.
std::string single_description(const SingleSettings& settings);

}  // namespace tyndall
