#pragma once
// Functions of Symbols as shader text that reads as if a person wrote it.
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/export/dialect.h"

namespace tyndall {

struct FunctionParameter {
  std::string name;
  bool triple = false;  // then its three numbers are Symbol::input(name, 0), (name, 1), (name, 2)

  Symbol number() const { return Symbol::input(name); }
  Symbol component(int i) const { return Symbol::input(name, i); }
};

/// A function to be printed. Its outputs are one number or three, written in its parameters and constants.
struct FunctionText {
  std::string name;
  std::vector<FunctionParameter> parameters;
  std::vector<Symbol> outputs;
  std::string comment = {};  // printed above it, a comment line for each line
  std::string prefix = {};   // of the names of constant arrays that it reads
};

/// The function alone. It may call helpers and read arrays, see print_functions.
std::string print_function(const Dialect& dialect, const FunctionText& function);

/// All functions in their order, above them each helper and each constant array that they need, once. Helpers stand for
/// elementary functions that the language lacks; their own text is that of elementary.h. Arrays of equal numbers are
/// one.
std::string print_functions(const Dialect& dialect, std::span<const FunctionText> functions);

/// One function with its helpers in GLSL; every input is a number.
std::string glsl_function(const std::string& name, const std::vector<std::string>& inputs,
                          const std::vector<Symbol>& outputs);

}  // namespace tyndall
