#include "tyndall/export/function_text.h"

#include <algorithm>
#include <cassert>

#include "tyndall/export/function_printer.h"
#include "tyndall/number/elementary.h"

namespace tyndall {
namespace {

// The elementary operations that symbols use and the language lacks, in the order of their enumeration.
void collect_missing(const Dialect& dialect, const Symbol& symbol, std::vector<const SymbolNode*>& visited,
                     std::vector<Operation>& missing) {
  const SymbolNode& node = symbol.node();
  if (std::find(visited.begin(), visited.end(), &node) != visited.end()) return;
  visited.push_back(&node);
  for (const Symbol& operand : node.operands) collect_missing(dialect, operand, visited, missing);
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
      if (dialect.function_for(node.operation).empty() &&
          std::find(missing.begin(), missing.end(), node.operation) == missing.end())
        missing.push_back(node.operation);
      break;
    default:
      break;
  }
}

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

}  // namespace

std::string print_function(const Dialect& dialect, const FunctionText& function) {
  return comment_lines(function.comment) + FunctionPrinter(dialect, function).text();
}

std::string print_functions(const Dialect& dialect, std::span<const FunctionText> functions) {
  std::vector<const SymbolNode*> visited;
  std::vector<Operation> missing;
  for (const FunctionText& function : functions)
    for (const Symbol& output : function.outputs) collect_missing(dialect, output, visited, missing);
  std::sort(missing.begin(), missing.end());
  std::string out;
  for (const Operation operation : missing) out += print_function(dialect, helper(operation)) + "\n";
  for (const FunctionText& function : functions)
    out += print_function(dialect, function) + (&function == &functions.back() ? "" : "\n");
  return out;
}

std::string glsl_function(const std::string& name, const std::vector<std::string>& inputs,
                          const std::vector<Symbol>& outputs) {
  FunctionText function{name, {}, outputs, {}};
  for (const std::string& input : inputs) function.parameters.push_back({input});
  return print_functions(glsl_dialect(), {&function, 1});
}

}  // namespace tyndall
