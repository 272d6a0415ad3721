#pragma once
// Radiance pictures (.hdr, .pic; RGBE): Ward, "Real Pixels", Graphics Gems II (1991), and Radiance's own file formats.
//
// Our own reader, not stb_image's: that of Debian 12 (2.27) never comes back from a run-length coded file cut short.
#include <cstdint>
#include <span>
#include <string>

#include "tyndall/image/decode.h"

namespace tyndall {

/// A Radiance picture as linear floats, top row first: mantissa x 2^(exponent - 136), as stb_image, OpenImageIO and
/// most renderers read it. Lines EXPOSURE and COLORCORR are not applied, as there. Rows in either direction, flat or
/// run-length coded in the new or the old way; XYZE and pictures by columns are refused. Sizes are checked before
/// anything is allocated: no file gives more pixels than its bytes can stand for. Throws Fault {where, ..}.
Decoded<float> decode_radiance(const std::string& where, std::span<const std::uint8_t> bytes);

}  // namespace tyndall
