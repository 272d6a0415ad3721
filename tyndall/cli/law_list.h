#pragma once
// The laws of scattering as --help lists them.
#include <string>

namespace tyndall {

/// A line for each law with its parameters, what they may be and their units, from the laws' own descriptions
/// (number/field.h), and how they are typed.
std::string law_list();

}  // namespace tyndall
