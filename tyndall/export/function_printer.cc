#include "tyndall/export/function_printer.h"

#include <algorithm>
#include <cassert>
#include <cctype>
#include <map>

namespace tyndall {
namespace {

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
      return "smaller";
    case Operation::max:
      return "larger";
    case Operation::select:
      return "chosen";
    case Operation::lookup:
      return "entry";
    default:
      return "value";
  }
}

std::vector<int> nodes_of(const std::vector<Symbol>& symbols, ExpressionGraph& graph) {
  std::vector<int> nodes;
  for (const Symbol& symbol : symbols) nodes.push_back(graph.add(symbol));
  return nodes;
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

FunctionPrinter::FunctionPrinter(const Dialect& dialect, const FunctionText& function, const ArrayNames& arrays)
    : dialect_(dialect),
      function_(function),
      graph_(arrays),
      outputs_(nodes_of(function.outputs, graph_)),
      plan_(graph_, outputs_, dialect.select_is_call),
      identifiers_(static_cast<std::size_t>(graph_.size())) {
  for (const FunctionParameter& parameter : function.parameters) taken_.insert(parameter.name);
  for (const std::string_view word : dialect.reserved) taken_.emplace(word);
  taken_.insert(function.name);
  for (const ArrayNames::Entry& entry : arrays.entries()) taken_.insert(entry.name);
  // What is returned has the first right to its name.
  for (const int output : outputs_)
    if (plan_.is_local(output) && !graph_[output].name.empty() && kept_names_.count(output) == 0)
      kept_names_[output] = new_identifier(graph_[output].name);
}

std::string FunctionPrinter::new_identifier(const std::string& wish) {
  const std::string base = without_marks(wish);
  std::string name = base;
  // A letter, so that the second u is not taken for the square of u.
  for (int i = 1; !taken_.insert(name).second; ++i)
    name = base + "_" + (i < 26 ? std::string(1, static_cast<char>('a' + i)) : std::to_string(i));
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
    if (!identifiers_[i].empty()) return identifiers_[i];
    if (graph_[i].operation == Operation::input && graph_[i].value < 0.0) return graph_[i].text;
    const bool size_of_input = graph_[i].operation == Operation::abs && graph_[graph_[i].operands[0]].value < 0.0 &&
                               graph_[graph_[i].operands[0]].operation == Operation::input;
    if (size_of_input) return "abs_" + graph_[graph_[i].operands[0]].text;
    return {};
  };
  int exponent = 0;
  if (const int base = base_of_power(node, exponent); exponent > 1 && !word(base).empty()) {
    const bool ends_in_digit = std::isdigit(static_cast<unsigned char>(word(base).back())) != 0;
    return word(base) + (ends_in_digit ? "_power_" : "") + std::to_string(exponent);
  }
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
  if (!identifiers_[node].empty() || plan_.is_atom(node)) {
    if (graph_[node].operation == Operation::result) write_loop(graph_[node].operands[0]);
    return;
  }
  for (const int operand : graph_[node].operands) write_locals_for(operand);
  if (plan_.is_local(node)) write_local(node);
}

void FunctionPrinter::write_local(int node) {
  const std::string value = piece(node).text;
  const auto kept = kept_names_.find(node);
  const std::string name = kept != kept_names_.end() ? kept->second : new_identifier(hint(node));
  const bool constant = graph_[node].operation == Operation::constant;
  line(fill_pattern(constant ? dialect_.constant : dialect_.local,
                    {{"type", dialect_.number_type}, {"name", name}, {"value", value}}));
  identifiers_[node] = name;
}

// What the loop that is about to be opened does not change is computed before it.
void FunctionPrinter::lift_to_here(int node, std::set<int>& visited) {
  if (!visited.insert(node).second) return;
  const std::set<int>& loops = plan_.loops(node);
  if (std::includes(open_loops_.begin(), open_loops_.end(), loops.begin(), loops.end())) {
    if (!plan_.is_trivial(node)) plan_.make_local(node);
    write_locals_for(node);
    return;
  }
  for (const int operand : graph_[node].operands) lift_to_here(operand, visited);
}

bool FunctionPrinter::mentions(int node, const std::set<int>& variables) const {
  if (variables.count(node) != 0) return true;
  if (!identifiers_[node].empty() || graph_[node].operation == Operation::result) return false;
  const auto& operands = graph_[node].operands;
  return std::any_of(operands.begin(), operands.end(), [&](int operand) { return mentions(operand, variables); });
}

void FunctionPrinter::write_loop(int node) {
  const std::vector<int>& operands = graph_[node].operands;
  const std::size_t count = operands.size() / 3;
  const auto initial = [&](std::size_t i) { return operands[i]; };
  const auto state = [&](std::size_t i) { return operands[count + i]; };
  const auto next = [&](std::size_t i) { return operands[2 * count + i]; };
  if (!identifiers_[state(0)].empty()) return;  // already written

  std::set<int> visited;
  for (std::size_t i = 0; i < count; ++i) lift_to_here(next(i), visited);
  for (std::size_t i = 0; i < count; ++i) write_locals_for(initial(i));
  for (std::size_t i = 0; i < count; ++i) {
    std::string wish = graph_[state(i)].name;
    for (int k = node; k < graph_.size() && wish.empty(); ++k)
      if (graph_[k].operation == Operation::result && graph_[k].operands[0] == node &&
          graph_[k].value == static_cast<double>(i))
        wish = graph_[k].name;
    if (wish.empty()) wish = graph_[initial(i)].name.empty() ? "state" : graph_[initial(i)].name;
    const std::string value = piece(initial(i)).text;
    const std::string name = new_identifier(wish);
    line(fill_pattern(dialect_.variable, {{"type", dialect_.number_type}, {"name", name}, {"value", value}}));
    identifiers_[state(i)] = name;
  }
  const std::string counter = new_identifier("turn");
  const std::string turns = std::to_string(static_cast<int>(graph_[node].value));
  line(fill_pattern(dialect_.loop, {{"name", counter}, {"count", turns}}));
  ++indent_;
  open_loops_.insert(node);
  for (std::size_t i = 0; i < count; ++i) write_locals_for(next(i));
  // Assignments happen one after the other: a value that mentions a variable assigned before it is computed first.
  std::set<int> assigned;
  std::vector<std::string> values;
  for (std::size_t i = 0; i < count; ++i) {
    values.push_back(piece(next(i)).text);
    if (mentions(next(i), assigned)) {
      const std::string name = new_identifier("next_" + identifiers_[state(i)]);
      line(fill_pattern(dialect_.local, {{"type", dialect_.number_type}, {"name", name}, {"value", values.back()}}));
      values.back() = name;
    }
    assigned.insert(state(i));
  }
  for (std::size_t i = 0; i < count; ++i)
    if (next(i) != state(i)) line(identifiers_[state(i)] + " = " + values[i] + ";");
  open_loops_.erase(node);
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
  if (!identifiers_[node].empty()) return {identifiers_[node], atom};
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
      return {identifiers_[loop[loop.size() / 3 + static_cast<std::size_t>(e.value)]], atom};
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
    case Operation::lookup:
      return {fill_pattern(dialect_.lookup, {{"name", e.text}, {"x", piece(e.operands[0]).text}}), atom};
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
  for (const int output : outputs_) write_locals_for(output);
  assert(outputs_.size() == 1 || outputs_.size() == 3);
  const bool triple = outputs_.size() == 3;
  const std::string value = triple ? fill_pattern(dialect_.make_triple, {{"x", piece(outputs_[0]).text},
                                                                         {"y", piece(outputs_[1]).text},
                                                                         {"z", piece(outputs_[2]).text}})
                                   : piece(outputs_[0]).text;
  line("return " + value + ";");
  return header(triple ? dialect_.triple_type : dialect_.number_type) + "\n" + lines_ + "}\n";
}

std::string FunctionPrinter::header(std::string_view type) const {
  const auto with_separator = [&](std::string_view separator) {
    std::string parameters;
    for (const FunctionParameter& parameter : function_.parameters) {
      if (!parameters.empty()) parameters += separator;
      parameters += fill_pattern(
          dialect_.parameter,
          {{"type", parameter.triple ? dialect_.triple_type : dialect_.number_type}, {"name", parameter.name}});
    }
    return fill_pattern(dialect_.function, {{"type", type}, {"name", function_.name}, {"parameters", parameters}});
  };
  const std::string one_line = with_separator(", ");
  return one_line.size() <= line_length ? one_line : with_separator(",\n        ");
}

}  // namespace tyndall
