#pragma once
// The printer behind function_text.h: what a local is called, and where it stands.
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/export/expression.h"
#include "tyndall/export/function_text.h"
#include "tyndall/export/locals_plan.h"

namespace tyndall {

/// Prints one function.
class FunctionPrinter {
 public:
  /// `arrays` names the arrays that the function reads.
  FunctionPrinter(const Dialect& dialect, const FunctionText& function, const ArrayNames& arrays);
  std::string text();

 private:
  struct Piece {
    std::string text;
    int strength;  // of its weakest operator
  };

  std::string header(std::string_view type) const;
  int base_of_power(int node, int& exponent) const;
  std::string hint(int node) const;
  std::string new_identifier(const std::string& wish);

  void line(const std::string& text);
  void write_locals_for(int node);
  void write_local(int node);
  void write_loop(int node);
  void lift_to_here(int node, std::set<int>& visited);
  bool mentions(int node, const std::set<int>& variables) const;
  Piece piece(int node) const;
  std::string operand(int node, int least_strength) const;
  std::string call(std::string_view function, const std::vector<int>& operands) const;

  const Dialect& dialect_;
  const FunctionText& function_;
  ExpressionGraph graph_;
  std::vector<int> outputs_;
  LocalsPlan plan_;
  std::vector<std::string> identifiers_;   // of nodes that have been written
  std::map<int, std::string> kept_names_;  // identifiers promised to nodes
  std::set<std::string> taken_;            // identifiers
  std::set<int> open_loops_;
  std::string lines_;
  int indent_ = 1;
};

/// The name of the helper function that stands for an operation.
std::string helper_name(Operation operation);

}  // namespace tyndall
