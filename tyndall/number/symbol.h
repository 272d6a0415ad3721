#pragma once
// Symbol: a number that remembers how it was made. Evaluating a law's text with Symbol leaves an expression graph,
// which tyndall/export prints as shader text.
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "tyndall/number/constant_array.h"
#include "tyndall/number/scalar.h"

namespace tyndall {

/// What a node of an expression graph does. Operands in parentheses.
enum class Operation {
  constant,  // value
  input,     // text is the name, value the component (see Symbol)
  named,     // (x): x, to be called text
  negate,
  sqrt,
  cbrt,
  exp,
  expm1,
  log,
  sin,
  cos,
  sinh,
  asinh,
  abs,  // (x)
  add,
  subtract,
  multiply,
  divide,
  min,
  max,  // (a, b)
  less,
  greater,
  less_equal,
  greater_equal,  // (a, b), masks
  select,         // (mask, yes, no)
  fma,            // (a, b, c): a * b + c
  state,          // a variable of the loop that holds this very node
  loop,           // (initial..., states..., next...), a third each; value is the number of turns
  result,         // (loop): its value-th state after the last turn
  lookup,         // (index): the array's number there
};

struct SymbolNode;
struct SymbolMask;

/// A number known by its expression. Copies share immutable nodes; equal expressions built twice are two graphs (the
/// printer finds them equal). Constants mix freely with symbols.
class Symbol {
 public:
  Symbol(double constant = 0.0);  // NOLINT: as every number
  /// A parameter of the function that will be printed; with component 0, 1 or 2 that member of a triple.
  static Symbol input(std::string name, int component = -1);
  static Symbol of(Operation operation, std::vector<Symbol> operands, double value = 0.0, std::string text = {});

  const SymbolNode& node() const { return *node_; }

  Symbol operator-() const { return of(Operation::negate, {*this}); }
  friend Symbol operator+(const Symbol& a, const Symbol& b) { return of(Operation::add, {a, b}); }
  friend Symbol operator-(const Symbol& a, const Symbol& b) { return of(Operation::subtract, {a, b}); }
  friend Symbol operator*(const Symbol& a, const Symbol& b) { return of(Operation::multiply, {a, b}); }
  friend Symbol operator/(const Symbol& a, const Symbol& b) { return of(Operation::divide, {a, b}); }
  Symbol& operator+=(const Symbol& b) { return *this = *this + b; }
  Symbol& operator-=(const Symbol& b) { return *this = *this - b; }
  Symbol& operator*=(const Symbol& b) { return *this = *this * b; }
  friend SymbolMask operator<(const Symbol& a, const Symbol& b);
  friend SymbolMask operator>(const Symbol& a, const Symbol& b);
  friend SymbolMask operator<=(const Symbol& a, const Symbol& b);
  friend SymbolMask operator>=(const Symbol& a, const Symbol& b);

  friend Symbol sqrt(const Symbol& x) { return of(Operation::sqrt, {x}); }
  friend Symbol cbrt(const Symbol& x) { return of(Operation::cbrt, {x}); }
  friend Symbol exp(const Symbol& x) { return of(Operation::exp, {x}); }
  friend Symbol expm1(const Symbol& x) { return of(Operation::expm1, {x}); }
  friend Symbol log(const Symbol& x) { return of(Operation::log, {x}); }
  friend Symbol sin(const Symbol& x) { return of(Operation::sin, {x}); }
  friend Symbol cos(const Symbol& x) { return of(Operation::cos, {x}); }
  friend Symbol sinh(const Symbol& x) { return of(Operation::sinh, {x}); }
  friend Symbol asinh(const Symbol& x) { return of(Operation::asinh, {x}); }
  friend Symbol abs(const Symbol& x) { return of(Operation::abs, {x}); }
  friend Symbol min(const Symbol& a, const Symbol& b) { return of(Operation::min, {a, b}); }
  friend Symbol max(const Symbol& a, const Symbol& b) { return of(Operation::max, {a, b}); }
  friend Symbol fma(const Symbol& a, const Symbol& b, const Symbol& c) { return of(Operation::fma, {a, b, c}); }
  friend Symbol select(const SymbolMask& mask, const Symbol& yes, const Symbol& no);
  /// The array's number at an index; the printer writes the array where every function sees it.
  friend Symbol lookup(const SharedArray& array, const Symbol& index);
  /// The same value, to be held in a local variable of that name where it is printed.
  friend Symbol named(const char* name, const Symbol& x) { return of(Operation::named, {x}, 0.0, name); }

 private:
  explicit Symbol(std::shared_ptr<const SymbolNode> node) : node_(std::move(node)) {}
  std::shared_ptr<const SymbolNode> node_;
};

/// The outcome of a comparison; only select reads it.
struct SymbolMask {
  Symbol comparison;
};

/// One node; immutable once made.
struct SymbolNode {
  Operation operation;
  double value;
  std::string text;
  std::vector<Symbol> operands;
  SharedArray array;  // lookup: what it reads
};

inline Symbol::Symbol(double constant) : Symbol(of(Operation::constant, {}, constant)) {}
inline Symbol Symbol::of(Operation operation, std::vector<Symbol> operands, double value, std::string text) {
  return Symbol(
      std::make_shared<const SymbolNode>(SymbolNode{operation, value, std::move(text), std::move(operands), nullptr}));
}
inline Symbol Symbol::input(std::string name, int component) {
  return of(Operation::input, {}, component, std::move(name));
}
inline SymbolMask operator<(const Symbol& a, const Symbol& b) { return {Symbol::of(Operation::less, {a, b})}; }
inline SymbolMask operator>(const Symbol& a, const Symbol& b) { return {Symbol::of(Operation::greater, {a, b})}; }
inline SymbolMask operator<=(const Symbol& a, const Symbol& b) { return {Symbol::of(Operation::less_equal, {a, b})}; }
inline SymbolMask operator>=(const Symbol& a, const Symbol& b) {
  return {Symbol::of(Operation::greater_equal, {a, b})};
}
inline Symbol lookup(const SharedArray& array, const Symbol& index) {
  return Symbol(std::make_shared<const SymbolNode>(SymbolNode{Operation::lookup, 0.0, {}, {index}, array}));
}
inline Symbol select(const SymbolMask& mask, const Symbol& yes, const Symbol& no) {
  return Symbol::of(Operation::select, {mask.comparison, yes, no});
}

/// Shaders compute in float: laws iterate as far as float needs.
template <>
struct NumberTraits<Symbol> {
  using Value = float;
};

/// A loop that stays a loop: `body` runs once, on the loop's state variables. Name a variable by named() in the body.
template <std::size_t N, class Body>
std::array<Symbol, N> iterate(int count, const std::array<Symbol, N>& initial, Body body) {
  std::array<Symbol, N> states;
  for (Symbol& state : states) state = Symbol::of(Operation::state, {});
  const std::array<Symbol, N> next = body(states);
  std::vector<Symbol> operands(initial.begin(), initial.end());
  operands.insert(operands.end(), states.begin(), states.end());
  operands.insert(operands.end(), next.begin(), next.end());
  const Symbol loop = Symbol::of(Operation::loop, std::move(operands), count);
  std::array<Symbol, N> results;
  for (std::size_t i = 0; i < N; ++i) results[i] = Symbol::of(Operation::result, {loop}, static_cast<double>(i));
  return results;
}

}  // namespace tyndall
