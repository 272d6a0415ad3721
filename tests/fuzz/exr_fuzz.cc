// Any bytes as an OpenEXR picture: planes of the size it says, or a message. OpenEXR itself is not instrumented, its
// use of memory is watched all the same.
#include "tests/fuzz/must.h"
#include "tyndall/image/exr.h"

using namespace tyndall;
using fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Image image = parse_exr("fuzz", {data, size});
    for (const Plane& plane : image.planes) must(plane.values.size() == image.pixel_count(), "planes are whole");
  } catch (const Fault& fault) {
    fuzz::must_be_a_message(fault);
  }
  return 0;
}
