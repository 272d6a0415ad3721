// Any bytes as a Radiance picture (.hdr): floats that are not negative, or a message.
#include <cmath>

#include "tests/fuzz/must.h"
#include "tyndall/image/radiance_picture.h"

using namespace tyndall;
using fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Decoded<float> picture = decode_radiance("fuzz", {data, size});
    must(picture.width >= 1 && picture.height >= 1, "it has pixels");
    must(picture.rgb.size() == 3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
         "and all of them");
    for (const float x : picture.rgb) must(std::isfinite(x) && x >= 0.0F, "radiance");
  } catch (const Fault& fault) {
    fuzz::must_be_a_message(fault);
  }
  return 0;
}
