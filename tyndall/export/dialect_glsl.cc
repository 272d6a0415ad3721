// GLSL: the same text serves desktop 3.30 and later, ES 3.00 and later, Vulkan. In ES the including shader declares
// `precision highp float;`.
#include <array>

#include "tyndall/export/dialect.h"

namespace tyndall {
namespace {

std::string_view function_for(Operation operation) {
  switch (operation) {
    case Operation::sqrt:
      return "sqrt";
    case Operation::exp:
      return "exp";
    case Operation::log:
      return "log";
    case Operation::sin:
      return "sin";
    case Operation::cos:
      return "cos";
    case Operation::abs:
      return "abs";
    case Operation::min:
      return "min";
    case Operation::max:
      return "max";
    default:
      // GLSL's own sinh and asinh are specified through exp and log, which lose small arguments altogether.
      return {};
  }
}

// Keywords, reserved words and built-in functions that a parameter or a local could be called.
constexpr auto reserved = std::to_array<std::string_view>(
    {"abs",         "acos",      "acosh",   "active",      "all",       "any",       "asin",      "asinh",
     "asm",         "atan",      "atanh",   "atomic",      "attribute", "barrier",   "bool",      "break",
     "buffer",      "bvec2",     "case",    "cast",        "ceil",      "centroid",  "clamp",     "class",
     "coherent",    "common",    "const",   "continue",    "cos",       "cosh",      "cross",     "dFdx",
     "dFdy",        "default",   "degrees", "determinant", "discard",   "distance",  "do",        "dot",
     "double",      "else",      "enum",    "equal",       "exp",       "exp2",      "extern",    "external",
     "faceforward", "false",     "filter",  "fixed",       "flat",      "float",     "floor",     "fma",
     "for",         "fract",     "frexp",   "fwidth",      "goto",      "half",      "highp",     "if",
     "image",       "in",        "inline",  "inout",       "input",     "int",       "interface", "invariant",
     "inverse",     "isinf",     "isnan",   "ivec2",       "layout",    "ldexp",     "length",    "log",
     "log2",        "long",      "lowp",    "main",        "mat2",      "mat3",      "mat4",      "max",
     "mediump",     "min",       "mix",     "mod",         "modf",      "namespace", "noinline",  "noise",
     "normalize",   "not",       "out",     "output",      "packed",    "partition", "patch",     "pow",
     "precise",     "precision", "public",  "radians",     "readonly",  "reflect",   "refract",   "resource",
     "restrict",    "return",    "round",   "row_major",   "sample",    "shared",    "short",     "sign",
     "sin",         "sinh",      "sizeof",  "smooth",      "sqrt",      "static",    "step",      "struct",
     "subroutine",  "superp",    "switch",  "tan",         "tanh",      "template",  "texture",   "this",
     "transpose",   "true",      "trunc",   "typedef",     "uint",      "uniform",   "union",     "unsigned",
     "using",       "uvec2",     "varying", "vec2",        "vec3",      "vec4",      "void",      "volatile",
     "while",       "writeonly"});

}  // namespace

const Dialect& glsl_dialect() {
  static const Dialect dialect{
      .name = "glsl",
      .number_type = "float",
      .triple_type = "vec3",
      .literal_suffix = "",
      .parameter = "$type $name",
      .function = "$type $name($parameters) {",
      .constant = "const $type $name = $value;",
      .local = "$type $name = $value;",
      .variable = "$type $name = $value;",
      .loop = "for (int $name = 0; $name < $count; ++$name) {",
      .array = "const $type $name[$count] = $type[$count]($values);",
      .lookup = "$name[int($x)]",
      .select = "$mask ? $yes : $no",
      .select_is_call = false,
      .make_triple = "vec3($x, $y, $z)",
      .members = {".x", ".y", ".z"},
      .function_for = function_for,
      .reserved = reserved,
  };
  return dialect;
}

}  // namespace tyndall
