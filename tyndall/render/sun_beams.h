#pragma once
// Where rays of the sun enter the places that a picture shows: through the windows of a room, say.
#include <vector>

#include "tyndall/render/path_lights.h"
#include "tyndall/sampling/square_tree.h"

namespace tyndall {

/// Sunlight that a path met: at a place, travelling along a direction, and how much it brought.
struct SunLesson {
  std::uint32_t sun;
  Vector place, travel;
  double worth;
};

/// Rays of one sun by where they cross a plane before the scene, more of them where they did some good.
class SunBeams {
 public:
  /// Of no use.
  SunBeams() = default;

  /// For the sun of that number, from what paths have met of it. Of use where few of their tries have: `tries` times
  /// the sun was looked for.
  SunBeams(const Scene& scene, std::uint32_t number, const std::vector<SunLesson>& lessons, std::uint64_t tries) {
    constexpr std::size_t fewest = 64;
    std::vector<const SunLesson*> own;
    for (const SunLesson& lesson : lessons) {
      if (lesson.sun == number) own.push_back(&lesson);
    }
    if (own.size() < fewest || 4 * own.size() > tries) return;
    frame_ = Frame::around(normalized(scene.suns[number].direction));
    double first = infinity, size = 0.0;
    for (const Mesh& mesh : scene.meshes) {
      for (const auto& p : mesh.positions) {
        const Vector v{p[0], p[1], p[2]};
        first = std::min(first, dot(v, frame_.normal));
        size = std::max(size, length(v));
      }
    }
    if (first == infinity) return;
    height_ = first - 1e-3 * size;
    low_ = {infinity, infinity, 0.0};
    Vector high = -low_;
    std::vector<Vector> crossings;
    for (const SunLesson* lesson : own) {
      const Vector at = crossing(lesson->place, lesson->travel);
      low_ = {std::min(low_.x, at.x), std::min(low_.y, at.y), 0.0};
      high = {std::max(high.x, at.x), std::max(high.y, at.y), 0.0};
      crossings.push_back(at);
    }
    extent_ = high - low_;
    if (!(extent_.x > 0.0 && extent_.y > 0.0)) return;
    std::vector<SquareTree::Point> points;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Vector at = crossings[i] - low_;
      points.push_back({static_cast<float>(at.x / extent_.x), static_cast<float>(at.y / extent_.y),
                        static_cast<float>(own[i]->worth)});
    }
    tree_ = SquareTree(std::move(points));
    useful_ = true;
  }

  bool useful() const { return useful_; }

  /// Where a ray that travels along unit vector `travel` crosses the plane, for two random numbers.
  Vector sample(double xi1, double xi2) const {
    const SquareTree::Sample at = tree_.sample(xi1, xi2);
    return frame_.to_world({low_.x + at.u * extent_.x, low_.y + at.v * extent_.y, height_});
  }
  /// How densely [1/m^2] such rays come by a place, counted per area across them.
  double density(const Vector& place, const Vector& travel) const {
    if (!useful_) return 0.0;
    const Vector at = crossing(place, travel) - low_;
    return tree_.density(at.x / extent_.x, at.y / extent_.y) / (extent_.x * extent_.y * dot(frame_.normal, travel));
  }

 private:
  /// In the plane's frame.
  Vector crossing(const Vector& place, const Vector& travel) const {
    const double back = (dot(place, frame_.normal) - height_) / dot(travel, frame_.normal);
    return frame_.to_local(place - travel * back);
  }

  Frame frame_{};
  double height_ = 0.0;  // of the plane, along the frame's normal, which is the sun's direction
  Vector low_, extent_;  // of the part of the plane that matters
  SquareTree tree_;
  bool useful_ = false;
};

}  // namespace tyndall
