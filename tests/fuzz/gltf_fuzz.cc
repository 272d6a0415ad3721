// Any bytes as a .glb or .gltf file: parsed, and every accessor read with its bounds checked, or a message. tinygltf
// itself is not instrumented, its use of memory is watched all the same.
#include "tests/fuzz/must.h"
#include "tyndall/scene/gltf_model.h"

using namespace tyndall;
using fuzz::must;

namespace {

template <class Read>
void attempt(Read read) {
  try {
    read();
  } catch (const Fault& fault) {
    fuzz::must_be_a_message(fault);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  attempt([&] {
    const GltfModel gltf = parse_gltf("/dev/null/fuzz.glb", {data, size}, false);
    for (int i = 0; i < static_cast<int>(gltf.model.accessors.size()) && i < 100; ++i) {
      // A count is a claim; beyond this the target would only measure memory.
      if (gltf.model.accessors[static_cast<std::size_t>(i)].count > 1000000) continue;
      attempt([&] { read_indices(gltf, i, "/accessors"); });
      attempt([&] { read_vectors<2>(gltf, i, "/accessors"); });
      attempt([&] {
        for (const auto& v : read_vectors<3>(gltf, i, "/accessors")) {
          must(v[0] - v[0] == 0.0F && v[1] - v[1] == 0.0F && v[2] - v[2] == 0.0F, "finite");
        }
      });
    }
  });
  return 0;
}
