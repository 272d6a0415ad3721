#include "tyndall/export/expression.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tyndall/number/symbol_value.h"

namespace tyndall {

bool ExpressionGraph::is(int node, double constant) const {
  const Expression& e = (*this)[node];
  return e.is_constant() && e.value == constant;
}

bool ExpressionGraph::is_power_of_two(int node) const {
  const Expression& e = (*this)[node];
  int exponent = 0;
  return e.is_constant() && std::frexp(e.value, &exponent) == 0.5 && std::abs(exponent) < 8;
}

int ExpressionGraph::interned(Operation operation, std::vector<int> operands, double value, const std::string& text) {
  const auto [found, is_new] = known_.try_emplace(Key{operation, value, text, operands}, size());
  if (is_new) nodes_.push_back({operation, value, text, std::move(operands), {}});
  return found->second;
}

int ExpressionGraph::give_name(int node, const std::string& name) {
  // A named constant is a node of its own: the same number elsewhere keeps its digits.
  if ((*this)[node].is_constant()) {
    const int own = interned(Operation::constant, {}, (*this)[node].value, name);
    nodes_[static_cast<std::size_t>(own)].name = name;
    return own;
  }
  std::string& known = nodes_[static_cast<std::size_t>(node)].name;
  if (known.empty() && (*this)[node].operation != Operation::input) known = name;
  return node;
}

int ExpressionGraph::simplified(Operation operation, std::vector<int> x) {
  const auto all_constant = [&] {
    return std::all_of(x.begin(), x.end(), [&](int i) { return (*this)[i].is_constant(); });
  };
  if (all_constant()) {
    std::vector<double> values;
    for (const int i : x) values.push_back((*this)[i].value);
    return interned(Operation::constant, {}, evaluate(operation, values));
  }
  const auto negated = [&](int i) { return (*this)[i].operation == Operation::negate; };
  switch (operation) {
    case Operation::fma:
      return simplified(Operation::add, {simplified(Operation::multiply, {x[0], x[1]}), x[2]});
    case Operation::negate:
      if (negated(x[0])) return (*this)[x[0]].operands[0];
      break;
    case Operation::add:
      if (is(x[0], 0.0)) return x[1];
      if (is(x[1], 0.0)) return x[0];
      if (negated(x[1])) return simplified(Operation::subtract, {x[0], (*this)[x[1]].operands[0]});
      break;
    case Operation::subtract:
      if (is(x[0], 0.0)) return simplified(Operation::negate, {x[1]});
      if (is(x[1], 0.0)) return x[0];
      if (negated(x[1])) return simplified(Operation::add, {x[0], (*this)[x[1]].operands[0]});
      break;
    case Operation::multiply:
      if (is(x[0], 1.0)) return x[1];
      if (is(x[1], 1.0)) return x[0];
      if (is(x[0], 0.0)) return x[0];
      if (is(x[1], 0.0)) return x[1];
      if (negated(x[0]) && negated(x[1]))
        return simplified(Operation::multiply, {(*this)[x[0]].operands[0], (*this)[x[1]].operands[0]});
      // 0.5 (2 x) is x to the last bit.
      if (const Expression& inner = (*this)[x[1]]; is_power_of_two(x[0]) && inner.operation == Operation::multiply &&
                                                   is(inner.operands[0], 1.0 / (*this)[x[0]].value))
        return inner.operands[1];
      break;
    case Operation::divide:
      if (is(x[1], 1.0)) return x[0];
      if (is(x[0], 0.0)) return x[0];
      break;
    case Operation::select:
      if (x[1] == x[2]) return x[1];
      if ((*this)[x[0]].is_constant()) return (*this)[x[0]].value != 0.0 ? x[1] : x[2];
      break;
    case Operation::abs:
      if (negated(x[0])) return simplified(Operation::abs, {(*this)[x[0]].operands[0]});
      if ((*this)[x[0]].operation == Operation::abs) return x[0];
      break;
    case Operation::min:
    case Operation::max:
      if (x[0] == x[1]) return x[0];
      break;
    default:
      break;
  }
  return interned(operation, std::move(x));
}

int ExpressionGraph::add(const Symbol& symbol) {
  const SymbolNode& node = symbol.node();
  if (const auto known = seen_.find(&node); known != seen_.end()) return known->second;
  std::vector<int> operands;
  for (const Symbol& operand : node.operands) operands.push_back(add(operand));
  int index = -1;
  switch (node.operation) {
    case Operation::constant:
      index = interned(node.operation, {}, node.value);
      break;
    case Operation::input:
      index = interned(node.operation, {}, node.value, node.text);
      break;
    case Operation::named:
      index = give_name(operands[0], node.text);
      break;
    case Operation::state:  // every state variable is its own: its index makes the key unique
      index = interned(node.operation, {}, size());
      break;
    case Operation::loop:
    case Operation::result:
      index = interned(node.operation, std::move(operands), node.value);
      break;
    case Operation::lookup:
      if (const Expression& at = (*this)[operands[0]]; at.is_constant()) {
        index = interned(Operation::constant, {}, lookup(node.array, at.value));
      } else {
        index = interned(node.operation, std::move(operands), 0.0, arrays_->name_of(*node.array));
      }
      break;
    default:
      index = simplified(node.operation, std::move(operands));
  }
  seen_.emplace(&node, index);
  kept_.push_back(symbol);
  return index;
}

}  // namespace tyndall
