// The laws against independently computed figures: densities, moments, back-scattered part, inverse distribution.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "tests/shared_folder.h"
#include "tyndall/phase/law.h"

namespace tyndall {
namespace {

using Json = nlohmann::json;

double number(const Json& text) { return std::stod(text.get<std::string>()); }

// The law that a case of the file is named for; none for laws that the list does not have.
std::optional<Law<double>> law_named(const std::string& name) {
  if (name == "isotropic") return Isotropic<double>{};
  if (name == "rayleigh") return Rayleigh<double>{};
  if (name == "mie_hazy" || name == "hazy") return MieHazy<double>{};
  if (name == "mie_murky" || name == "murky") return MieMurky<double>{};
  if (name.rfind("hg_", 0) == 0) return HenyeyGreenstein<double>{std::stod(name.substr(3))};
  return std::nullopt;
}

TEST(PhaseAcceptance, EqualsTheIndependentFigures) {
  TYNDALL_NEEDS_SHARED_FILE(path, "acceptance/public.json");
  const Json all = Json::parse(std::ifstream(path));
  int checked = 0;
  for (const Json& item : all.at("phase_functions").at("items")) {
    const std::string name = item.at("name").get<std::string>();
    const std::optional<Law<double>> law = law_named(name);
    if (!law) continue;
    ++checked;
    SCOPED_TRACE(name);
    EXPECT_NEAR(mean_cosine(*law), number(item.at("g")), 1e-12);
    const Json& moments = item.at("chi_0..8");
    for (std::size_t l = 0; l < moments.size(); ++l)
      EXPECT_NEAR(moment(*law, static_cast<int>(l)), number(moments[l]), 1e-12) << "l = " << l;
    EXPECT_NEAR(cdf(*law, Deflection<double>::from_mu(0.0)), number(item.at("backscatter_fraction")), 1e-12);
    for (const auto& [degrees, p] : item.at("p(theta_deg)").items()) {
      const double expected = number(p), angle = std::stod(degrees) * std::numbers::pi / 180.0;
      EXPECT_NEAR(density(*law, Deflection<double>::from_angle(angle)), expected, 1e-12 * expected) << degrees;
    }
    // The file's inverse was bisected until the cumulative distribution was near enough, at worst to 2^-12 in mu.
    for (const auto& [xi, mu] : item.at("mu_of_cdf").items())
      EXPECT_NEAR(sample(*law, std::stod(xi)).mu, number(mu), 0x1p-12) << "xi = " << xi;
  }
  EXPECT_GE(checked, 3);
}

}  // namespace
}  // namespace tyndall
