#pragma once
// Blending medium files.
#include <string>

#include "tyndall/artist/blended.h"
#include "tyndall/document/medium_file.h"

namespace tyndall {

/// The medium at t in [0, 1] between a and b, as a file in a's unit of length; exactly a at 0 and b (in its own unit)
/// at
/// 1. What has keyframes counts as it is at time 0 (at_time() has other times). Throws Fault where the two cannot be
/// blended so, naming `name_for_messages`.
MediumFile blended(const MediumFile& a, const MediumFile& b, double t, BlendHow how,
                   const std::string& name_for_messages = "blend");

}  // namespace tyndall
