// Any bytes as a PNG or JPEG texture: pixels of the size it says, or a message.
#include "tests/fuzz/must.h"
#include "tyndall/image/decode.h"

using namespace tyndall;
using fuzz::must;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const Decoded<std::uint8_t> picture = decode_picture("fuzz", {data, size});
    must(picture.rgb.size() == 3 * static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height),
         "pixels are whole");
  } catch (const Fault& fault) {
    fuzz::must_be_a_message(fault);
  }
  return 0;
}
