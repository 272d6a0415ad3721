#pragma once
// Which nodes of an expression graph become local variables when it is printed.
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tyndall/export/expression.h"

namespace tyndall {

/// How strongly an operator binds: a weaker text inside a stronger operator needs parentheses. The association of sums
/// and products is kept as the law has it, so that rounding is that of the law.
enum Strength { choice, comparison, additive, multiplicative, unary, atom };

/// Lines are broken into locals near this many characters.
constexpr std::size_t line_length = 100;

/// A node becomes a local when the law's author named it, when it is used more than once, or when a line would become
/// too long; the printer adds what does not change inside a loop. All else is written in place.
class LocalsPlan {
 public:
  /// `outputs` are returned; `select_is_call` says how the language writes a choice.
  LocalsPlan(const ExpressionGraph& graph, const std::vector<int>& outputs, bool select_is_call);

  bool is_local(int node) const { return plans_[index(node)].local; }
  void make_local(int node) { plans_[index(node)].local = true; }
  /// The loops whose state variables a node depends on.
  const std::set<int>& loops(int node) const { return plans_[index(node)].loops; }

  /// Written in place always, being one word.
  bool is_atom(int node) const;
  /// A comparison: no number, so never a local.
  bool is_mask(int node) const;
  /// Not worth a name however often it occurs.
  bool is_trivial(int node) const;
  /// Of a node's own operator.
  int strength(int node) const;

 private:
  struct Plan {
    int uses = 0;  // places where its text would stand
    bool local = false;
    int length = 0;  // characters, about, where it is written in place
    std::set<int> loops;
  };

  static std::size_t index(int node) { return static_cast<std::size_t>(node); }
  void find_loops();
  void choose_locals(const std::vector<int>& outputs);
  void bound_line_lengths();
  int shown_length(int node) const;
  int written_length(int node) const;

  const ExpressionGraph& graph_;
  bool select_is_call_;
  std::vector<Plan> plans_;
};

}  // namespace tyndall
