#pragma once
// A law's five functions as shader text.
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/export/function_text.h"
#include "tyndall/phase/law.h"

namespace tyndall {

/// A law whose numbers are function parameters.
struct SymbolicLaw {
  Law<Symbol> law;
  std::vector<FunctionParameter> parameters;  // in the order of the law's fields
};

/// The law with each of its numbers replaced by a parameter, named as its field; in a mixture numbered by part:
/// weight_1, g_1, weight_2, ... Only the structure of `law` counts: which laws, how many parts.
SymbolicLaw symbolic_law(const Law<double>& law);

/// The numbers that symbolic_law replaced, in the order of its parameters.
std::vector<double> law_parameters(const Law<double>& law);

/// The functions of a law, their names starting with `prefix` (say "henyey_greenstein"; it must be an identifier):
///   float <prefix>_density(vec3 deflection, float ...)     phase function [1/sr]
///   float <prefix>_cdf(vec3 deflection, float ...)
///   vec3 <prefix>_sample(float xi, float ...)              a deflection
///   float <prefix>_mean_cosine(float ...)
///   float <prefix>_moment_<l>(float ...)                   Legendre moments, l = 2 .. last_moment
/// where a deflection is (mu, 1 - mu, 1 + mu).
std::vector<FunctionText> law_functions(std::string_view prefix, const Law<double>& law, int last_moment = 4);

/// The law's own name: "henyey_greenstein", ...
std::string_view law_name(const Law<double>& law);

}  // namespace tyndall
