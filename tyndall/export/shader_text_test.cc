// What generated shader text looks like, and that real compilers take it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <random>
#include <sstream>

#include "tyndall/export/law_functions.h"
#include "tyndall/phase/law_cases_test.h"
#include "tyndall/phase/law_suites_test.h"

namespace tyndall {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string function_of(const Law<double>& law, std::string_view prefix, std::string_view name) {
  for (const FunctionText& function : law_functions(prefix, law))
    if (function.name == std::string(prefix) + "_" + std::string(name)) return print_function(glsl_dialect(), function);
  return "no such function";
}

TEST(ShaderText, HenyeyGreensteinReadsAsIfWrittenByHand) {
  EXPECT_EQ(function_of(HenyeyGreenstein<double>{}, "henyey_greenstein", "density"),
            R"(// Phase function [1/sr] at a deflection (mu, 1 - mu, 1 + mu), mu the cosine between directions of
// travel. Its integral over the sphere is 1.
float henyey_greenstein_density(vec3 deflection, float g) {
    float complement = 1.0 - abs(g);
    const float inverse_four_pi = 0.07957747;
    float numerator = complement * (1.0 + abs(g)) * inverse_four_pi;
    float from_peak = g < 0.0 ? deflection.z : deflection.y;
    float distance_squared = 2.0 * abs(g) * from_peak + complement * complement;
    return numerator / (distance_squared * sqrt(distance_squared));
}
)");
  EXPECT_EQ(function_of(HenyeyGreenstein<double>{}, "henyey_greenstein", "mean_cosine"), R"(// Mean of mu.
float henyey_greenstein_mean_cosine(float g) {
    return g;
}
)");
}

TEST(ShaderText, ALoopReadsAsIfWrittenByHand) {
  EXPECT_EQ(function_of(MieHazy<double>{}, "mie_hazy", "sample"),
            R"(// The deflection (mu, 1 - mu, 1 + mu) whose cumulative probability is xi, 0 <= xi <= 1.
vec3 mie_hazy_sample(float xi) {
    float target = 2.0 * xi;
    float low = max(-1.0, 7.142857 * xi - 1.7142857);
    float product = (((0.00385275 * low + 0.00577272) * low - 0.0075407) * low - 0.0243911) * low;
    float product_b = target * (((product - 0.0247435) * low - 0.0125451) * low + 0.997269);
    float high = 3.2258065 * xi - 2.2258065;
    float product_c = (((-0.00359796 * high + 0.00931597) * high - 0.0132572) * high + 0.0222215) * high;
    float sum = ((product_c - 0.0446644) * high + 0.11216) * high + 0.917812;
    float u = xi < 0.38 ? product_b : sum;
    for (int turn = 0; turn < 1; ++turn) {
        float u2 = u * u;
        float power = u * u2 * (u2 * u2);
        float excess = power * u * u + u - target;
        float slope = 9.0 * power * u + 1.0;
        float curve = 72.0 * power;
        float difference = 2.0 * slope * slope - excess * curve;
        float halley = 2.0 * excess * slope / difference;
        u = max(0.0, u - halley);
    }
    float root = min(1.0, u);
    float v = 1.0 - root;
    float root2 = root * root;
    float root4 = root2 * root2;
    float above = root * (v * (1.0 + root) * (1.0 + root2) * (1.0 + root4)) + v;
    float rest = 2.0 * (1.0 - xi);
    float slope_b = 9.0 * (root4 * root4) + 1.0;
    float refined = max(0.0, v - (v + above - rest) / slope_b);
    float one_minus = 2.0 * (root < 0.5 ? v : refined);
    float one_plus = 2.0 * (root < 0.5 ? root : 1.0 - refined);
    float mu = one_minus < one_plus ? 1.0 - one_minus : one_plus - 1.0;
    return vec3(mu, one_minus, one_plus);
}
)");
}

TEST(ShaderText, AMixtureNumbersTheParametersOfItsParts) {
  const Mixture<double> inner{{{0.5, HenyeyGreenstein<double>{0.1}}, {0.5, Rayleigh<double>{}}}};
  const Mixture<double> law{{{0.25, HenyeyGreenstein<double>{0.9}}, {0.75, inner}}};
  std::vector<std::string> names;
  for (const FunctionParameter& parameter : symbolic_law(law).parameters) names.push_back(parameter.name);
  EXPECT_THAT(names, ::testing::ElementsAre("weight_1", "g_1", "weight_2", "weight_2_1", "g_2_1", "weight_2_2",
                                            "depolarisation_2_2"));
  EXPECT_THAT(law_parameters(law), ::testing::ElementsAre(0.25, 0.9, 0.75, 0.5, 0.1, 0.5, 0.0));
  EXPECT_THAT(function_of(law, "fog", "moment_2"), HasSubstr("g_2_1 * g_2_1"));
}

TEST(ShaderText, EqualSubExpressionsAreWrittenOnce) {
  const Symbol x = Symbol::input("x");
  // Built twice, so that not even a node is shared.
  const Symbol once = exp(x + 1.0), again = exp(Symbol::input("x") + 1.0);
  EXPECT_EQ(glsl_function("f", {"x"}, {once * sqrt(again)}), R"(float f(float x) {
    float exponential = exp(x + 1.0);
    return exponential * sqrt(exponential);
}
)");
}

TEST(ShaderText, TrivialArithmeticIsDone) {
  const Symbol x = Symbol::input("x");
  const auto text = [&](const Symbol& y) {
    const std::string all = glsl_function("f", {"x"}, {y});
    const std::size_t from = all.find("return ") + 7;
    return all.substr(from, all.find(';') - from);
  };
  EXPECT_EQ(text(x * 1.0), "x");
  EXPECT_EQ(text(1.0 * x + 0.0), "x");
  EXPECT_EQ(text(0.0 * x), "0.0");
  EXPECT_EQ(text(x / 1.0), "x");
  EXPECT_EQ(text(0.5 * (2.0 * x)), "x");
  EXPECT_EQ(text(-(-x)), "x");
  EXPECT_EQ(text(x - (-x)), "x + x");
  EXPECT_EQ(text(x + Symbol(-0.25)), "x - 0.25");
  EXPECT_EQ(text(Symbol(2.0) * 3.0 * x), "6.0 * x");
  EXPECT_EQ(text(select(Symbol(1.0) < Symbol(2.0), x, -x)), "x");
  EXPECT_EQ(text(select(x < 0.0, x, x)), "x");
  EXPECT_EQ(text(fma(x, x, x)), "x * x + x");
}

TEST(ShaderText, AssociationIsThatOfTheLaw) {
  const Symbol a = Symbol::input("a"), b = Symbol::input("b"), c = Symbol::input("c");
  const auto text = [&](const Symbol& y) { return glsl_function("f", {"a", "b", "c"}, {y}); };
  EXPECT_THAT(text(a - (b - c)), HasSubstr("return a - (b - c);"));
  EXPECT_THAT(text(a - b - c), HasSubstr("return a - b - c;"));
  EXPECT_THAT(text(a + (b + c)), HasSubstr("return a + (b + c);"));
  EXPECT_THAT(text(a / (b * c)), HasSubstr("return a / (b * c);"));
  EXPECT_THAT(text(a * (b / c)), HasSubstr("return a * (b / c);"));
  EXPECT_THAT(text(-(a + b) * c), HasSubstr("return -(a + b) * c;"));
  EXPECT_THAT(text(a * select(b < c, a, b)), HasSubstr("return a * (b < c ? a : b);"));
  EXPECT_THAT(text(sqrt(select(b < c, a, b))), HasSubstr("return sqrt(b < c ? a : b);"));
}

TEST(ShaderText, NamesNeverCollide) {
  const Symbol x = Symbol::input("x");
  const Symbol first = named("x", x + 1.0), second = named("sample", first * first), third = named("x", second + x);
  EXPECT_EQ(glsl_function("f", {"x"}, {third * third}), R"(float f(float x) {
    float x_b = x + 1.0;
    float sample_b = x_b * x_b;
    float x_c = sample_b + x;
    return x_c * x_c;
}
)");
}

TEST(ShaderText, LiteralsReadBackAsTheSameFloat) {
  EXPECT_EQ(float_literal(1.0), "1.0");
  EXPECT_EQ(float_literal(-2.5), "-2.5");
  EXPECT_EQ(float_literal(1e-37), "1.0e-37");
  EXPECT_EQ(float_literal(1.0 / 3.0), "0.33333334");
  std::mt19937 random(1);
  for (int i = 0; i < 100000; ++i) {
    const float x = std::ldexp(std::uniform_real_distribution<float>(-1.0F, 1.0F)(random),
                               std::uniform_int_distribution<int>(-125, 128)(random));
    const std::string text = float_literal(static_cast<double>(x));
    ASSERT_EQ(std::strtof(text.c_str(), nullptr), x);
    ASSERT_THAT(text, HasSubstr("."));
  }
}

TEST(ShaderText, ACommentCannotEscape) {
  const FunctionText function{"f", {}, {Symbol(1.0)}, "first\nsecond \\\n*/ evil(); \r third"};
  EXPECT_EQ(print_function(glsl_dialect(), function),
            "// first\n// second  \n// */ evil();   third\nfloat f() {\n    return 1.0;\n}\n");
}

TEST(ShaderText, HelpersStandAboveTheirUsersOnceAndOnlyWhenUsed) {
  const std::string rayleigh = print_functions(glsl_dialect(), law_functions("rayleigh", Rayleigh<double>{}));
  EXPECT_LT(rayleigh.find("float accurate_asinh(float x)"), rayleigh.find("rayleigh_sample"));
  EXPECT_EQ(rayleigh.find("float accurate_sinh("), rayleigh.rfind("float accurate_sinh("));
  EXPECT_THAT(rayleigh, Not(HasSubstr("accurate_cbrt")));
  EXPECT_THAT(print_functions(glsl_dialect(), law_functions("hg", HenyeyGreenstein<double>{})),
              Not(HasSubstr("accurate_")));
}

TEST(ShaderText, DialectsAreFoundByName) {
  EXPECT_EQ(find_dialect("glsl"), &glsl_dialect());
  EXPECT_EQ(find_dialect("cobol"), nullptr);
}

template <class L>
class GlslTextOf : public ::testing::Test {};
TYPED_TEST_SUITE(GlslTextOf, EveryLaw, LawNames);

TYPED_TEST(GlslTextOf, HasNoOverlongLine) {
  for (const Law<double>& law : law_cases<TypeParam>()) {
    std::istringstream lines(print_functions(glsl_dialect(), law_functions(law_name(law), law)));
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120U) << line;
  }
}

TYPED_TEST(GlslTextOf, IsTakenByGlslangInEveryVersion) {
  ASSERT_EQ(std::system("glslangValidator --version > /dev/null 2>&1"), 0)
      << "glslangValidator is not there. Debian: scripts/install.sh installs it (glslang-tools).";
  std::set<std::string> texts;  // parameters are no part of the text, so that most cases are the same
  for (const Law<double>& law : law_cases<TypeParam>())
    texts.insert(print_functions(glsl_dialect(), law_functions(law_name(law), law)));
  for (const std::string& text : texts) {
    for (const std::string version : {"450", "330", "310 es", "300 es"}) {
      const std::string file = ::testing::TempDir() + "tyndall_" + std::string(TypeParam::name) + ".frag";
      std::ofstream(file) << "#version " << version << "\nprecision highp float;\n"
                          << text << "\nout vec4 colour;\nvoid main() { colour = vec4(1.0); }\n";
      EXPECT_EQ(std::system(("glslangValidator " + file + " > " + file + ".txt").c_str()), 0)
          << version << "\n"
          << (std::ostringstream() << std::ifstream(file + ".txt").rdbuf()).str() << text;
      std::remove(file.c_str());
      std::remove((file + ".txt").c_str());
    }
  }
}

}  // namespace
}  // namespace tyndall
