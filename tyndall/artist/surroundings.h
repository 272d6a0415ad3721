#pragma once
// What a model of weather is told of the medium that it will be part of.
#include "tyndall/color/spectrum.h"

namespace tyndall {

struct Surroundings {
  Spectrum extinction;      // at the origin [1/m], of all that is in the medium besides the model
  Spectrum wavelengths_nm;  // of the channels
  double pressure;          // of the air at the origin [Pa]
};

/// The channel in which visibility is stated: green.
inline constexpr std::size_t visibility_channel = 1;

}  // namespace tyndall
