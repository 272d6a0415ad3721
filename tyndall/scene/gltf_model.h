#pragma once
// A glTF file as tinygltf parsed it, and its numbers read with every bound checked. For the .cc files of the glTF
// reader only: whoever includes this compiles tinygltf.
#include <tiny_gltf.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tyndall/document/json_text.h"

namespace tyndall {

/// The most vertices, and the most triangles, that a scene may have.
inline constexpr std::size_t most_elements = 100'000'000;

struct GltfModel {
  JsonText json;                // of the whole .gltf, or of a .glb's first chunk
  bool binary;                  // a .glb: it has no lines
  tinygltf::Model model;        // its images hold the bytes of picture files, not pixels
  std::optional<Fault> unread;  // why a picture file it refers to could not be read

  /// A Fault about the value at a JSON pointer.
  Fault fault(const std::string& pointer, std::string found, std::string expected) const;
};

/// A JSON pointer extended by an index.
template <class Index>
std::string item(const std::string& pointer, Index index) {
  return pointer + "/" + std::to_string(index);
}

/// Parses a file's bytes and reads the buffers and pictures it refers to. Throws Fault: for damaged files, references
/// that lead nowhere or out of the folder (unless allow_path), and required extensions that are not supported.
GltfModel parse_gltf(const std::filesystem::path& file, std::span<const std::uint8_t> bytes, bool allow_path);

/// An element of a list of the model, checked: Fault at `pointer` when there is no element `index`.
template <class T>
const T& element(const GltfModel& gltf, const std::vector<T>& list, int index, const std::string& pointer) {
  if (index < 0 || static_cast<std::size_t>(index) >= list.size()) {
    throw gltf.fault(
        pointer, "the index " + std::to_string(index),
        list.empty() ? "no index: the list is empty" : "an index from 0 to " + std::to_string(list.size() - 1));
  }
  return list[static_cast<std::size_t>(index)];
}

/// The elements of an accessor of N-vectors as floats; integers are normalised where the accessor says so, and sparse
/// elements are in place. Throws Fault, also for values that are not finite. `pointer` is where the accessor is named.
template <std::size_t N>
std::vector<std::array<float, N>> read_vectors(const GltfModel& gltf, int accessor, const std::string& pointer);
extern template std::vector<std::array<float, 1>> read_vectors<1>(const GltfModel&, int, const std::string&);
extern template std::vector<std::array<float, 2>> read_vectors<2>(const GltfModel&, int, const std::string&);
extern template std::vector<std::array<float, 3>> read_vectors<3>(const GltfModel&, int, const std::string&);
extern template std::vector<std::array<float, 4>> read_vectors<4>(const GltfModel&, int, const std::string&);

/// The elements of an accessor of unsigned scalars.
std::vector<std::uint32_t> read_indices(const GltfModel& gltf, int accessor, const std::string& pointer);

}  // namespace tyndall
