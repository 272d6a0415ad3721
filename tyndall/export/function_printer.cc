#include "tyndall/export/function_printer.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <map>

namespace tyndall {
namespace {

// How strongly an operator binds; a weaker text inside a stronger operator needs parentheses. The association of sums
// and products is kept as the law has it, so that rounding is that of the law.
enum Strength { choice, comparison, additive, multiplicative, unary, atom };

constexpr int line_length = 80;  // of an expression, before it is broken into locals

std::string without_marks(std::string_view text) {
  std::string out;
  for (const char c : text) out += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  if (out.empty() || std::isdigit(static_cast<unsigned char>(out.front()))) out.insert(0, "x");
  return out;
}

std::string_view noun(Operation operation) {
  switch (operation) {
    case Operation::negate:
      return "negative";
    case Operation::sqrt:
      return "root";
    case Operation::cbrt:
      return "cube_root";
    case Operation::exp:
      return "exponential";
    case Operation::log:
      return "logarithm";
    case Operation::sin:
      return "sine";
    case Operation::cos:
      return "cosine";
    case Operation::abs:
      return "size";
    case Operation::add:
      return "sum";
    case Operation::subtract:
      return "difference";
    case Operation::multiply:
      return "product";
    case Operation::divide:
      return "ratio";
    case Operation::min:
      return "least";
    case Operation::max:
      return "greatest";
    case Operation::select:
      return "chosen";
    default:
      return "value";
  }
}

}  // namespace

std::string helper_name(Operation operation) {
  switch (operation) {
    case Operation::expm1:
      return "accurate_expm1";
    case Operation::sinh:
      return "accurate_sinh";
    case Operation::asinh:
      return "accurate_asinh";
    case Operation::cbrt:
      return "accurate_cbrt";
    default:
      assert(false);
      return "missing";
  }
}

FunctionPrinter::FunctionPrinter(const Dialect& dialect, const FunctionText& function)
    : dialect_(dialect), function_(function) {
  for (const Symbol& output : function.outputs) outputs_.push_back(graph_.add(output));
  for (const FunctionParameter& parameter : function.parameters) taken_.insert(parameter.name);
  for (const std::string_view word : dialect.reserved) taken_.emplace(word);
  taken_.insert(function.name);
  plans_.resize(static_cast<std::size_t>(graph_.size()));
  find_loops();
  choose_locals();
  bound_line_lengths();
}

// Which loops each node depends on. A loop's states are among its operands, so indices give the order.
void FunctionPrinter::find_loops() {
  for (int i = 0; i < graph_.size(); ++i) {
    if (graph_[i].operation != Operation::loop) continue;
    const auto& operands = graph_[i].operands;
    for (std::size_t k = operands.size() / 3; k < 2 * operands.size() / 3; ++k) plans_[operands[k]].loops.insert(i);
  }
  for (int i = 0; i < graph_.size(); ++i) {
    for (const int operand : graph_[i].operands)
      plans_[i].loops.insert(plans_[operand].loops.begin(), plans_[operand].loops.end());
    plans_[i].loops.erase(i);
  }
}

bool FunctionPrinter::is_atom(int node) const {
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

bool FunctionPrinter::is_mask(int node) const {
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
bool FunctionPrinter::is_trivial(int node) const {
  const Expression& e = graph_[node];
  return is_atom(node) || is_mask(node) || e.operation == Operation::loop ||
         ((e.operation == Operation::negate || e.operation == Operation::abs) && is_atom(e.operands[0]));
}

void FunctionPrinter::choose_locals() {
  for (const int output : outputs_) ++plans_[output].uses;
  // Users stand behind what they use, so going backwards each count is complete when it is needed.
  for (int i = graph_.size() - 1; i >= 0; --i) {
    const Expression& e = graph_[i];
    Plan& plan = plans_[i];
    if (plan.uses == 0) continue;
    plan.local = !is_atom(i) && !is_mask(i) && e.operation != Operation::loop &&
                 (!e.name.empty() || (plan.uses > 1 && !is_trivial(i)));
    const int times = plan.local || e.operation == Operation::loop || e.operation == Operation::result ? 1 : plan.uses;
    for (const int operand : e.operands) plans_[operand].uses += times;
  }
  // What only initialises a state variable is written there, and lends it its name.
  for (int i = 0; i < graph_.size(); ++i) {
    if (graph_[i].operation != Operation::loop || plans_[i].uses == 0) continue;
    for (std::size_t k = 0; k < graph_[i].operands.size() / 3; ++k) {
      Plan& initial = plans_[graph_[i].operands[k]];
      if (initial.uses == 1) initial.local = false;
    }
  }
}

void FunctionPrinter::bound_line_lengths() {
  for (int i = 0; i < graph_.size(); ++i) {
    const Expression& e = graph_[i];
    Plan& plan = plans_[i];
    if (e.operation == Operation::loop) continue;
    if (is_atom(i)) {
      plan.length = 8;
      continue;
    }
    const auto shown = [&](int node) { return plans_[node].local ? 12 : plans_[node].length; };
    std::vector<int> parts;  // a mask is never a local, so its sides count instead
    for (const int operand : e.operands) {
      if (is_mask(operand)) {
        parts.insert(parts.end(), graph_[operand].operands.begin(), graph_[operand].operands.end());
      } else {
        parts.push_back(operand);
      }
    }
    const auto total = [&] {
      int sum = 4;
      for (const int part : parts) sum += shown(part) + 3;
      return sum;
    };
    while (!is_mask(i) && total() > line_length) {
      const int longest =
          *std::max_element(parts.begin(), parts.end(), [&](int a, int b) { return shown(a) < shown(b); });
      if (plans_[longest].local || is_trivial(longest)) break;
      plans_[longest].local = true;
    }
    plan.length = total();
  }
}

std::string FunctionPrinter::new_identifier(const std::string& wish) {
  std::string name = without_marks(wish);
  for (int i = 2; !taken_.insert(name).second; ++i) name = without_marks(wish) + "_" + std::to_string(i);
  return name;
}

// The node that `node` is a power of, and which power; products of one thing with itself only.
int FunctionPrinter::base_of_power(int node, int& exponent) const {
  const Expression& e = graph_[node];
  exponent = 1;
  if (e.operation != Operation::multiply) return node;
  int left = 0, right = 0;
  const int base = base_of_power(e.operands[0], left);
  if (base_of_power(e.operands[1], right) != base) return node;
  exponent = left + right;
  return base;
}

// What to call a node that its author left unnamed.
std::string FunctionPrinter::hint(int node) const {
  const Expression& e = graph_[node];
  if (!e.name.empty()) return e.name;
  const auto word = [&](int i) -> std::string {
    if (!plans_[i].identifier.empty()) return plans_[i].identifier;
    if (graph_[i].operation == Operation::input && graph_[i].value < 0.0) return graph_[i].text;
    return {};
  };
  int exponent = 0;
  if (const int base = base_of_power(node, exponent); exponent > 1 && !word(base).empty())
    return word(base) + std::to_string(exponent);
  const bool one_first = e.operands.size() == 2 && graph_[e.operands[0]].is_constant() &&
                         graph_[e.operands[0]].value == 1.0 && !word(e.operands[1]).empty();
  if (one_first && e.operation == Operation::subtract) return "one_minus_" + word(e.operands[1]);
  if (one_first && e.operation == Operation::add) return "one_plus_" + word(e.operands[1]);
  if (e.operands.size() == 1 && !word(e.operands[0]).empty())
    return std::string(noun(e.operation)) + "_" + word(e.operands[0]);
  return std::string(noun(e.operation));
}

void FunctionPrinter::line(const std::string& text) {
  lines_ += std::string(static_cast<std::size_t>(4 * indent_), ' ') + text + "\n";
}

// Writes the locals, and the loops, that a node's text will mention.
void FunctionPrinter::write_locals_for(int node) {
  if (!plans_[node].identifier.empty() || is_atom(node)) {
    if (graph_[node].operation == Operation::result) write_loop(graph_[node].operands[0]);
    return;
  }
  for (const int operand : graph_[node].operands) write_locals_for(operand);
  if (plans_[node].local) write_local(node);
}

void FunctionPrinter::write_local(int node) {
  const std::string value = piece(node).text;
  const std::string name = new_identifier(hint(node));
  const bool constant = graph_[node].operation == Operation::constant;
  line(fill_pattern(constant ? dialect_.constant : dialect_.local,
                    {{"type", dialect_.number_type}, {"name", name}, {"value", value}}));
  plans_[node].identifier = name;
}

// What a loop does not change is computed before it.
void FunctionPrinter::lift_out_of(int loop, int node, std::set<int>& visited) {
  if (!visited.insert(node).second) return;
  if (plans_[node].loops.count(loop) == 0) {
    if (!is_trivial(node)) plans_[node].local = true;
    write_locals_for(node);
    return;
  }
  for (const int operand : graph_[node].operands) lift_out_of(loop, operand, visited);
}

bool FunctionPrinter::mentions(int node, const std::set<int>& variables) const {
  if (variables.count(node) != 0) return true;
  if (!plans_[node].identifier.empty()) return false;
  const auto& operands = graph_[node].operands;
  return std::any_of(operands.begin(), operands.end(), [&](int operand) { return mentions(operand, variables); });
}

void FunctionPrinter::write_loop(int node) {
  const std::vector<int>& operands = graph_[node].operands;
  const std::size_t count = operands.size() / 3;
  const auto initial = [&](std::size_t i) { return operands[i]; };
  const auto state = [&](std::size_t i) { return operands[count + i]; };
  const auto next = [&](std::size_t i) { return operands[2 * count + i]; };
  if (!plans_[state(0)].identifier.empty()) return;  // already written

  std::set<int> visited;
  for (std::size_t i = 0; i < count; ++i) lift_out_of(node, next(i), visited);
  for (std::size_t i = 0; i < count; ++i) write_locals_for(initial(i));
  for (std::size_t i = 0; i < count; ++i) {
    std::string wish = graph_[state(i)].name;
    if (wish.empty()) wish = graph_[initial(i)].name.empty() ? "state" : graph_[initial(i)].name;
    const std::string value = piece(initial(i)).text;
    const std::string name = new_identifier(wish);
    line(fill_pattern(dialect_.variable, {{"type", dialect_.number_type}, {"name", name}, {"value", value}}));
    plans_[state(i)].identifier = name;
  }
  const std::string counter = new_identifier("turn");
  const std::string turns = std::to_string(static_cast<int>(graph_[node].value));
  line(fill_pattern(dialect_.loop, {{"name", counter}, {"count", turns}}));
  ++indent_;
  for (std::size_t i = 0; i < count; ++i) write_locals_for(next(i));
  // Assignments happen one after the other: a value that mentions a variable assigned before it is computed first.
  std::set<int> assigned;
  for (std::size_t i = 0; i < count; ++i) {
    if (plans_[next(i)].identifier.empty() && !is_atom(next(i)) && mentions(next(i), assigned)) {
      plans_[next(i)].local = true;
      write_local(next(i));
    }
    assigned.insert(state(i));
  }
  for (std::size_t i = 0; i < count; ++i)
    if (next(i) != state(i)) line(plans_[state(i)].identifier + " = " + piece(next(i)).text + ";");
  --indent_;
  line("}");
}

std::string FunctionPrinter::operand(int node, int least_strength) const {
  const Piece p = piece(node);
  return p.strength < least_strength ? "(" + p.text + ")" : p.text;
}

std::string FunctionPrinter::call(std::string_view function, const std::vector<int>& operands) const {
  std::string text(function);
  text += "(";
  for (std::size_t i = 0; i < operands.size(); ++i) text += (i == 0 ? "" : ", ") + piece(operands[i]).text;
  return text + ")";
}

FunctionPrinter::Piece FunctionPrinter::piece(int node) const {
  const Expression& e = graph_[node];
  if (!plans_[node].identifier.empty()) return {plans_[node].identifier, atom};
  const auto infix = [&](std::string_view sign, int strength) -> Piece {
    return {operand(e.operands[0], strength) + " " + std::string(sign) + " " + operand(e.operands[1], strength + 1),
            strength};
  };
  // a + -0.5 as a - 0.5
  const bool negative_right =
      e.operands.size() == 2 && graph_[e.operands[1]].is_constant() && graph_[e.operands[1]].value < 0.0;
  const auto minus_constant = [&](std::string_view sign) -> Piece {
    return {operand(e.operands[0], additive) + " " + std::string(sign) + " " +
                float_literal(-graph_[e.operands[1]].value) + std::string(dialect_.literal_suffix),
            additive};
  };
  switch (e.operation) {
    case Operation::constant:
      return {float_literal(e.value) + std::string(dialect_.literal_suffix), e.value < 0.0 ? unary : atom};
    case Operation::input:
      if (e.value < 0.0) return {e.text, atom};
      return {e.text + std::string(dialect_.members[static_cast<int>(e.value)]), atom};
    case Operation::result: {
      const auto& loop = graph_[e.operands[0]].operands;
      return {plans_[loop[loop.size() / 3 + static_cast<std::size_t>(e.value)]].identifier, atom};
    }
    case Operation::negate:
      return {"-" + operand(e.operands[0], atom), unary};
    case Operation::add:
      return negative_right ? minus_constant("-") : infix("+", additive);
    case Operation::subtract:
      return negative_right ? minus_constant("+") : infix("-", additive);
    case Operation::multiply:
      return infix("*", multiplicative);
    case Operation::divide:
      return infix("/", multiplicative);
    case Operation::less:
      return infix("<", comparison);
    case Operation::greater:
      return infix(">", comparison);
    case Operation::less_equal:
      return infix("<=", comparison);
    case Operation::greater_equal:
      return infix(">=", comparison);
    case Operation::select: {
      const int least = dialect_.select_is_call ? choice : comparison;
      return {fill_pattern(dialect_.select, {{"mask", operand(e.operands[0], least)},
                                             {"yes", operand(e.operands[1], least)},
                                             {"no", operand(e.operands[2], least)}}),
              dialect_.select_is_call ? atom : choice};
    }
    default: {
      const std::string_view own = dialect_.function_for(e.operation);
      return {own.empty() ? call(helper_name(e.operation), e.operands) : call(own, e.operands), atom};
    }
  }
}

std::string FunctionPrinter::text() {
  std::string parameters;
  for (const FunctionParameter& parameter : function_.parameters) {
    const std::string_view type = parameter.triple ? dialect_.triple_type : dialect_.number_type;
    parameters +=
        (parameters.empty() ? "" : ", ") + fill_pattern(dialect_.parameter, {{"type", type}, {"name", parameter.name}});
  }
  for (const int output : outputs_) write_locals_for(output);
  assert(outputs_.size() == 1 || outputs_.size() == 3);
  const bool triple = outputs_.size() == 3;
  const std::string value = triple ? fill_pattern(dialect_.make_triple, {{"x", piece(outputs_[0]).text},
                                                                         {"y", piece(outputs_[1]).text},
                                                                         {"z", piece(outputs_[2]).text}})
                                   : piece(outputs_[0]).text;
  line("return " + value + ";");
  const std::string_view type = triple ? dialect_.triple_type : dialect_.number_type;
  return fill_pattern(dialect_.function, {{"type", type}, {"name", function_.name}, {"parameters", parameters}}) +
         "\n" + lines_ + "}\n";
}

}  // namespace tyndall
