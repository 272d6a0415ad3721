#pragma once
// For tests: .glb files written from their parts, and folders to put them in.
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

namespace tyndall::tests {

/// An empty folder of a test's own, removed with it.
struct Folder {
  std::filesystem::path path;
  Folder()
      : path(std::filesystem::path(testing::TempDir()) / ("tyndall_scene" + std::to_string(std::random_device()()))) {
    std::filesystem::create_directories(path);
  }
  ~Folder() { std::filesystem::remove_all(path); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes a file into it and returns its path.
  std::filesystem::path put(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((path / name).parent_path());
    std::ofstream(path / name, std::ios::binary) << text;
    return path / name;
  }
  std::filesystem::path put(const std::string& name, const std::vector<std::uint8_t>& bytes) const {
    return put(name, std::string(bytes.begin(), bytes.end()));
  }
};

/// A glTF file under construction: `json` may be changed at will, binary data is appended through the functions.
struct Glb {
  nlohmann::json json =
      nlohmann::json::parse(R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}]})");
  std::vector<std::uint8_t> binary;

  /// Appends values as a buffer view of their own; returns its index.
  template <class T>
  int view(const std::vector<T>& values) {
    while (binary.size() % 4 != 0) binary.push_back(0);
    const std::size_t offset = binary.size(), size = values.size() * sizeof(T);
    binary.resize(offset + size);
    if (size > 0) std::memcpy(binary.data() + offset, values.data(), size);
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }
  /// An accessor on values of its own; `components` of them are one element.
  template <class T>
  int accessor(const std::vector<T>& values, int components) {
    constexpr int type = sizeof(T) == 1   ? (std::is_signed_v<T> ? 5120 : 5121)
                         : sizeof(T) == 2 ? (std::is_signed_v<T> ? 5122 : 5123)
                                          : (std::is_floating_point_v<T> ? 5126 : 5125);
    const char* const names[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
    json["accessors"].push_back({{"bufferView", view(values)},
                                 {"componentType", type},
                                 {"count", values.size() / static_cast<std::size_t>(components)},
                                 {"type", names[components - 1]}});
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  int add(const char* list, nlohmann::json value) {
    json[list].push_back(std::move(value));
    return static_cast<int>(json[list].size()) - 1;
  }
  /// A node below the scene.
  int node(nlohmann::json value) {
    const int index = add("nodes", std::move(value));
    json["scenes"][0]["nodes"].push_back(index);
    return index;
  }
  int light(nlohmann::json value) {
    auto& lights = json["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(value));
    json["extensionsUsed"] = {"KHR_lights_punctual"};
    return static_cast<int>(lights.size()) - 1;
  }
  /// A mesh of one triangle in the plane z = 0, front toward +Z.
  int triangle_mesh() {
    const int positions = accessor<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}, 3);
    return add("meshes", {{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}});
  }

  std::vector<std::uint8_t> bytes() const {
    nlohmann::json whole = json;
    if (!binary.empty()) whole["buffers"] = {{{"byteLength", binary.size()}}};
    std::string text = whole.dump();
    while (text.size() % 4 != 0) text += ' ';
    std::vector<std::uint8_t> data = binary;
    while (data.size() % 4 != 0) data.push_back(0);
    std::vector<std::uint8_t> out;
    const auto put = [&out](std::size_t x) {
      for (int shift = 0; shift < 32; shift += 8) out.push_back(static_cast<std::uint8_t>(x >> shift));
    };
    put(0x46546c67);
    put(2);
    put(12 + 8 + text.size() + (data.empty() ? 0 : 8 + data.size()));
    put(text.size());
    put(0x4e4f534a);
    out.insert(out.end(), text.begin(), text.end());
    if (!data.empty()) {
      put(data.size());
      put(0x004e4942);
      out.insert(out.end(), data.begin(), data.end());
    }
    return out;
  }
};

}  // namespace tyndall::tests
