// Slabs against published and independently computed truth. Every z is of an unbiased mean of 1e6 paths; |z| < 4 fails
// by chance once in 16,000, and a whole category's chi-square stays between its 0.001 and 0.999 quantiles 998 times in
// 1000. Seeds are fixed. A million paths give every flux to a standard error of 5e-4.
#include "tyndall/render/slab.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>

#include "tests/shared_folder.h"
#include "tyndall/render/test_slabs.h"

namespace tyndall {
namespace {

using nlohmann::json;

json category(const std::filesystem::path& truth, const char* name) {
  std::ifstream in(truth);
  return json::parse(in).at(name).at("items");
}

double number(const json& x) { return x.is_string() ? std::stod(x.get<std::string>()) : x.get<double>(); }

Law<double> law_named(const std::string& name) {
  if (name == "isotropic") return Isotropic<double>{};
  if (name == "rayleigh") return Rayleigh<double>{};
  if (name == "hazy") return MieHazy<double>{};
  if (name == "murky") return MieMurky<double>{};
  return HenyeyGreenstein<double>{std::stod(name.substr(2))};
}

/// Collects z values and judges them together.
class Scores {
 public:
  explicit Scores(double error_limit = 5e-4) : error_limit_(error_limit) {}
  void add(double estimate, double error, double truth, const std::string& what) {
    largest_error_ = std::max(largest_error_, error);
    if (std::fabs(truth) < 1e-8) {  // the truth has nine decimals, and such rare paths no normal statistics
      EXPECT_NEAR(estimate, truth, 1e-7) << what;
      return;
    }
    if (error == 0.0) {  // nothing happened to any path: the truth must be that rare
      EXPECT_NEAR(estimate, truth, 1e-5) << what;
      return;
    }
    const double z = (estimate - truth) / std::hypot(error, 1e-9);
    EXPECT_LT(std::fabs(z), 4.0) << what << ": " << estimate << " +- " << error << ", truth " << truth;
    chi_square_ += z * z;
    ++count_;
  }
  void judge() const {
    EXPECT_LE(largest_error_, error_limit_);
    // Wilson and Hilferty (1931): (chi^2/n)^(1/3) is normal with mean 1 - 2/(9n) and variance 2/(9n); 3.0902 is the
    // 0.999 quantile.
    const double v = 2.0 / (9.0 * count_), z = (std::cbrt(chi_square_ / count_) - (1.0 - v)) / std::sqrt(v);
    EXPECT_LT(std::fabs(z), 3.0902) << "chi-square " << chi_square_ << " of " << count_;
    ::testing::Test::RecordProperty("chi_square", std::to_string(chi_square_));
    ::testing::Test::RecordProperty("count", count_);
    ::testing::Test::RecordProperty("largest_standard_error", std::to_string(largest_error_));
  }

 private:
  double error_limit_, largest_error_ = 0.0, chi_square_ = 0.0;
  int count_ = 0;
};

constexpr double beams[] = {1.0, 0.5};
const char* key_of(double mu0) { return mu0 == 1.0 ? "mu0=1" : "mu0=0.5"; }

TEST(SlabTruth, FluxesOfHomogeneousSlabs) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  Scores scores;
  std::uint64_t seed = 100;
  for (const json& item : category(truth, "slab_flux")) {
    for (const double mu0 : beams) {
      SlabRequest request = slab_of(law_named(item["phase"]), item["albedo"], item["tau"]);
      request.mu0 = mu0;
      request.seed = seed++;
      const SlabResult result = solve_slab(request);
      const json& expected = item[key_of(mu0)];
      const std::string what =
          item["phase"].get<std::string>() + " albedo " + item["albedo"].dump() + " tau " + item["tau"].dump();
      scores.add(result.reflectance.mean[0], result.reflectance.standard_error[0], expected["R"], what + " R");
      scores.add(result.transmittance_diffuse.mean[0], result.transmittance_diffuse.standard_error[0],
                 expected["T_diffuse"], what + " T");
      EXPECT_NEAR(result.transmittance_direct[0], expected["T_direct"].get<double>(), 1e-12);
    }
  }
  scores.judge();
}

TEST(SlabTruth, RadianceAtExitAngles) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  Scores scores(8e-4);
  double largest_error = 0.0;
  std::uint64_t seed = 300;
  for (const json& item : category(truth, "slab_angular")) {
    SlabRequest request = slab_of(law_named(item["phase"]), item["albedo"], item["tau"]);
    request.mu0 = item["mu0"];
    request.seed = seed++;
    for (int i = 1; i <= 10; ++i) request.mu.push_back(0.1 * i);
    const SlabResult result = solve_slab(request);
    std::size_t m = 0;
    for (const auto& [mu, value] : item["R(mu,mu0)"].items()) {
      m = static_cast<std::size_t>(std::lround(10 * std::stod(mu))) - 1;
      const Estimate& e = result.reflection[m];
      const std::string what = item["phase"].get<std::string>() + " mu " + mu;
      EXPECT_LT(std::fabs(e.mean[0] - value.get<double>()), 4.5 * e.standard_error[0]) << what << " R";
      const Estimate& t = result.transmission[m];
      EXPECT_LT(std::fabs(t.mean[0] - item["T(mu,mu0)"][mu].get<double>()), 4.5 * t.standard_error[0]) << what << " T";
      largest_error = std::max({largest_error, e.standard_error[0], t.standard_error[0]});
    }
    // The ten angles of one slab share their paths, so only one of them enters the common judgement.
    const Estimate& e = result.reflection[4];
    scores.add(e.mean[0], e.standard_error[0], item["R(mu,mu0)"]["0.5"], item["phase"].get<std::string>() + " R(0.5)");
  }
  scores.judge();
  // Grazing angles (R = 0.53 at mu = 0.1 over a slab of g = 0.85) are the noisiest.
  EXPECT_LE(largest_error, 3e-3);
}

TEST(SlabTruth, PlaneAlbedoOfHalfSpaces) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  Scores scores;
  std::uint64_t seed = 500;
  const auto check = [&](const Law<double>& law, double albedo, double mu0, double expected, const std::string& what) {
    SlabRequest request = slab_of(law, albedo, 1.0);
    request.thickness = infinity;
    request.mu0 = mu0;
    request.seed = seed++;
    const SlabResult result = solve_slab(request);
    scores.add(result.reflectance.mean[0], result.reflectance.standard_error[0], expected, what);
    EXPECT_EQ(result.transmittance_direct[0], 0.0);
  };
  for (const json& item : category(truth, "semi_infinite_flux")) {
    for (const double mu0 : beams) {
      check(law_named(item["phase"]), item["albedo"], mu0, item[key_of(mu0)],
            item["phase"].get<std::string>() + " " + item["albedo"].dump());
    }
  }
  for (const json& item : category(truth, "chandrasekhar_H")) {
    for (const auto& [mu0, value] : item["mu"].items()) {
      check(Isotropic<double>{}, item["albedo"], std::stod(mu0), number(value["plane_albedo"]), "H(" + mu0 + ")");
    }
  }
  scores.judge();
}

TEST(SlabTruth, PublishedSlabs) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  const json items = category(truth, "published_slab");
  Scores scores;
  SlabRequest hulst = slab_of(HenyeyGreenstein<double>{0.75}, 0.9, 2.0);
  for (int i = 1; i <= 10; ++i) hulst.mu.push_back(0.1 * i);
  const SlabResult a = solve_slab(hulst);
  scores.add(a.reflectance.mean[0], a.reflectance.standard_error[0], items[0]["Rd_computed"], "van de Hulst R");
  scores.add(a.transmittance_diffuse.mean[0], a.transmittance_diffuse.standard_error[0], items[0]["T_diffuse_computed"],
             "van de Hulst T");
  for (std::size_t m = 0; m < 10; ++m) {
    const std::string mu = "0." + std::to_string(m + 1), key = m == 9 ? "1.0" : mu;
    EXPECT_LT(std::fabs(a.reflection[m].mean[0] - items[0]["R_mu"][key].get<double>()),
              4.5 * a.reflection[m].standard_error[0]);
    EXPECT_LT(std::fabs(a.transmission[m].mean[0] - items[0]["T_mu"][key].get<double>()),
              4.5 * a.transmission[m].standard_error[0]);
  }
  SlabRequest rayleigh = slab_of(Rayleigh<double>{}, 1.0, 0.2);
  rayleigh.mu0 = 0.080442;
  const SlabResult b = solve_slab(rayleigh);
  const double flux = std::numbers::pi * rayleigh.mu0;
  scores.add(b.reflectance.mean[0] * flux, b.reflectance.standard_error[0] * flux, items[3]["computed_up"],
             "DISORT 2b up");
  scores.add(b.transmittance_diffuse.mean[0] * flux, b.transmittance_diffuse.standard_error[0] * flux,
             items[3]["computed_down"], "DISORT 2b down");
  SlabRequest thick = slab_of(Isotropic<double>{}, 1.0, 32.0);
  thick.mu0 = 0.1;
  const SlabResult c = solve_slab(thick);
  scores.add(c.reflectance.mean[0], c.reflectance.standard_error[0], items[2]["flux_up_over_pi"], "DISORT 1e R");
  scores.judge();
}

TEST(SlabTruth, MixturesGroundAndDiffuseLight) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  const json items = category(truth, "mixtures_layers");
  Scores scores;
  SlabRequest air_and_haze, two_lobes, over_ground = slab_of(MieHazy<double>{}, 0.95, 1.5),
                                       white_sky = slab_of(MieMurky<double>{}, 0.999, 8.0);
  air_and_haze.medium.species = {species(Rayleigh<double>{}, 0.2, 0.0), species(MieHazy<double>{}, 1.0, 0.0),
                                 species(Isotropic<double>{}, 0.0, 0.1)};
  Mixture<double> lobes;
  lobes.parts = {{0.2, HenyeyGreenstein<double>{-0.3}}, {0.8, HenyeyGreenstein<double>{0.7}}};
  two_lobes.medium.species = {species(lobes, 4.0, 0.04)};
  over_ground.ground = 0.5;
  for (const double mu0 : beams) {
    air_and_haze.mu0 = two_lobes.mu0 = over_ground.mu0 = mu0;
    for (int i = 0; i < 2; ++i) {
      const SlabResult result = solve_slab(i == 0 ? air_and_haze : two_lobes);
      const json& expected = items[static_cast<std::size_t>(i)][key_of(mu0)];
      scores.add(result.reflectance.mean[0], result.reflectance.standard_error[0], expected["R"], "mixture R");
      scores.add(result.transmittance_diffuse.mean[0], result.transmittance_diffuse.standard_error[0],
                 expected["T_diffuse"], "mixture T");
    }
    const SlabResult ground = solve_slab(over_ground);
    const json& expected = items[3][key_of(mu0)];
    scores.add(ground.reflectance.mean[0], ground.reflectance.standard_error[0], expected["R"], "ground R");
    scores.add(ground.transmittance_diffuse.mean[0] + ground.transmittance_direct[0],
               ground.transmittance_diffuse.standard_error[0], expected["ground_irradiance_fraction"],
               "ground irradiance");
  }
  white_sky.diffuse = true;
  const SlabResult sky = solve_slab(white_sky);
  scores.add(sky.reflectance.mean[0], sky.reflectance.standard_error[0], items[4]["R_dd"], "white sky R");
  scores.add(sky.transmittance_diffuse.mean[0] + sky.transmittance_direct[0],
             sky.transmittance_diffuse.standard_error[0], items[4]["T_dd"], "white sky T");
  scores.judge();
}

/// Three different slabs at once, one per channel: each channel must give its own scalar answer, which a wrong spectral
/// weight spoils.
TEST(SlabTruth, AChromaticSlabGivesEveryChannelItsOwnAnswer) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  std::map<std::string, std::vector<json>> by_law;
  for (const json& item : category(truth, "slab_flux")) by_law[item["phase"]].push_back(item);
  Scores scores;
  for (const auto& [law, items] : by_law) {
    for (std::size_t first = 0; first + 2 < items.size(); first += 3) {
      SlabRequest request;
      Species s{"", {}, {}, law_named(law), {}};
      for (std::size_t c = 0; c < 3; ++c) {
        const double albedo = items[first + c]["albedo"], tau = items[first + c]["tau"];
        s.scattering[c] = albedo * tau;
        s.absorption[c] = (1.0 - albedo) * tau;
      }
      request.medium.species.push_back(s);
      const SlabResult result = solve_slab(request);
      for (std::size_t c = 0; c < 3; ++c) {
        const json& expected = items[first + c]["mu0=1"];
        const std::string what = law + " channel " + std::to_string(c);
        scores.add(result.reflectance.mean[c], result.reflectance.standard_error[c], expected["R"], what + " R");
        scores.add(result.transmittance_diffuse.mean[c], result.transmittance_diffuse.standard_error[c],
                   expected["T_diffuse"], what + " T");
      }
    }
  }
  scores.judge();
}

/// Paths are not independent of each other, so the error is told from replicates that are: 256 answers spread as they
/// say, and their mean, of 3e7 paths, is the truth.
TEST(SlabTruth, StandardErrorsAreHonest) {
  TYNDALL_NEEDS_SHARED_FILE(truth, "acceptance/public.json");
  const json ground = category(truth, "mixtures_layers")[3];
  SlabRequest request = slab_of(MieHazy<double>{}, 0.95, 1.5);
  request.ground = 0.5;
  request.mu0 = 0.5;
  request.mu = {0.2, 0.9};
  request.paths = 131072;
  Spread reflected, transmitted, radiance[4];
  double direct = 0.0;
  for (request.seed = 1; request.seed <= 256; ++request.seed) {
    const SlabResult result = solve_slab(request);
    reflected.add(result.reflectance);
    transmitted.add(result.transmittance_diffuse);
    for (std::size_t m = 0; m < 2; ++m) {
      radiance[2 * m].add(result.reflection[m]);
      radiance[2 * m + 1].add(result.transmission[m]);
    }
    direct = result.transmittance_direct[0];
  }
  Scores scores;
  scores.add(reflected.mean(), reflected.standard_error(), ground["mu0=0.5"]["R"], "ground R");
  scores.add(transmitted.mean() + direct, transmitted.standard_error(), ground["mu0=0.5"]["ground_irradiance_fraction"],
             "ground irradiance");
  scores.judge();
  reflected.expect_as_said("R");
  transmitted.expect_as_said("T");
  for (const Spread& r : radiance) r.expect_as_said("radiance");
}

}  // namespace
}  // namespace tyndall
