// What media say of themselves, against independently computed figures: the note's w, air, visibility, fogs by their
// water.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/acceptance.h"
#include "tyndall/document/medium_file.h"
#include "tyndall/document/medium_summary.h"

namespace tyndall {
namespace {

using tests::AcceptanceCase;
using tests::for_each_case;

void near(double got, double expected, double relative) { EXPECT_NEAR(got, expected, relative * std::fabs(expected)); }

TEST(Acceptance, TheNotesWAgrees) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "acceptance");
  for_each_case(folder, "seed_w_blend", 9, [](AcceptanceCase& item) {
    const double w = item.number("w");
    const HazyMurky k = simple_strengths(w);
    EXPECT_EQ(k.hazy, item.number("k_MH"));
    EXPECT_EQ(k.murky, item.number("k_MM"));
    const Simple model{w, PlainExtinction{Spectrum::grey(1.0)}, Spectrum::grey(1.0), {}, {}, {}};
    const auto compiled = compile(MediumDials{std::nullopt, model, {}});
    const MediumSummary summary = summary_of(std::get<Medium>(compiled));
    EXPECT_NEAR(summary.extinction[1], item.number("sum"), 1e-15);
    if (item["g_eff"].is_null()) {
      EXPECT_TRUE(std::isnan(summary.mean_cosine[1]));
    } else {
      EXPECT_NEAR(summary.mean_cosine[1], item.number("g_eff"), 1e-14);
    }
  });
}

/// Also that the note's triplet is Bruneton's 1/lambda^4 law at 680, 550 and 440 nm, rounded (docs/note.md).
TEST(Acceptance, StandardAirAgrees) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "acceptance");
  for_each_case(folder, "rayleigh_air", 6, [](AcceptanceCase& item) {
    if (item.has("values")) {
      ASSERT_EQ(item.text("name").rfind("wavelength (um) at which physics gives the seed values", 0), 0U);
      for (const auto& [scattering, micrometres] : item["values"].items())
        near(standard_air_scattering(1e3 * micrometres.get<double>()), std::stod(scattering), 1e-5);
      return;
    }
    const double um = item.number("lambda_um"), nm = 1e3 * um;
    near(air_refractivity(nm), item.number("n-1"), 1e-7);
    near(king_factor(nm), item.number("king"), 1e-7);
    near(standard_air_scattering(nm), item.number("beta_m-1"), 1e-7);
    near(standard_air_scattering(nm) / 2.546899e25, item.number("sigma_m2"), 1e-7);  // the file's molecules per m^3
    near(standard_air_scattering(nm), item.number("beta_peck"), 1e-4);               // for 300 ppm of carbon dioxide
    near(note_air[1] * std::pow(0.55 / um, 4.0), item.number("bruneton"), 4e-3);
    MediumFile file;
    file.background.emplace().air = Air::standard;
    file.channels = ChannelWavelengths{{nm, nm, nm}};
    near(summary_of(compile(file)).scattering[1], item.number("beta_m-1"), 1e-7);
  });
}

TEST(Acceptance, VisibilityAgrees) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "acceptance");
  for_each_case(folder, "visibility", 6, [](AcceptanceCase& item) {
    const double contrast = item.number("eps");
    if (item.has("V_times_sigma")) {
      EXPECT_NEAR(visibility_of(1.0, contrast), item.number("V_times_sigma"), 1e-14);
      return;
    }
    const double metres = item.number("V_m"), sigma = item.number("sigma");
    near(extinction_of(Visibility{Spectrum::grey(metres), contrast})[0], sigma, 1e-13);
    near(visibility_of(sigma, contrast), metres, 1e-13);
  });
}

/// Models for artists, not Mie's theory: one effective diameter for a distribution of sizes, a fitted law. How far they
/// are off is stated (docs/accuracy.md) and bounded here.
TEST(Acceptance, FogOfAWaterContentIsNearMiesTheory) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "acceptance");
  const char* const particles = "Lorenz-Mie theory over distributions of sizes (particle)";
  int fogs = 0;
  for_each_case(folder, "polydispersions", 8, [&](AcceptanceCase& item) {
    if (item.text("name").rfind("fog", 0) != 0) {
      item.leave({"lambda_um", "m_re", "m_im", "r_eff_um", "C_ext_um2", "albedo", "g", "chi", "phase_per_sr",
                  "published", "computed_chi"},
                 particles);
      return;
    }
    item.leave({"m_re", "m_im", "chi", "phase_per_sr"}, particles);
    Measured fog;
    fog.air = Particles::fog;
    fog.droplet_diameter = 2.0 * item.number("r_eff_um");
    fog.liquid_water_content = item.number("LWC_g_per_m3");
    MediumFile file;
    file.conditions = fog;
    const double nm = 1e3 * item.number("lambda_um"), extinction = item.number("beta_ext_per_m");
    file.channels = ChannelWavelengths{{nm, nm, nm}};
    near(item.number("N_per_cm3") * item.number("C_ext_um2") * 1e-6, extinction, 1e-12);
    const MediumSummary said = summary_of(compile(file));
    near(said.extinction[1], extinction, 0.01);
    near(said.mean_cosine[1], item.number("g"), 0.025);
    near(said.absorption[1] / said.extinction[1], 1.0 - item.number("albedo"), 0.06);
    ++fogs;
  });
  EXPECT_GE(fogs, 4);
}

}  // namespace
}  // namespace tyndall
