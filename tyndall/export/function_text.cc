#include "tyndall/export/function_text.h"

#include <algorithm>
#include <cassert>
#include <unordered_set>

#include "tyndall/export/array_names.h"
#include "tyndall/export/function_printer.h"
#include "tyndall/number/elementary.h"

namespace tyndall {
namespace {

// What functions need above them.
struct Needs {
  std::vector<Operation> missing;  // elementary operations that the language lacks, in the order of their enumeration
  ArrayNames arrays;
};

class NeedsOf {
 public:
  NeedsOf(const Dialect& dialect, std::span<const FunctionText> functions)
      : dialect_(dialect), needs_{{}, ArrayNames(dialect.reserved)} {
    for (const FunctionText& function : functions) {
      needs_.arrays.avoid(function.name);
      for (const FunctionParameter& parameter : function.parameters) needs_.arrays.avoid(parameter.name);
    }
    for (const FunctionText& function : functions)
      for (const Symbol& output : function.outputs) collect(output, function.prefix);
    std::sort(needs_.missing.begin(), needs_.missing.end());
  }
  const Needs* operator->() const { return &needs_; }

 private:
  void collect(const Symbol& symbol, const std::string& prefix) {
    const SymbolNode& node = symbol.node();
    if (!visited_.insert(&node).second) return;
    for (const Symbol& operand : node.operands) collect(operand, prefix);
    std::vector<Operation>& missing = needs_.missing;
    switch (node.operation) {
      case Operation::sqrt:
      case Operation::cbrt:
      case Operation::exp:
      case Operation::expm1:
      case Operation::log:
      case Operation::sin:
      case Operation::cos:
      case Operation::sinh:
      case Operation::asinh:
        if (dialect_.function_for(node.operation).empty() &&
            std::find(missing.begin(), missing.end(), node.operation) == missing.end())
          missing.push_back(node.operation);
        break;
      case Operation::lookup:
        needs_.arrays.add(node.array, prefix);
        break;
      default:
        break;
    }
  }

  const Dialect& dialect_;
  Needs needs_;
  std::unordered_set<const SymbolNode*> visited_;
};

FunctionText helper(Operation operation) {
  const FunctionParameter x{"x"};
  FunctionText text{helper_name(operation), {x}, {}, {}};
  switch (operation) {
    case Operation::expm1:
      text.comment = "exp(x) - 1 with all its digits near 0.";
      text.outputs = {expm1_from_exp(x.number())};
      break;
    case Operation::sinh:
      text.comment = "sinh(x) with all its digits near 0.";
      text.outputs = {sinh_from_exp(x.number())};
      break;
    case Operation::asinh:
      text.comment = "asinh(x) with all its digits near 0 and for negative x.";
      text.outputs = {asinh_from_log(x.number())};
      break;
    case Operation::cbrt:
      text.comment = "The real cube root, for negative x too.";
      text.outputs = {cbrt_from_exp(x.number())};
      break;
    default:
      assert(false);  // every language has sqrt, exp, log, sin and cos
  }
  return text;
}

// Texts are data: a comment must end where its line ends, so no control characters and no backslash (which would
// continue it).
std::string comment_lines(const std::string& comment) {
  if (comment.empty()) return {};
  std::string out = "// ";
  for (const char c : comment) {
    if (c == '\n') {
      out += "\n// ";
    } else {
      out += (static_cast<unsigned char>(c) < 0x20 || c == 0x7f || c == '\\') ? ' ' : c;
    }
  }
  return out + "\n";
}

std::string text_of(const Dialect& dialect, const FunctionText& function, const ArrayNames& arrays) {
  return comment_lines(function.comment) + FunctionPrinter(dialect, function, arrays).text();
}

// An array with its numbers in lines.
std::string array_text(const Dialect& dialect, const ArrayNames::Entry& entry) {
  std::string values, line;
  for (const double x : entry.array->values()) {
    const std::string number = float_literal(x) + std::string(dialect.literal_suffix);
    if (!line.empty() && line.size() + number.size() + 6 > line_length) {
      values += line + ",\n    ";
      line.clear();
    }
    line += (line.empty() ? "" : ", ") + number;
  }
  values += line;
  if (values.size() + entry.name.size() + 30 > line_length) values.insert(0, "\n    ");
  return fill_pattern(dialect.array, {{"type", dialect.number_type},
                                      {"name", entry.name},
                                      {"count", std::to_string(entry.array->size())},
                                      {"values", values}}) +
         "\n";
}

}  // namespace

std::string print_function(const Dialect& dialect, const FunctionText& function) {
  return text_of(dialect, function, NeedsOf(dialect, {&function, 1})->arrays);
}

std::string print_functions(const Dialect& dialect, std::span<const FunctionText> functions) {
  const NeedsOf needs(dialect, functions);
  std::string out;
  for (const Operation operation : needs->missing) out += text_of(dialect, helper(operation), needs->arrays) + "\n";
  for (const ArrayNames::Entry& entry : needs->arrays.entries()) out += array_text(dialect, entry) + "\n";
  for (const FunctionText& function : functions)
    out += text_of(dialect, function, needs->arrays) + (&function == &functions.back() ? "" : "\n");
  return out;
}

std::string glsl_function(const std::string& name, const std::vector<std::string>& inputs,
                          const std::vector<Symbol>& outputs) {
  FunctionText function{name, {}, outputs, {}};
  for (const std::string& input : inputs) function.parameters.push_back({input});
  return print_functions(glsl_dialect(), {&function, 1});
}

}  // namespace tyndall
