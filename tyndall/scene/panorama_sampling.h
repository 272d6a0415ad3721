#pragma once
// The surroundings as a light: radiance by direction, and directions by radiance.
#include <cstddef>
#include <vector>

#include "tyndall/light/light.h"

namespace tyndall {

/// Radiance of the surroundings seen in a unit direction. A panorama is interpolated bilinearly between pixel centres:
/// around the horizon without a seam, beyond the centres of the top and bottom rows as those rows. Its centre looks
/// along -Z, u grows toward +X; `rotation` turns it counter-clockwise seen from above.
Spectrum radiance(const EnvironmentLight& environment, const Vector& direction);

struct DirectionSample {
  Vector direction;      // unit, toward the light
  double density = 0.0;  // [1/sr]
  Spectrum radiance;
};

/// Importance sampling of the surroundings. The sphere is cut into cells between pixel centres (width x (height + 1);
/// those of the first and last row reach the poles). A cell is chosen in proportion to its solid angle times the mean
/// of its four corners, channels averaged; a direction in it uniformly. Since radiance is interpolated between those
/// corners, it is at most 4 times the cell's mean: weights are bounded, and no light is missed. The density is exact.
class PanoramaSampler {
 public:
  /// Refers to the light, which must outlive it; null: no light.
  explicit PanoramaSampler(const EnvironmentLight* light);

  /// Whether there is any light.
  bool empty() const { return !(total_ > 0.0); }
  /// A direction for two numbers in [0, 1). Nothing (density 0) where there is no light.
  DirectionSample sample(double u, double v) const;
  /// The density [1/sr] with which sample() gives a unit direction.
  double density(const Vector& direction) const;

  /// A piece of the sky: a cell, its middle direction, its solid angle [sr] and the irradiance [W/m^2] that it casts on
  /// a surface facing it (mean radiance of the corners times solid angle).
  struct Cell {
    Vector direction;
    double solid_angle;
    Spectrum irradiance;
  };
  /// All cells of a panorama, row by row from the top; empty for a constant radiance.
  std::vector<Cell> cells() const;

 private:
  struct Place {
    std::size_t column, row;
  };
  Place place_of(const Vector& direction) const;
  double cell_density(std::size_t column, std::size_t row) const;
  double row_top(std::size_t row) const;  // cosine of the polar angle of a row of cells' upper edge
  double solid_angle(std::size_t row) const;
  Spectrum corner_mean(std::size_t column, std::size_t row) const;

  const EnvironmentLight* light_;
  std::size_t columns_ = 0, rows_ = 0;     // of cells; 0 for a constant radiance
  std::vector<double> in_row_, row_sums_;  // cumulative weights: in each row of cells, and of rows
  double total_ = 0.0;
};

}  // namespace tyndall
