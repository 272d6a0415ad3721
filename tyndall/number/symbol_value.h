#pragma once
// What a Symbol is worth when its inputs are numbers: for folding constants, and for tests of recorded texts.
#include <algorithm>
#include <map>
#include <span>
#include <string>
#include <unordered_map>

#include "tyndall/number/symbol.h"

namespace tyndall {

/// One operation on numbers; masks are 0 and 1. Constants, inputs, states, loops and
/// lookups are no operations on numbers: NaN.
inline double evaluate(Operation operation, std::span<const double> x) {
  switch (operation) {
    case Operation::named:
      return x[0];
    case Operation::negate:
      return -x[0];
    case Operation::sqrt:
      return std::sqrt(x[0]);
    case Operation::cbrt:
      return std::cbrt(x[0]);
    case Operation::exp:
      return std::exp(x[0]);
    case Operation::expm1:
      return std::expm1(x[0]);
    case Operation::log:
      return std::log(x[0]);
    case Operation::sin:
      return std::sin(x[0]);
    case Operation::cos:
      return std::cos(x[0]);
    case Operation::sinh:
      return std::sinh(x[0]);
    case Operation::asinh:
      return std::asinh(x[0]);
    case Operation::abs:
      return std::fabs(x[0]);
    case Operation::add:
      return x[0] + x[1];
    case Operation::subtract:
      return x[0] - x[1];
    case Operation::multiply:
      return x[0] * x[1];
    case Operation::divide:
      return x[0] / x[1];
    case Operation::min:
      return std::min(x[0], x[1]);
    case Operation::max:
      return std::max(x[0], x[1]);
    case Operation::less:
      return x[0] < x[1];
    case Operation::greater:
      return x[0] > x[1];
    case Operation::less_equal:
      return x[0] <= x[1];
    case Operation::greater_equal:
      return x[0] >= x[1];
    case Operation::select:
      return x[0] != 0.0 ? x[1] : x[2];
    case Operation::fma:
      return std::fma(x[0], x[1], x[2]);
    case Operation::constant:
    case Operation::input:
    case Operation::state:
    case Operation::loop:
    case Operation::result:
    case Operation::lookup:
      break;
  }
  return std::nan("");
}

/// Evaluates expression graphs in double. Inputs that are not given are NaN.
class SymbolValue {
 public:
  /// Keys are the names of inputs; a triple's members are "name.0", "name.1", "name.2".
  explicit SymbolValue(std::map<std::string, double> inputs) : inputs_(std::move(inputs)) {}

  double operator()(const Symbol& symbol) const {
    Known known;
    return value(symbol, {}, known);
  }

 private:
  using Known = std::unordered_map<const SymbolNode*, double>;

  double value(const Symbol& symbol, const Known& states, Known& known) const {
    const SymbolNode& node = symbol.node();
    if (const auto found = known.find(&node); found != known.end()) return found->second;
    double result = std::nan("");
    switch (node.operation) {
      case Operation::constant:
        result = node.value;
        break;
      case Operation::input:
        result = input(node);
        break;
      case Operation::state:
        result = states.at(&node);
        break;
      case Operation::result:
        result = loop_result(node.operands[0].node(), static_cast<std::size_t>(node.value), states, known);
        break;
      case Operation::loop:
        break;
      case Operation::lookup:
        result = tyndall::lookup(node.array, value(node.operands[0], states, known));
        break;
      default: {
        std::vector<double> operands;
        for (const Symbol& operand : node.operands) operands.push_back(value(operand, states, known));
        result = evaluate(node.operation, operands);
      }
    }
    known.emplace(&node, result);
    return result;
  }

  double input(const SymbolNode& node) const {
    const std::string member = node.value < 0.0 ? "" : "." + std::to_string(static_cast<int>(node.value));
    const auto found = inputs_.find(node.text + member);
    return found == inputs_.end() ? std::nan("") : found->second;
  }

  double loop_result(const SymbolNode& loop, std::size_t which, Known states, Known& known) const {
    const std::size_t count = loop.operands.size() / 3;
    std::vector<double> current;
    for (std::size_t i = 0; i < count; ++i) current.push_back(value(loop.operands[i], states, known));
    for (int turn = 0; turn < static_cast<int>(loop.value); ++turn) {
      for (std::size_t i = 0; i < count; ++i) states[&loop.operands[count + i].node()] = current[i];
      Known inside;  // what was known depends on no state of this loop, but need not be carried in
      for (std::size_t i = 0; i < count; ++i) current[i] = value(loop.operands[2 * count + i], states, inside);
    }
    return current[which];
  }

  std::map<std::string, double> inputs_;
};

}  // namespace tyndall
