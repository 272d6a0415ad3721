#include "tyndall/export/law_functions.h"

#include <algorithm>

#include "tyndall/number/described.h"
#include "tyndall/phase/law_as.h"

namespace tyndall {

std::string_view law_name(const Law<double>& law) {
  return std::visit([](const auto& l) { return std::string_view(l.name); }, law);
}

SymbolicLaw symbolic_law(const Law<double>& law) {
  SymbolicLaw out;
  out.law = law_as<Symbol>(law, [&](const std::string& name, double) {
    out.parameters.push_back({name});
    return Symbol::input(name);
  });
  return out;
}

std::vector<double> law_parameters(const Law<double>& law) {
  std::vector<double> out;
  law_as<double>(law, [&](const std::string&, double x) {
    out.push_back(x);
    return x;
  });
  return out;
}

namespace {

/// What the tables of a law lack in shaders; empty where they lack nothing.
std::string thinning_comment(const Law<Symbol>& law) {
  if (const auto* mixture = std::get_if<Mixture<Symbol>>(&law)) {
    std::string text;
    for (const auto& part : mixture->parts) text += thinning_comment(part.phase);
    return text;
  }
  const auto* const table = std::get_if<Tabulated<Symbol>>(&law);
  if (table == nullptr || table->size() <= knots_kept<Symbol> - 2) return {};
  double error = 0.0;
  for (std::size_t c = 0; c < channel_count; ++c) error = std::max(error, table->thinning_error(c));
  if (error == 0.0) return {};
  return "\nA table of " + std::to_string(table->size()) + " angles, thinned to " + std::to_string(knots_kept<Symbol>) +
         ": that changes the density by at most " + short_number(100.0 * error) +
         " % (of what is\nthere, or of a thousandth of the isotropic density where that is more).";
}

}  // namespace

std::vector<FunctionText> law_functions(std::string_view prefix, const Law<double>& law, int last_moment) {
  const SymbolicLaw symbolic = symbolic_law(law);
  const FunctionParameter given{"deflection", true}, xi{"xi"};
  const auto with_parameters = [&](const FunctionParameter* first) {
    std::vector<FunctionParameter> all;
    if (first != nullptr) all.push_back(*first);
    all.insert(all.end(), symbolic.parameters.begin(), symbolic.parameters.end());
    return all;
  };
  const std::string start = std::string(prefix) + "_";
  const Deflection<Symbol> d{given.component(0), given.component(1), given.component(2)};
  const Deflection<Symbol> sampled = sample(symbolic.law, xi.number());

  std::vector<FunctionText> out;
  out.push_back({start + "density",
                 with_parameters(&given),
                 {density(symbolic.law, d)},
                 "Phase function [1/sr] at a deflection (mu, 1 - mu, 1 + mu), mu the cosine between directions of\n"
                 "travel. Its integral over the sphere is 1."});
  out.push_back({start + "cdf",
                 with_parameters(&given),
                 {cdf(symbolic.law, d)},
                 "Probability that mu is at most that of the deflection (mu, 1 - mu, 1 + mu)."});
  out.push_back({start + "sample",
                 with_parameters(&xi),
                 {named("mu", sampled.mu), named("one_minus", sampled.one_minus), named("one_plus", sampled.one_plus)},
                 "The deflection (mu, 1 - mu, 1 + mu) whose cumulative probability is xi, 0 <= xi <= 1."});
  out.push_back({start + "mean_cosine", with_parameters(nullptr), {mean_cosine(symbolic.law)}, "Mean of mu."});
  for (int l = 2; l <= last_moment; ++l) {
    const std::string order = std::to_string(l);
    out.push_back({start + "moment_" + order,
                   with_parameters(nullptr),
                   {moment(symbolic.law, l)},
                   "Legendre moment of order " + order + "."});
  }
  for (FunctionText& function : out) function.prefix = start;
  out.front().comment += thinning_comment(symbolic.law);
  return out;
}

}  // namespace tyndall
