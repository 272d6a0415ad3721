#pragma once
// The printer behind function_text.h: decides what becomes a local, what it is called, and where it stands.
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tyndall/export/expression.h"
#include "tyndall/export/function_text.h"

namespace tyndall {

/// Prints one function. A node becomes a local variable when the law's author named it, when it is used more than
/// once, when it does not change inside a loop, or when a line would become too long; all else is written in place.
class FunctionPrinter {
 public:
  FunctionPrinter(const Dialect& dialect, const FunctionText& function);
  std::string text();

 private:
  struct Piece {
    std::string text;
    int strength;  // of its weakest operator, see function_printer.cc
  };
  struct Plan {
    int uses = 0;            // places where its text would stand
    bool local = false;      // stands in a local variable
    int length = 0;          // characters, about, where it is written in place
    std::set<int> loops;     // whose state variables it depends on
    std::string identifier;  // once it has been written
  };

  void find_loops();
  void choose_locals();
  void bound_line_lengths();
  bool is_atom(int node) const;
  bool is_mask(int node) const;
  bool is_trivial(int node) const;
  int base_of_power(int node, int& exponent) const;
  std::string hint(int node) const;
  std::string new_identifier(const std::string& wish);

  void line(const std::string& text);
  void write_locals_for(int node);
  void write_local(int node);
  void write_loop(int node);
  void lift_out_of(int loop, int node, std::set<int>& visited);
  bool mentions(int node, const std::set<int>& variables) const;
  Piece piece(int node) const;
  std::string operand(int node, int least_strength) const;
  std::string call(std::string_view function, const std::vector<int>& operands) const;

  const Dialect& dialect_;
  const FunctionText& function_;
  ExpressionGraph graph_;
  std::vector<int> outputs_;
  std::vector<Plan> plans_;
  std::set<std::string> taken_;
  std::string lines_;
  int indent_ = 1;
};

/// The name of the helper function that stands for an operation.
std::string helper_name(Operation operation);

}  // namespace tyndall
