// The shader outlet's promise: every law of the list, printed as GLSL, compiles, and computes what C++ does.
#include "tyndall/export/law_functions.h"

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "tyndall/export/shader_run_test.h"
#include "tyndall/phase/law_as.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/law_suites_test.h"

namespace tyndall {
namespace {

constexpr int last_moment = 4;
constexpr double tolerance = 2e-6;

// One context for the whole program: making one takes longer than a test.
const ShaderMachine& machine() {
  static const ShaderMachine one;
  return one;
}

struct Row {
  Deflection<double> deflection;
  double xi;
};

// The shader sees floats, so the reference gets the same floats. 1 + mu and 1 - mu may come from an angle.
Deflection<double> as_float(const Deflection<double>& d) {
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {rounded(d.mu), rounded(d.one_minus), rounded(d.one_plus)};
}

std::vector<Row> rows() {
  std::vector<Row> out;
  const auto deflections = test_deflections();
  const auto xi = test_xi();
  for (std::size_t i = 0; i < std::max(deflections.size(), xi.size()); ++i)
    out.push_back({as_float(deflections[i % deflections.size()]), xi[i % xi.size()]});
  return out;
}

// Calls all functions of the law named "law" with `count` parameters.
std::string body(std::size_t count) {
  std::string parameters;
  for (std::size_t i = 0; i < count; ++i) parameters += ", given(" + std::to_string(4 + i) + "u)";
  const std::string alone = parameters.empty() ? "" : parameters.substr(2);
  std::string text = "  vec3 deflection = vec3(given(0u), given(1u), given(2u));\n";
  text += "  found(0u, law_density(deflection" + parameters + "));\n";
  text += "  found(1u, law_cdf(deflection" + parameters + "));\n";
  text += "  vec3 sampled = law_sample(given(3u)" + parameters + ");\n";
  text += "  found(2u, sampled.x);\n  found(3u, sampled.y);\n  found(4u, sampled.z);\n";
  text += "  found(5u, law_mean_cosine(" + alone + "));\n";
  for (int l = 2; l <= last_moment; ++l)
    text += "  found(" + std::to_string(4 + l) + "u, law_moment_" + std::to_string(l) + "(" + alone + "));\n";
  return text;
}

// How far the log-odds of the answer move when those of xi move by 1: where the lobes leave a gap, rounding of F counts
// that much more.
double condition_of_sampling(const Law<double>& law, const Deflection<double>& d, double xi) {
  if (xi == 0.0 || xi == 1.0) return 1.0;
  const double slope = std::numbers::pi * density(law, d) * d.one_minus * d.one_plus;
  return std::max(1.0, xi * (1.0 - xi) / slope);
}

template <class L>
class GlslOf : public ::testing::Test {};
TYPED_TEST_SUITE(GlslOf, EveryLaw, LawNames);

TYPED_TEST(GlslOf, EqualsTheReferenceInAllFiveFunctions) {
  const std::vector<Row> points = rows();
  constexpr std::size_t columns = 5 + last_moment;
  std::map<std::string, double> worst;
  for (const Law<double>& law : law_cases<TypeParam>()) {
    SCOPED_TRACE(words(law));
    const double allowed_error = tolerance * float_error(law) / 1e-6;
    const std::vector<double> parameters = law_parameters(law);
    std::vector<float> given;
    for (const Row& row : points) {
      for (const double x : {row.deflection.mu, row.deflection.one_minus, row.deflection.one_plus, row.xi})
        given.push_back(static_cast<float>(x));
      for (const double x : parameters) given.push_back(static_cast<float>(x));
    }
    const std::string functions = print_functions(glsl_dialect(), law_functions("law", law, last_moment));
    std::vector<float> found;
    ASSERT_NO_THROW(found = machine().run(functions, body(parameters.size()), given, 4 + parameters.size(), columns));

    for (std::size_t i = 0; i < points.size(); ++i) {
      const Row& row = points[i];
      SCOPED_TRACE("1 - mu = " + std::to_string(row.deflection.one_minus) + ", xi = " + std::to_string(row.xi));
      const auto expect = [&](const char* what, std::size_t column, double expected, double allowed) {
        const double value = static_cast<double>(found[i * columns + column]);
        EXPECT_NEAR(value, expected, allowed) << what;
        if (allowed > 0.0) {
          double& most = worst[what];
          most = std::max(most, std::fabs(value - expected) / allowed * tolerance);
        }
      };
      expect("density", 0, density(law, row.deflection), allowed_error * density(law, row.deflection));
      expect("cdf", 1, cdf(law, row.deflection), allowed_error * cdf(law, row.deflection));
      const Deflection<double> d = sample(law, row.xi);
      const double relative = allowed_error * condition_of_sampling(law, d, row.xi);
      expect("sampled mu", 2, d.mu, relative);
      expect("sampled 1 - mu", 3, d.one_minus, relative * d.one_minus);
      expect("sampled 1 + mu", 4, d.one_plus, relative * d.one_plus);
      expect("mean cosine", 5, mean_cosine(law), allowed_error);
      for (int l = 2; l <= last_moment; ++l)
        expect("moments", static_cast<std::size_t>(4 + l), moment(law, l), allowed_error);
    }
  }
  for (const auto& [what, error] : worst) {
    char text[20];
    std::snprintf(text, sizeof text, "%.1e", error);
    std::string key = "error_of_" + what;
    std::replace_if(
        key.begin(), key.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
    this->RecordProperty(key, text);
  }
}

// The comparison above has teeth: another digit in one constant does not pass it.
TEST(Glsl, SpoiltByOneDigitIsNoticed) {
  std::string functions = print_functions(glsl_dialect(), law_functions("law", HenyeyGreenstein<double>{0.5}));
  const std::string constant = float_literal(1.0 / (4.0 * std::numbers::pi));
  const std::size_t at = functions.find(constant);
  ASSERT_NE(at, std::string::npos);
  functions.replace(at, constant.size(), "0.07957947");
  const std::vector<float> found =
      machine().run(functions, "  found(0u, law_density(vec3(0.0, 1.0, 1.0), 0.5));\n", {0.0F}, 1, 1);
  const double expected = density(Law<double>(HenyeyGreenstein<double>{0.5}), Deflection<double>::from_mu(0.0));
  EXPECT_GT(std::fabs(static_cast<double>(found[0]) - expected), 10.0 * tolerance * expected);
}

// Elementary functions that GLSL lacks: printed from elementary.h, to 1e-6 relative.
TEST(Glsl, HelpersKeepTheirDigits) {
  const Symbol x = Symbol::input("x");
  const FunctionParameter parameter{"x"};
  const std::vector<FunctionText> functions{{"f_expm1", {parameter}, {expm1(x)}, {}},
                                            {"f_sinh", {parameter}, {sinh(x)}, {}},
                                            {"f_asinh", {parameter}, {asinh(x)}, {}},
                                            {"f_cbrt", {parameter}, {cbrt(x)}, {}}};
  std::vector<float> given;
  for (double size = 1e-20; size < 30.0; size *= 1.37)
    for (const double sign : {1.0, -1.0}) given.push_back(static_cast<float>(sign * size));
  given.push_back(0.0F);
  const std::vector<float> found = machine().run(print_functions(glsl_dialect(), functions),
                                                 "  float x = given(0u);\n  found(0u, f_expm1(x));\n"
                                                 "  found(1u, f_sinh(x));\n  found(2u, f_asinh(x));\n"
                                                 "  found(3u, f_cbrt(x));\n",
                                                 given, 1, 4);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double at = static_cast<double>(given[i]);
    const double expected[4] = {std::expm1(at), std::sinh(at), std::asinh(at), std::cbrt(at)};
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(static_cast<double>(found[4 * i + k]), expected[k], 1e-6 * std::fabs(expected[k]))
          << functions[k].name << " at " << at;
  }
}

// Loops: states are assigned at once, not one after the other; loops nest; what a loop does not change stands before
// it.
TEST(Glsl, LoopsMeanWhatTheyMeanInCpp) {
  const auto text = []<class T>(const T& x) -> std::array<T, 2> {
    const auto outer = [&](const std::array<T, 2>& state) -> std::array<T, 2> {
      const auto inner = [&](const std::array<T, 3>& s) -> std::array<T, 3> {
        return {s[1], s[0] + s[1] * sqrt(x), s[2] + s[0] * state[1]};
      };
      const std::array<T, 3> r = iterate(3, std::array<T, 3>{state[0], state[1], x * x}, inner);
      return {state[1], r[0] - T(0.5) * r[2] + state[0]};
    };
    return iterate(4, std::array<T, 2>{x, T(1.0)}, outer);
  };
  const auto exchange = []<class T>(const T& x) -> std::array<T, 2> {
    return iterate(3, std::array<T, 2>{x, T(2.0)}, [](const std::array<T, 2>& s) -> std::array<T, 2> {
      return {s[1], s[0]};
    });
  };
  const std::array<Symbol, 2> symbols = text(Symbol::input("x")), exchanged = exchange(Symbol::input("x"));
  const std::string functions =
      glsl_function("first", {"x"}, {symbols[0]}) + glsl_function("second", {"x"}, {symbols[1]}) +
      glsl_function("third", {"x"}, {exchanged[0]}) + glsl_function("fourth", {"x"}, {exchanged[1]});
  const std::vector<float> given{0.1F, 0.5F, 0.9F, 1.3F};
  const std::vector<float> found = machine().run(functions,
                                                 "  found(0u, first(given(0u)));\n  found(1u, second(given(0u)));\n"
                                                 "  found(2u, third(given(0u)));\n  found(3u, fourth(given(0u)));\n",
                                                 given, 1, 4);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double x = static_cast<double>(given[i]);
    const std::array<double, 2> both = text(x), pair = exchange(x);
    const double expected[4] = {both[0], both[1], pair[0], pair[1]};
    for (std::size_t k = 0; k < 4; ++k)
      EXPECT_NEAR(static_cast<double>(found[4 * i + k]), expected[k], 1e-5 * std::fabs(expected[k])) << functions;
  }
}

// Arrays: searched and read where the index differs from run to run; equal ones are written once, others apart.
TEST(Glsl, ReadsConstantArrays) {
  const SharedArray knots = constant_array("knots", {-2.0, -0.5, 0.0, 0.1, 0.7, 3.0, 1e6});
  const SharedArray same = constant_array("knots", knots->values());
  const SharedArray values = constant_array("knots", {5.0, -1.25, 3e-7, 2.0, 8.0, 1e9, 1.0 / 3.0});
  const auto text = [&]<class T>(const T& x) -> T {
    const T i = last_not_above(knots, T(0.0), 5, x);
    const T below = lookup(same, i), above = lookup(knots, i + T(1.0));
    return lookup(values, i) + (x - below) / (above - below) * lookup(values, i + T(1.0));
  };
  const std::string functions = glsl_function("f", {"x"}, {text(Symbol::input("x"))});
  EXPECT_EQ(functions.find("const float knots[7] = float[7](-2.0, -0.5, 0.0, 0.1, 0.7, 3.0, 1.0e+06);"), 0U)
      << functions;
  EXPECT_NE(functions.find("const float knots_b[7] = float[7](5.0, "), std::string::npos) << functions;
  EXPECT_EQ(functions.find("knots_c"), std::string::npos) << functions;
  std::vector<float> given;
  for (float x = -2.5F; x < 4.0F; x += 0.0625F) given.push_back(x);
  const std::vector<float> found = machine().run(functions, "  found(0u, f(given(0u)));\n", given, 1, 1);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double expected = text(static_cast<double>(given[i]));
    EXPECT_NEAR(static_cast<double>(found[i]), expected, 1e-6 * std::fabs(expected)) << given[i];
  }
}

// A table longer than shaders keep is thinned, and the text says by how much; the shader is that near the whole table.
TEST(Glsl, SaysByHowMuchATableIsThinned) {
  Tabulated<double> table;
  for (int i = 0; i < 2000; ++i) {
    const double angle = i == 0 ? 0.0 : 0.02 * std::pow(9000.0, (i - 1.0) / 1998.0);
    table.angles.push_back(std::min(angle, 180.0));
    const auto d = Deflection<double>::from_angle(table.angles.back() * std::numbers::pi / 180.0);
    table.values.push_back(Spectrum::grey(density(Law<double>(HenyeyGreenstein<double>{0.95}), d)));
  }
  const std::string functions = print_functions(glsl_dialect(), law_functions("cloud", table));
  EXPECT_NE(functions.find("const float cloud_position[1024]"), std::string::npos);
  const std::string words = "// A table of 2000 angles, thinned to 512: that changes the density by at most ";
  const std::size_t at = functions.find(words);
  ASSERT_NE(at, std::string::npos) << functions.substr(0, 2000);
  const double percent = std::stod(functions.substr(at + words.size()));
  EXPECT_LT(percent, 0.1);
  const LobeSum<double> lobes = lower(Law<double>(table));
  std::vector<float> given;
  for (float angle = 1e-4F; angle < 3.14F; angle *= 1.01F) given.push_back(angle);
  const std::vector<float> found =
      machine().run(functions,
                    "  float s = sin(0.5 * given(0u));\n  float u = 2.0 * s * s;\n"
                    "  found(0u, u);\n  found(1u, cloud_density(vec3(1.0 - u, u, 2.0 - u)));\n",
                    given, 1, 2);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const double u = static_cast<double>(found[2 * i]),
                 expected = density(lobes, Deflection<double>::from_ends(u, 2.0 - u));
    const double scale = std::max(expected, 1e-3 / (4.0 * std::numbers::pi));
    EXPECT_NEAR(static_cast<double>(found[2 * i + 1]), expected, (0.01 * percent + 2e-6) * scale) << given[i];
  }
}

}  // namespace
}  // namespace tyndall
