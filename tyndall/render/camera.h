#pragma once
// Rays from the camera through its film.
#include <numbers>

#include "tyndall/scene/scene.h"

namespace tyndall {

/// The pinhole camera of a scene with its film's frame; x grows right, y grows down, the whole film is [0, width) x [0,
/// height).
class CameraRays {
 public:
  CameraRays(const Camera& camera, const Film& film) : origin_(camera.position) {
    const Vector forward = normalized(camera.look_at - camera.position);
    const Vector right = normalized(cross(forward, camera.up)), up = cross(right, forward);
    const double half_height = std::tan(0.5 * camera.vertical_fov * std::numbers::pi / 180.0);
    const double pixel = 2.0 * half_height / film.height;
    step_x_ = right * pixel;
    step_y_ = up * -pixel;
    corner_ = forward - step_x_ * (0.5 * film.width) - step_y_ * (0.5 * film.height);
  }
  /// Through film position (x, y) in pixels.
  Ray through(double x, double y) const { return {origin_, normalized(corner_ + step_x_ * x + step_y_ * y)}; }

 private:
  Vector origin_, corner_, step_x_, step_y_;
};

}  // namespace tyndall
