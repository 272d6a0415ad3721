#pragma once
// Expression graphs made ready for printing: equal sub-expressions found equal, trivial arithmetic done.
#include <map>
#include <string>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "tyndall/export/array_names.h"
#include "tyndall/number/symbol.h"

namespace tyndall {

/// A node of the ready graph. `named` and `fma` do not occur: names sit on the nodes, a * b + c is two nodes.
struct Expression {
  Operation operation;
  double value = 0.0;
  std::string text;           // an input's name; the name of the array that a lookup reads
  std::vector<int> operands;  // indices, all smaller than this node's
  std::string name;           // as the law's author called it; may be empty
  bool is_constant() const { return operation == Operation::constant && name.empty(); }
};

class ExpressionGraph {
 public:
  /// `arrays` names the arrays that symbols read; it must outlive the graph.
  explicit ExpressionGraph(const ArrayNames& arrays) : arrays_(&arrays) {}
  /// The node that stands for a symbol. Structurally equal symbols get one node; of two names for it the first stays.
  int add(const Symbol& symbol);
  const Expression& operator[](int i) const { return nodes_[static_cast<std::size_t>(i)]; }
  int size() const { return static_cast<int>(nodes_.size()); }

 private:
  using Key = std::tuple<Operation, double, std::string, std::vector<int>>;
  int simplified(Operation operation, std::vector<int> operands);
  int interned(Operation operation, std::vector<int> operands, double value = 0.0, const std::string& text = {});
  int give_name(int node, const std::string& name);
  bool is(int node, double constant) const;
  bool is_power_of_two(int node) const;  // a positive one of moderate size

  const ArrayNames* arrays_;
  std::vector<Expression> nodes_;
  std::map<Key, int> known_;
  std::unordered_map<const SymbolNode*, int> seen_;
  std::vector<Symbol> kept_;  // keeps the nodes of seen_ alive, so that no address is used twice
};

}  // namespace tyndall
