#pragma once
// A shader language as a small set of rules: how to write a literal, a local, a loop, a function; which elementary
// functions it has. Everything else about printing is the same for all (function_text.h).
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "tyndall/number/symbol.h"

namespace tyndall {

/// In the patterns a word after $ is replaced: $type, $name, $value, $parameters, $count, $mask, $yes, $no, $x, $y, $z,
/// $values.
struct Dialect {
  std::string_view name;  // as in `tyndall export --to`
  std::string_view number_type;
  std::string_view triple_type;
  std::string_view literal_suffix;  // after a number, such as f
  std::string_view parameter;       // "$type $name"
  std::string_view function;        // the line that opens a function
  std::string_view constant;        // a local known when the shader is compiled
  std::string_view local;           // a local that keeps its value
  std::string_view variable;        // a local that is assigned to
  std::string_view loop;            // the line that opens a loop
  std::string_view array;           // an array known when the shader is compiled, outside of functions
  std::string_view lookup;          // its number at the index $x, which is a number
  std::string_view select;          // $mask ? $yes : $no, or a call
  bool select_is_call;              // else it is an operator and needs parentheses around it
  std::string_view make_triple;     // "vec3($x, $y, $z)"
  std::string_view members[3];      // ".x", ".y", ".z"
  /// The language's own function for an operation, accurate to a few float roundings; empty if it has none: then a
  /// helper function is printed before the first use (elementary.h).
  std::string_view (*function_for)(Operation);
  std::span<const std::string_view> reserved;  // words that are no names
};

/// The closed list. A new language is a file dialect_<name>.cc, its line here and one in dialect.cc.
const Dialect& glsl_dialect();
std::span<const Dialect* const> dialects();

/// The dialect of that name, or null.
const Dialect* find_dialect(std::string_view name);

/// Replaces each "$word" of the pattern.
std::string fill_pattern(std::string_view pattern,
                         std::initializer_list<std::pair<std::string_view, std::string_view>> words);

/// A float literal that reads back as the nearest float to x, in the fewest digits, always with a decimal point.
/// x must be finite and within float's range: a Symbol's constants are, by the laws' contract.
std::string float_literal(double x);

}  // namespace tyndall
