#include "tyndall/export/locals_plan.h"

#include <algorithm>

#include "tyndall/export/dialect.h"

namespace tyndall {

LocalsPlan::LocalsPlan(const ExpressionGraph& graph, const std::vector<int>& outputs, bool select_is_call)
    : graph_(graph), select_is_call_(select_is_call), plans_(index(graph.size())) {
  find_loops();
  choose_locals(outputs);
  bound_line_lengths();
}

// Which loops each node depends on. A loop's states are among its operands, so indices give the order.
void LocalsPlan::find_loops() {
  for (int i = 0; i < graph_.size(); ++i) {
    if (graph_[i].operation != Operation::loop) continue;
    const auto& operands = graph_[i].operands;
    for (std::size_t k = operands.size() / 3; k < 2 * operands.size() / 3; ++k)
      plans_[index(operands[k])].loops.insert(i);
  }
  for (int i = 0; i < graph_.size(); ++i) {
    for (const int operand : graph_[i].operands)
      plans_[index(i)].loops.insert(plans_[index(operand)].loops.begin(), plans_[index(operand)].loops.end());
    plans_[index(i)].loops.erase(i);
  }
}

bool LocalsPlan::is_atom(int node) const {
  switch (graph_[node].operation) {
    case Operation::constant:
      return graph_[node].is_constant();
    case Operation::input:
    case Operation::state:
    case Operation::result:
      return true;
    default:
      return false;
  }
}

bool LocalsPlan::is_mask(int node) const {
  switch (graph_[node].operation) {
    case Operation::less:
    case Operation::greater:
    case Operation::less_equal:
    case Operation::greater_equal:
      return true;
    default:
      return false;
  }
}

// Not worth a name however often it occurs.
bool LocalsPlan::is_trivial(int node) const {
  const Expression& e = graph_[node];
  return is_atom(node) || is_mask(node) || e.operation == Operation::loop ||
         ((e.operation == Operation::negate || e.operation == Operation::abs) && is_atom(e.operands[0]));
}

void LocalsPlan::choose_locals(const std::vector<int>& outputs) {
  for (const int output : outputs) ++plans_[index(output)].uses;
  // Users stand behind what they use, so going backwards each count is complete when it is needed.
  for (int i = graph_.size() - 1; i >= 0; --i) {
    const Expression& e = graph_[i];
    Plan& plan = plans_[index(i)];
    if (plan.uses == 0) continue;
    plan.local = !is_atom(i) && !is_mask(i) && e.operation != Operation::loop &&
                 (!e.name.empty() || (plan.uses > 1 && !is_trivial(i)));
    const int times = plan.local || e.operation == Operation::loop || e.operation == Operation::result ? 1 : plan.uses;
    for (const int operand : e.operands) plans_[index(operand)].uses += times;
  }
  // What only initialises a state variable is written there, and lends it its name.
  for (int i = 0; i < graph_.size(); ++i) {
    if (graph_[i].operation != Operation::loop || plans_[index(i)].uses == 0) continue;
    for (std::size_t k = 0; k < graph_[i].operands.size() / 3; ++k) {
      Plan& initial = plans_[graph_[i].operands[k]];
      if (initial.uses == 1) initial.local = false;
    }
  }
}

int LocalsPlan::strength(int node) const {
  switch (graph_[node].operation) {
    case Operation::constant:
      return graph_[node].value < 0.0 ? unary : atom;
    case Operation::negate:
      return unary;
    case Operation::multiply:
    case Operation::divide:
      return multiplicative;
    case Operation::add:
    case Operation::subtract:
      return additive;
    case Operation::less:
    case Operation::greater:
    case Operation::less_equal:
    case Operation::greater_equal:
      return comparison;
    case Operation::select:
      return select_is_call_ ? atom : choice;
    default:
      return atom;
  }
}

// Characters of a node's text where it stands, near enough: names of locals are not all chosen yet.
int LocalsPlan::shown_length(int node) const {
  const Expression& e = graph_[node];
  if (plans_[index(node)].local || e.operation == Operation::state || e.operation == Operation::result)
    return e.name.empty() ? 11 : static_cast<int>(e.name.size() + (e.name.size() > 4 ? 2 : 0));  // perhaps a suffix
  return plans_[index(node)].length;
}

int LocalsPlan::written_length(int node) const {
  const Expression& e = graph_[node];
  if (e.operation == Operation::input) return static_cast<int>(e.text.size()) + (e.value < 0.0 ? 0 : 2);
  if (e.operation == Operation::constant) return static_cast<int>(float_literal(e.value).size());
  const int own = strength(node);
  if (e.operation == Operation::lookup) return static_cast<int>(e.text.size()) + 7 + shown_length(e.operands[0]);
  int sum = (own == atom ? 5 : 0) + 3 * static_cast<int>(e.operands.size() - 1);  // a function's name; operators
  for (std::size_t i = 0; i < e.operands.size(); ++i) {
    const int operand = e.operands[i];
    const bool weaker = strength(operand) < own || (i > 0 && strength(operand) == own && own != atom);
    sum += shown_length(operand) + (weaker && !plans_[index(operand)].local && own != atom ? 2 : 0);
  }
  return sum;
}

void LocalsPlan::bound_line_lengths() {
  for (int i = 0; i < graph_.size(); ++i) {
    const Expression& e = graph_[i];
    if (e.operation == Operation::loop) continue;
    std::vector<int> parts;  // a mask is never a local, so its sides count instead
    for (const int operand : e.operands) {
      if (is_mask(operand)) {
        parts.insert(parts.end(), graph_[operand].operands.begin(), graph_[operand].operands.end());
      } else {
        parts.push_back(operand);
      }
    }
    // Around it stand an indent, deeper in loops, then "float name = ...;" or "return ...;".
    const int room = static_cast<int>(line_length) - 4 * static_cast<int>(plans_[index(i)].loops.size()) -
                     (plans_[index(i)].local ? 18 + (e.name.empty() ? 9 : static_cast<int>(e.name.size())) : 13);
    while (!is_atom(i) && !is_mask(i) && written_length(i) > room) {
      const int longest = *std::max_element(
          parts.begin(), parts.end(), [&](int left, int right) { return shown_length(left) < shown_length(right); });
      if (plans_[index(longest)].local || is_trivial(longest)) break;
      plans_[index(longest)].local = true;
    }
    plans_[index(i)].length = written_length(i);
  }
}

}  // namespace tyndall
