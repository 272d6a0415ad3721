#include "tyndall/scene/panorama_sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tyndall {
namespace {

constexpr double pi_number = std::numbers::pi;

Spectrum texel(const Panorama& panorama, std::size_t x, std::size_t y) {
  const auto& c = panorama.radiance[y * static_cast<std::size_t>(panorama.width) + x];
  return {{c[0], c[1], c[2]}};
}

/// The columns of pixels on both sides of a column of cells: cell i lies between the centres of pixels i - 1 and i.
struct Pair {
  std::size_t before, after;
};
Pair columns_of(std::size_t cell, std::size_t count) { return {cell == 0 ? count - 1 : cell - 1, cell}; }
Pair rows_of(std::size_t cell, std::size_t count) { return {cell == 0 ? 0 : cell - 1, std::min(cell, count - 1)}; }

/// Position in cells of a direction: whole part is the cell, the rest how far across.
struct Position {
  double x, y;
};
Position position_of(const EnvironmentLight& light, const Vector& d) {
  const Panorama& panorama = *light.panorama;
  const double azimuth = std::atan2(d.x, -d.z) / (2.0 * pi_number) + light.rotation / 360.0 + 0.5;
  // Near the poles an arc cosine of y would lose half of its digits.
  const double polar = std::atan2(std::hypot(d.x, d.z), d.y);
  return {(azimuth - std::floor(azimuth)) * panorama.width + 0.5, polar / pi_number * panorama.height + 0.5};
}

Vector direction_of(double azimuth, double cosine) {
  const double sine = std::sqrt(std::max(0.0, (1.0 - cosine) * (1.0 + cosine)));
  return {sine * std::sin(azimuth), cosine, -sine * std::cos(azimuth)};
}

}  // namespace

Spectrum radiance(const EnvironmentLight& light, const Vector& direction) {
  if (!light.panorama) return light.radiance * light.scale;
  const Panorama& panorama = *light.panorama;
  const auto width = static_cast<std::size_t>(panorama.width), height = static_cast<std::size_t>(panorama.height);
  const Position p = position_of(light, direction);
  const auto column = static_cast<std::size_t>(p.x), row = std::min(static_cast<std::size_t>(p.y), height);
  const double right = p.x - static_cast<double>(column), below = p.y - static_cast<double>(row);
  const Pair x = columns_of(column % width, width), y = rows_of(row, height);
  const Spectrum upper =
      texel(panorama, x.before, y.before) * (1.0 - right) + texel(panorama, x.after, y.before) * right;
  const Spectrum lower = texel(panorama, x.before, y.after) * (1.0 - right) + texel(panorama, x.after, y.after) * right;
  return (upper * (1.0 - below) + lower * below) * light.scale;
}

PanoramaSampler::PanoramaSampler(const EnvironmentLight* light) : light_(light) {
  if (light == nullptr) return;
  if (!light->panorama) {
    total_ = 4.0 * pi_number * mean(light->radiance * light->scale);
    return;
  }
  columns_ = static_cast<std::size_t>(light->panorama->width);
  rows_ = static_cast<std::size_t>(light->panorama->height) + 1;
  in_row_.resize(columns_ * rows_);
  row_sums_.resize(rows_);
  for (std::size_t row = 0; row < rows_; ++row) {
    double sum_of_row = 0.0;
    for (std::size_t column = 0; column < columns_; ++column) {
      sum_of_row += mean(corner_mean(column, row));
      in_row_[row * columns_ + column] = sum_of_row;
    }
    total_ += sum_of_row * solid_angle(row);
    row_sums_[row] = total_;
  }
}

Spectrum PanoramaSampler::corner_mean(std::size_t column, std::size_t row) const {
  const Panorama& panorama = *light_->panorama;
  const Pair x = columns_of(column, columns_), y = rows_of(row, rows_ - 1);
  return (texel(panorama, x.before, y.before) + texel(panorama, x.after, y.before) +
          texel(panorama, x.before, y.after) + texel(panorama, x.after, y.after)) *
         0.25 * light_->scale;
}

double PanoramaSampler::row_top(std::size_t row) const {
  if (row == 0) return 1.0;
  if (row == rows_) return -1.0;
  return std::cos(pi_number * (static_cast<double>(row) - 0.5) / static_cast<double>(rows_ - 1));
}

double PanoramaSampler::solid_angle(std::size_t row) const {
  return (row_top(row) - row_top(row + 1)) * 2.0 * pi_number / static_cast<double>(columns_);
}

/// The chance of a cell is a product of differences of cumulative weights, as sample() takes it.
double PanoramaSampler::cell_density(std::size_t column, std::size_t row) const {
  const double* const sums = in_row_.data() + row * columns_;
  if (!(sums[columns_ - 1] > 0.0)) return 0.0;
  const double chance_of_row = (row_sums_[row] - (row == 0 ? 0.0 : row_sums_[row - 1])) / total_;
  const double chance_in_row = (sums[column] - (column == 0 ? 0.0 : sums[column - 1])) / sums[columns_ - 1];
  return chance_of_row * chance_in_row / solid_angle(row);
}

PanoramaSampler::Place PanoramaSampler::place_of(const Vector& direction) const {
  const Position p = position_of(*light_, direction);
  return {static_cast<std::size_t>(p.x) % columns_, std::min(static_cast<std::size_t>(p.y), rows_ - 1)};
}

double PanoramaSampler::density(const Vector& direction) const {
  if (empty()) return 0.0;
  if (columns_ == 0) return 1.0 / (4.0 * pi_number);
  const Place at = place_of(direction);
  return cell_density(at.column, at.row);
}

DirectionSample PanoramaSampler::sample(double u, double v) const {
  if (empty()) return {};
  if (columns_ == 0) {
    return {direction_of(2.0 * pi_number * u, 1.0 - 2.0 * v), 1.0 / (4.0 * pi_number),
            light_->radiance * light_->scale};
  }
  // Choosing uses up the leading digits of a number; what is left over places the direction inside the cell.
  const auto choose = [](const double* sums, std::size_t count, double& x) {
    const double target = x * sums[count - 1];
    const auto index =
        std::min(static_cast<std::size_t>(std::upper_bound(sums, sums + count, target) - sums), count - 1);
    const double before = index == 0 ? 0.0 : sums[index - 1], share = sums[index] - before;
    x = share > 0.0 ? std::clamp((target - before) / share, 0.0, 1.0) : 0.5;
    return index;
  };
  const std::size_t row = choose(row_sums_.data(), rows_, v);
  const std::size_t column = choose(in_row_.data() + row * columns_, columns_, u);
  const double turns =
      (static_cast<double>(column) - 0.5 + u) / static_cast<double>(columns_) - 0.5 - light_->rotation / 360.0;
  const double top = row_top(row), cosine = top + v * (row_top(row + 1) - top);
  const Vector direction = direction_of(2.0 * pi_number * turns, cosine);
  return {direction, cell_density(column, row), tyndall::radiance(*light_, direction)};
}

std::vector<PanoramaSampler::Cell> PanoramaSampler::cells() const {
  std::vector<Cell> all;
  all.reserve(columns_ * rows_);
  for (std::size_t row = 0; row < rows_; ++row) {
    const double cosine = 0.5 * (row_top(row) + row_top(row + 1));
    for (std::size_t column = 0; column < columns_; ++column) {
      const double turns = static_cast<double>(column) / static_cast<double>(columns_) - 0.5 - light_->rotation / 360.0;
      all.push_back({direction_of(2.0 * pi_number * turns, cosine), solid_angle(row),
                     corner_mean(column, row) * solid_angle(row)});
    }
  }
  return all;
}

}  // namespace tyndall
