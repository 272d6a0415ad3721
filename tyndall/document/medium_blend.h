#pragma once
// Blending medium files.
#include <array>
#include <string_view>

#include "tyndall/document/medium_file.h"

namespace tyndall {

/// The ways to blend: the dials (blend.h), the media (mix.h), or as the eye judges thickness (morph.h).
enum class BlendHow { interpolate, mix, morph };
constexpr std::array<std::string_view, 3> words_of(BlendHow) { return {"interpolate", "mix", "morph"}; }

/// The medium at t in [0, 1] between a and b, as a file in a's unit of length; exactly a at 0 and b (in its own unit)
/// at
/// 1. Throws Fault where the two cannot be blended so, naming `name_for_messages`.
MediumFile blended(const MediumFile& a, const MediumFile& b, double t, BlendHow how,
                   const std::string& name_for_messages = "blend");

}  // namespace tyndall
