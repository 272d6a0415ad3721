#include "tyndall/scene/gltf_animation.h"

#include <algorithm>
#include <cmath>

#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

template <std::size_t N>
using Tuple = std::array<double, N>;

template <std::size_t N, class F>
Tuple<N> each(F f) {
  Tuple<N> out;
  for (std::size_t i = 0; i < N; ++i) out[i] = f(i);
  return out;
}

double dot(const Tuple<4>& a, const Tuple<4>& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3]; }

Tuple<3> on_the_way(const Tuple<3>& a, const Tuple<3>& b, double u) {
  return each<3>([&](std::size_t i) { return std::lerp(a[i], b[i], u); });
}
/// Rotations: along the shorter great circle (Shoemake 1985).
Tuple<4> on_the_way(const Tuple<4>& a, const Tuple<4>& b, double u) {
  const double cosine = dot(a, b), side = cosine < 0.0 ? -1.0 : 1.0;
  const double angle = std::acos(std::min(1.0, std::fabs(cosine)));
  // Close together a straight line is that circle.
  const bool close = angle < 1e-4;
  const double from = close ? 1.0 - u : std::sin((1.0 - u) * angle) / std::sin(angle);
  const double to = close ? u : std::sin(u * angle) / std::sin(angle);
  return each<4>([&](std::size_t i) { return from * a[i] + side * to * b[i]; });
}

/// The keys of one sampler.
template <std::size_t N>
class Track {
 public:
  Track(const GltfModel& gltf, const tinygltf::AnimationSampler& sampler, const std::string& pointer)
      : step_(sampler.interpolation == "STEP"), cubic_(sampler.interpolation == "CUBICSPLINE") {
    if (!step_ && !cubic_ && !sampler.interpolation.empty() && sampler.interpolation != "LINEAR") {
      throw gltf.fault(pointer + "/interpolation", "the word " + in_quotes(sampler.interpolation),
                       one_of(sampler.interpolation, {"LINEAR", "STEP", "CUBICSPLINE"}));
    }
    for (const auto& [time] : read_vectors<1>(gltf, sampler.input, pointer + "/input")) {
      if (!times_.empty() && !(time > times_.back())) {
        throw gltf.fault(
            pointer + "/input",
            "the time " + short_number(time) + " s, not after the one before it, " + short_number(times_.back()) + " s",
            "times that rise");
      }
      times_.push_back(time);
    }
    const auto stored = read_vectors<N>(gltf, sampler.output, pointer + "/output");
    const std::size_t needed = times_.size() * (cubic_ ? 3 : 1);
    if (times_.empty() || stored.size() != needed) {
      throw gltf.fault(pointer + "/output", std::to_string(stored.size()) + " values",
                       times_.empty() ? "at least one key" : std::to_string(needed) + ", as many as the times need");
    }
    for (const auto& value : stored) values_.push_back(each<N>([&](std::size_t i) { return double{value[i]}; }));
  }

  Tuple<N> at(double time) const {
    const auto after = static_cast<std::size_t>(std::upper_bound(times_.begin(), times_.end(), time) - times_.begin());
    if (after == 0) return value(0);
    const std::size_t k = after - 1;
    if (after == times_.size() || step_ || time == times_[k]) return value(k);
    const double span = times_[after] - times_[k], u = (time - times_[k]) / span;
    if (!cubic_) return on_the_way(value(k), value(after), u);
    // Hermite's cubic between the values, with the tangent out of the one key and that into the other.
    const double u2 = u * u, u3 = u2 * u;
    const Tuple<N>&a = value(k), &b = value(after), &out = values_[3 * k + 2], &in = values_[3 * after];
    return each<N>([&](std::size_t i) {
      return (2.0 * u3 - 3.0 * u2 + 1.0) * a[i] + span * (u3 - 2.0 * u2 + u) * out[i] + (3.0 * u2 - 2.0 * u3) * b[i] +
             span * (u3 - u2) * in[i];
    });
  }

 private:
  const Tuple<N>& value(std::size_t key) const { return values_[cubic_ ? 3 * key + 1 : key]; }

  bool step_, cubic_;
  std::vector<double> times_;     // [s]
  std::vector<Tuple<N>> values_;  // cubic: tangent in, value, tangent out of each key
};

Vector vector_of(const Tuple<3>& t) { return {t[0], t[1], t[2]}; }

}  // namespace

std::map<std::size_t, NodePose> poses_at(const GltfModel& gltf, double time, std::set<std::string>& ignored) {
  std::map<std::size_t, NodePose> poses;
  for (std::size_t a = 0; a < gltf.model.animations.size(); ++a) {
    const tinygltf::Animation& animation = gltf.model.animations[a];
    const std::string here = item("/animations", a);
    for (std::size_t c = 0; c < animation.channels.size(); ++c) {
      const tinygltf::AnimationChannel& channel = animation.channels[c];
      const std::string pointer = item(here + "/channels", c);
      if (channel.target_path == "weights") {
        ignored.insert("animations of morph targets");
        continue;
      }
      if (channel.target_path != "translation" && channel.target_path != "rotation" && channel.target_path != "scale") {
        ignored.insert("animations of what is no node");
        continue;
      }
      if (channel.target_node < 0) continue;  // of an extension, or of nothing
      const tinygltf::Node& node = element(gltf, gltf.model.nodes, channel.target_node, pointer + "/target/node");
      const std::string node_pointer = item("/nodes", channel.target_node);
      if (!node.matrix.empty()) {
        throw gltf.fault(node_pointer + "/matrix", "a matrix on a node that " + pointer + " moves",
                         "translation, rotation and scale");
      }
      const tinygltf::AnimationSampler& sampler =
          element(gltf, animation.samplers, channel.sampler, pointer + "/sampler");
      const std::string keys = item(here + "/samplers", channel.sampler);
      NodePose& pose = poses[static_cast<std::size_t>(channel.target_node)];
      const bool taken = channel.target_path == "rotation"      ? pose.rotation.has_value()
                         : channel.target_path == "translation" ? pose.translation.has_value()
                                                                : pose.scale.has_value();
      if (taken) {
        ignored.insert("a second animation of what one moves already");
      } else if (channel.target_path == "rotation") {
        pose.rotation = Track<4>(gltf, sampler, keys).at(time);
      } else {
        (channel.target_path == "scale" ? pose.scale : pose.translation) =
            vector_of(Track<3>(gltf, sampler, keys).at(time));
      }
    }
  }
  return poses;
}

}  // namespace tyndall
