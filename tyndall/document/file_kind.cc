#include "tyndall/document/file_kind.h"

#include <array>
#include <fstream>
#include <string>

#include "tyndall/document/json_locator.h"
#include "tyndall/document/spelling.h"

namespace tyndall {
namespace {

using namespace std::string_view_literals;

struct Signature {
  std::string_view start, what;
};

constexpr std::string_view binary_model = "a glTF model (.glb)";

constexpr Signature signatures[] = {
    {"glTF"sv, binary_model},
    {"v/1\x01"sv, "an EXR picture"},
    {"\x89PNG"sv, "a PNG picture"},
    {"\xff\xd8\xff"sv, "a JPEG picture"},
    {"#?R"sv, "a Radiance picture (.hdr)"},
    {"\x20\x42\x44\x56\0\0\0\0"sv, "an OpenVDB volume (.vdb)"},
    {"BLENDER"sv, "a Blender file"},
    {"Kaydara FBX"sv, "an FBX model"},
    {"#usda"sv, "a USD scene"},
    {"PXR-USDC"sv, "a USD scene"},
    {"<"sv, "XML or HTML text"},
    {"%PDF"sv, "a PDF document"},
    {"PK\x03\x04"sv, "a ZIP archive"},
    {"\x1f\x8b"sv, "a gzip archive"},
    {"\x7f"
     "ELF"sv,
     "a program"},
};

std::string_view expected_of(FileKind asked) {
  switch (asked) {
    case FileKind::medium:
      return "a medium (tyndall-medium/1): the name of a *.medium.json or of a preset";
    case FileKind::scene:
      return "a scene: a *.scene.json (tyndall-scene/1), .glb or .gltf";
    default:
      return "a glTF model (.glb or .gltf)";
  }
}

/// What to do with the thing that was found, where that is known.
std::string_view advice(std::string_view found, FileKind asked) {
  if (asked == FileKind::medium && (found.starts_with("a scene") || found.starts_with("a glTF"))) {
    return "; tyndall render and probe take scenes";
  }
  if (asked == FileKind::scene && found.starts_with("a medium")) return "; --medium puts a medium into one";
  if (asked == FileKind::scene && found.starts_with("a glTF")) return "; the name of a model ends so";
  return "";
}

[[noreturn]] void refuse(const std::string& where, const std::string& found, FileKind asked) {
  throw Fault(where, found, std::string(expected_of(asked)).append(advice(found, asked)));
}

}  // namespace

std::string_view kind_of_start(std::string_view start) {
  if (start.empty()) return "an empty file";
  for (const Signature& signature : signatures) {
    if (start.starts_with(signature.start)) return signature.what;
  }
  return {};
}

void refuse_other_kinds(const std::filesystem::path& file, FileKind asked) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) return;
  std::array<char, 32> start{};
  std::ifstream in(file, std::ios::binary);
  if (!in) return;
  in.read(start.data(), start.size());
  const std::string_view found = kind_of_start({start.data(), static_cast<std::size_t>(in.gcount())});
  if (found.empty() || (asked == FileKind::model && found == binary_model)) return;
  refuse(place(file.string()), std::string(found), asked);
}

void refuse_other_kinds(const JsonText& json, FileKind asked) {
  const Json& root = json.root;
  if (!root.is_object()) return;
  const auto refuse_at = [&](const std::string& pointer, const std::string& found) {
    refuse(place(json.file, line_of_pointer(json.text, pointer), pointer), found, asked);
  };
  if (const auto format = root.find("format"); format != root.end()) {
    if (!format->is_string()) return;
    const auto& text = format->get_ref<const std::string&>();
    const std::string quoted = " (" + printable(text, 40) + ")";
    if (asked != FileKind::medium && text.starts_with("tyndall-medium/")) refuse_at("/format", "a medium" + quoted);
    if (asked != FileKind::scene && text.starts_with("tyndall-scene/")) refuse_at("/format", "a scene" + quoted);
    return;
  }
  const auto has = [&](const char* key) { return root.contains(key); };
  if (asked == FileKind::model) return;
  if (has("asset") && root["asset"].is_object()) refuse_at("/asset", "a glTF model (.gltf)");
  if (has("$schema") && has("definitions")) refuse_at("", "a JSON Schema");
  if (has("extinction") && has("mean_free_path")) refuse_at("", "the numbers that tyndall show prints");
}

}  // namespace tyndall
