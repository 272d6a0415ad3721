#include "tyndall/scene/gltf_model.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>

#include "tyndall/document/file_kind.h"
#include "tyndall/document/json_locator.h"
#include "tyndall/document/reference.h"
#include "tyndall/document/spelling.h"
#include "tyndall/document/whole_file.h"
#include "tyndall/scene/gltf_rules.h"

namespace tyndall {
namespace {

using Bytes = std::span<const std::uint8_t>;

std::uint32_t little_endian(Bytes b, std::size_t at) {
  return b[at] | static_cast<std::uint32_t>(b[at + 1]) << 8 | static_cast<std::uint32_t>(b[at + 2]) << 16 |
         static_cast<std::uint32_t>(b[at + 3]) << 24;
}

bool is_binary(Bytes bytes) { return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0; }

/// The JSON of a file: all of a .gltf, the first chunk of a .glb (glTF 2.0, "GLB File Format Specification").
std::string json_of(const std::string& where, Bytes bytes) {
  if (!is_binary(bytes)) return {bytes.begin(), bytes.end()};
  const std::string expected = "a whole glTF 2.0 binary file";
  if (bytes.size() < 20) throw Fault(where, "a .glb file cut short", expected);
  if (little_endian(bytes, 4) != 2) throw Fault(where, "a .glb file of another version", expected);
  const std::uint32_t length = little_endian(bytes, 12);
  if (little_endian(bytes, 8) > bytes.size() || length > bytes.size() - 20) {
    throw Fault(where, "a .glb file cut short", expected);
  }
  if (little_endian(bytes, 16) != 0x4e4f534a) throw Fault(where, "a .glb file without JSON in front", expected);
  return {bytes.begin() + 20, bytes.begin() + 20 + length};
}

std::string percent_decoded(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    unsigned code = 0;
    const char* const digits = uri.data() + i + 1;
    if (uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2) {
      text += static_cast<char>(code);
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

/// Where a model names the file `name`; empty where it cannot be found. tinygltf decodes names and forgets places.
std::string pointer_of_uri(const Json& root, const std::string& name) {
  for (const char* const list : {"buffers", "images"}) {
    for (std::size_t i = 0; root.contains(list) && i < root[list].size(); ++i) {
      const auto uri = root[list][i].find("uri");
      if (uri == root[list][i].end()) continue;
      const auto& text = uri->get_ref<const std::string&>();
      if (text == name || percent_decoded(text) == name) return item(std::string("/") + list, i) + "/uri";
    }
  }
  return "";
}

/// What tinygltf reads through us, and what became of it.
struct Folder {
  const GltfModel& gltf;
  std::filesystem::path file;
  bool allow_path;
  std::optional<Fault> fault;
};

bool read_for_tinygltf(std::vector<unsigned char>* out, std::string*, const std::string& name, void* user) {
  Folder& folder = *static_cast<Folder*>(user);
  try {
    const std::string where = folder.gltf.fault(pointer_of_uri(folder.gltf.json.root, name), "", "").where;
    *out = read_whole_file(referenced_file(folder.file, name, folder.allow_path, where));
    return true;
  } catch (const Fault& fault) {
    if (!folder.fault) folder.fault = fault;
    return false;
  }
}

/// Keeps a picture file as it is: it is decoded when a material needs it.
bool keep_picture(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                  int size, void*) {
  image->image.assign(bytes, bytes + size);
  image->as_is = true;
  return true;
}

/// The part of tinygltf's complaint that is about the format; what follows may quote the file.
std::string complaint(const std::string& error) {
  const std::string text = error.substr(
      0, std::min({error.find('\n'), error.find('"'), error.find(':'), error.find('['), std::size_t{120}}));
  return text.empty() ? "" : " (" + printable(text) + ")";
}

void check_extensions(const GltfModel& gltf) {
  constexpr std::array<std::string_view, 5> supported{"KHR_lights_punctual", "KHR_materials_emissive_strength",
                                                      "KHR_texture_transform", "KHR_mesh_quantization",
                                                      "KHR_materials_ior"};
  const Json& root = gltf.json.root;
  if (!root.is_object()) throw gltf.fault("", described(root), "a glTF file");
  if (!root.contains("extensionsRequired")) return;
  const Json& required = root["extensionsRequired"];
  if (!required.is_array()) throw gltf.fault("/extensionsRequired", described(required), "a list of names");
  for (std::size_t i = 0; i < required.size(); ++i) {
    const std::string pointer = "/extensionsRequired/" + std::to_string(i);
    if (!required[i].is_string()) throw gltf.fault(pointer, described(required[i]), "a name");
    const auto& name = required[i].get_ref<const std::string&>();
    if (std::ranges::find(supported, name) == supported.end()) {
      throw gltf.fault(pointer, "the required extension " + in_quotes(name),
                       one_of(name, {supported.begin(), supported.end()}));
    }
  }
}

}  // namespace

Fault GltfModel::fault(const std::string& pointer, std::string found, std::string expected) const {
  return {place(json.file, binary ? 0 : line_of_pointer(json.text, pointer), pointer), std::move(found),
          std::move(expected)};
}

GltfModel parse_gltf(const std::filesystem::path& file, Bytes bytes, bool allow_path) {
  const std::string where = place(file.string());
  GltfModel gltf{parse_json(json_of(where, bytes), file.string()), is_binary(bytes), {}, {}};
  refuse_other_kinds(gltf.json, FileKind::model);
  check_extensions(gltf);
  check_gltf_rules(gltf);

  Folder folder{gltf, file, allow_path, {}};
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(keep_picture, nullptr);
  reader.SetFsCallbacks(
      {[](const std::string&, void*) { return true; }, [](const std::string& name, void*) { return name; },
       read_for_tinygltf,
       [](std::string*, const std::string&, const std::vector<unsigned char>&, void*) { return false; }, &folder});
  std::string error, warning;
  bool good = false;
  try {
    const auto size = static_cast<unsigned>(bytes.size());
    good = is_binary(bytes) ? reader.LoadBinaryFromMemory(&gltf.model, &error, &warning, bytes.data(), size)
                            : reader.LoadASCIIFromString(&gltf.model, &error, &warning,
                                                         reinterpret_cast<const char*>(bytes.data()), size, "");
  } catch (const std::exception&) {
    // Malformed input makes tinygltf throw std::bad_alloc and nlohmann's exceptions.
    throw Fault(where, "a file that breaks the rules of glTF", "a sound glTF 2.0 file");
  }
  if (!good && folder.fault) throw *folder.fault;
  if (!good) throw Fault(where, "a file that breaks the rules of glTF" + complaint(error), "a sound glTF 2.0 file");
  if (gltf.model.asset.version.substr(0, 2) != "2.") throw gltf.fault("/asset/version", "another version", "2.0");
  gltf.unread = folder.fault;
  return gltf;
}

namespace {

std::size_t component_size(int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
      return 4;
    default:
      return 0;
  }
}

template <class T>
T load(const std::uint8_t* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

/// One component; normalised integers as glTF 2.0 section 3.6.2.2 says.
float component(const std::uint8_t* at, int type, bool normalized) {
  const auto scaled = [normalized](float value, float most) {
    return normalized ? std::max(value / most, -1.0F) : value;
  };
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
      return scaled(load<std::int8_t>(at), 127.0F);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return scaled(*at, 255.0F);
    case TINYGLTF_COMPONENT_TYPE_SHORT:
      return scaled(load<std::int16_t>(at), 32767.0F);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return scaled(load<std::uint16_t>(at), 65535.0F);
    default:
      return load<float>(at);
  }
}

std::uint32_t unsigned_scalar(const std::uint8_t* at, int type) {
  switch (type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return *at;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load<std::uint16_t>(at);
    default:
      return load<std::uint32_t>(at);
  }
}

bool is_unsigned(int type) {
  return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
         type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// `count` elements in a buffer view, known to be there; `first` is null for an accessor without one: zeros.
struct Elements {
  const std::uint8_t* first = nullptr;
  std::size_t stride = 0;
  const std::uint8_t* operator[](std::size_t i) const { return first + i * stride; }
};

Elements elements(const GltfModel& gltf, int view_index, std::size_t offset, std::size_t count, std::size_t size,
                  const std::string& pointer) {
  const tinygltf::BufferView& view = element(gltf, gltf.model.bufferViews, view_index, pointer + "/bufferView");
  const std::string view_pointer = "/bufferViews/" + std::to_string(view_index);
  const tinygltf::Buffer& buffer = element(gltf, gltf.model.buffers, view.buffer, view_pointer + "/buffer");
  if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset) {
    throw gltf.fault(view_pointer, "a view that reaches beyond its buffer",
                     "at most the buffer's " + std::to_string(buffer.data.size()) + " bytes");
  }
  const std::size_t stride = view.byteStride == 0 ? size : view.byteStride;
  // No overflow below: count is at most most_elements, and a stride is at most 252 (glTF 2.0, 5.11.4).
  if (stride < size || stride > 252) {
    throw gltf.fault(view_pointer + "/byteStride", std::to_string(stride), "0, or from the element's size to 252");
  }
  if (offset > view.byteLength || (count > 0 && (count - 1) * stride + size > view.byteLength - offset)) {
    throw gltf.fault(pointer, std::to_string(count) + " elements that reach beyond their buffer view",
                     "at most the view's " + std::to_string(view.byteLength) + " bytes");
  }
  return {buffer.data.data() + view.byteOffset + offset, stride};
}

/// Calls put(i, bytes of element i or null for zeros) for all elements, sparse ones last.
template <class Put>
void visit_elements(const GltfModel& gltf, int index, std::size_t components, Put put) {
  const tinygltf::Accessor& accessor = gltf.model.accessors[static_cast<std::size_t>(index)];
  const std::string pointer = "/accessors/" + std::to_string(index);
  const std::size_t size = components * component_size(accessor.componentType);
  if (accessor.bufferView >= 0) {
    const Elements dense = elements(gltf, accessor.bufferView, accessor.byteOffset, accessor.count, size, pointer);
    for (std::size_t i = 0; i < accessor.count; ++i) put(i, dense[i]);
  }
  if (!accessor.sparse.isSparse) return;
  const auto& sparse = accessor.sparse;
  const std::string sparse_pointer = pointer + "/sparse";
  if (sparse.count < 0 || static_cast<std::size_t>(sparse.count) > accessor.count) {
    throw gltf.fault(sparse_pointer + "/count", std::to_string(sparse.count), "at most the accessor's count");
  }
  const auto count = static_cast<std::size_t>(sparse.count);
  if (!is_unsigned(sparse.indices.componentType)) {
    throw gltf.fault(sparse_pointer + "/indices/componentType", std::to_string(sparse.indices.componentType),
                     "5121, 5123 or 5125");
  }
  if (sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
    throw gltf.fault(sparse_pointer, "a negative byteOffset", "0 or more");
  }
  const Elements places = elements(gltf, sparse.indices.bufferView, static_cast<std::size_t>(sparse.indices.byteOffset),
                                   count, component_size(sparse.indices.componentType), sparse_pointer + "/indices");
  const Elements values = elements(gltf, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
                                   count, size, sparse_pointer + "/values");
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t at = unsigned_scalar(places[i], sparse.indices.componentType);
    if (at >= accessor.count) {
      throw gltf.fault(sparse_pointer + "/indices", "the index " + std::to_string(at),
                       "less than the accessor's count, " + std::to_string(accessor.count));
    }
    put(at, values[i]);
  }
}

const tinygltf::Accessor& checked_accessor(const GltfModel& gltf, int index, const std::string& pointer, int type,
                                           const char* type_name) {
  const tinygltf::Accessor& accessor = element(gltf, gltf.model.accessors, index, pointer);
  const std::string accessor_pointer = "/accessors/" + std::to_string(index);
  if (accessor.type != type) throw gltf.fault(accessor_pointer + "/type", "another type", type_name);
  if (component_size(accessor.componentType) == 0) {
    throw gltf.fault(accessor_pointer + "/componentType", std::to_string(accessor.componentType),
                     "5120, 5121, 5122, 5123, 5125 or 5126");
  }
  if (accessor.count > most_elements) {
    throw gltf.fault(accessor_pointer + "/count", std::to_string(accessor.count),
                     "at most " + std::to_string(most_elements));
  }
  return accessor;
}

}  // namespace

template <std::size_t N>
std::vector<std::array<float, N>> read_vectors(const GltfModel& gltf, int index, const std::string& pointer) {
  static_assert(TINYGLTF_TYPE_VEC2 == 2 && TINYGLTF_TYPE_VEC3 == 3 && TINYGLTF_TYPE_VEC4 == 4);
  constexpr int type = N == 1 ? TINYGLTF_TYPE_SCALAR : static_cast<int>(N);
  constexpr const char* names[] = {"\"SCALAR\"", "\"VEC2\"", "\"VEC3\"", "\"VEC4\""};
  const tinygltf::Accessor& accessor = checked_accessor(gltf, index, pointer, type, names[N - 1]);
  if (accessor.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT) {
    throw gltf.fault("/accessors/" + std::to_string(index) + "/componentType", "5125",
                     "5120, 5121, 5122, 5123 or 5126");
  }
  const std::size_t size = component_size(accessor.componentType);
  std::vector<std::array<float, N>> values(accessor.count);
  visit_elements(gltf, index, N, [&](std::size_t i, const std::uint8_t* at) {
    for (std::size_t c = 0; c < N; ++c)
      values[i][c] = component(at + c * size, accessor.componentType, accessor.normalized);
    if (!std::ranges::all_of(values[i], [](float x) { return std::isfinite(x); })) {
      throw gltf.fault("/accessors/" + std::to_string(index),
                       "a value that is not finite, in element " + std::to_string(i), "finite numbers");
    }
  });
  return values;
}
template std::vector<std::array<float, 1>> read_vectors<1>(const GltfModel&, int, const std::string&);
template std::vector<std::array<float, 2>> read_vectors<2>(const GltfModel&, int, const std::string&);
template std::vector<std::array<float, 3>> read_vectors<3>(const GltfModel&, int, const std::string&);
template std::vector<std::array<float, 4>> read_vectors<4>(const GltfModel&, int, const std::string&);

std::vector<std::uint32_t> read_indices(const GltfModel& gltf, int index, const std::string& pointer) {
  const tinygltf::Accessor& accessor = checked_accessor(gltf, index, pointer, TINYGLTF_TYPE_SCALAR, "\"SCALAR\"");
  if (!is_unsigned(accessor.componentType)) {
    throw gltf.fault("/accessors/" + std::to_string(index) + "/componentType", std::to_string(accessor.componentType),
                     "5121, 5123 or 5125");
  }
  std::vector<std::uint32_t> values(accessor.count);
  visit_elements(gltf, index, 1, [&](std::size_t i, const std::uint8_t* at) {
    values[i] = unsigned_scalar(at, accessor.componentType);
  });
  return values;
}

}  // namespace tyndall
