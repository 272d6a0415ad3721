#pragma once
// What a ray meets of a scene's surfaces (through Embree).
#include <memory>
#include <optional>

#include "tyndall/scene/surface.h"

namespace tyndall {

/// A point on a surface. Normals are unit vectors on the side the ray came from, the shading normal bent by a normal
/// map; `front` tells whether that is the triangle's counter-clockwise side.
struct Hit {
  double t = 0.0;
  Vector point, geometric_normal, shading_normal;
  bool front = true;
  SurfacePlace at;
  const Material* material = nullptr;
};

/// The ray-tracing index of a scene. Holds a reference to the scene, which must outlive it. Safe to query from many
/// threads. Surfaces are not there where their alpha is below a mask's cutoff; of a blended surface each ray meets the
/// part that alpha says, by chance, but the same ray always the same.
class Geometry {
 public:
  explicit Geometry(const Scene& scene);
  ~Geometry();
  Geometry(const Geometry&) = delete;
  Geometry& operator=(const Geometry&) = delete;

  /// The nearest surface with 0 < t < end; none when it misses. The direction is a unit vector.
  std::optional<Hit> intersect(const Ray& ray, double end = infinity) const;
  /// Whether anything is met with 0 < t < end.
  bool occluded(const Ray& ray, double end = infinity) const;
  /// Whether the segment between two points meets a surface strictly between them.
  bool occluded(const Vector& from, const Vector& to) const;
  /// `point` moved off its surface along `normal`, far enough for a ray from there to miss that surface.
  Vector leave(const Vector& point, const Vector& normal) const;

  /// What it is the index of.
  const Scene& scene() const;

 private:
  struct Index;
  std::unique_ptr<Index> index_;
};

}  // namespace tyndall
