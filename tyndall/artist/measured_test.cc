// The physics behind background and measured weather, against published numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tyndall/artist/medium_dials.h"

namespace tyndall {
namespace {

Medium medium_of(const MediumDials& dials) {
  auto compiled = compile(dials);
  if (const auto* objection = std::get_if<Objection>(&compiled)) ADD_FAILURE() << objection->found;
  return std::holds_alternative<Medium>(compiled) ? std::get<Medium>(compiled) : Medium{};
}
Background standard() {
  Background air;
  air.air = Air::standard;
  return air;
}
Measured measured(Particles kind) {
  Measured m;
  m.air = kind;
  return m;
}
std::vector<std::string> fields_of(const MediumDials& dials) {
  std::vector<std::string> fields;
  for (const Remark& remark : remarks_on(dials)) fields.push_back(remark.field);
  return fields;
}

TEST(StandardAir, ScattersAsBodhaineAndOthersSay) {
  // Bodhaine et al. 1999 and Bucholtz 1995 at sea level, 288.15 K, to the digits printed.
  EXPECT_NEAR(standard_air_scattering(550.0), 1.149e-5, 0.0005e-5);
  EXPECT_NEAR(standard_air_scattering(440.0), 2.871e-5, 0.0005e-5);
  EXPECT_NEAR(standard_air_scattering(680.0), 4.848e-6, 0.0005e-6);
  EXPECT_NEAR(king_factor(550.0), 1.0488, 1e-4);
  EXPECT_NEAR(air_optical_depth_above(550.0, 101325.0), 0.097, 0.0005);
  // (6 + 3 rho) / (6 - 7 rho) gives the King factor back.
  const double rho = depolarisation_of(1.0488);
  EXPECT_NEAR((6.0 + 3.0 * rho) / (6.0 - 7.0 * rho), 1.0488, 1e-14);
}

TEST(StandardAir, ThinsWithHeightAsTheStandardAtmosphereDoes) {
  // U.S. Standard Atmosphere 1976, table I: geometric height [m], temperature [K], pressure [Pa], density [kg/m^3].
  const double table[][4] = {{0, 288.150, 101325, 1.2250},       {5000, 255.676, 54048, 0.73643},
                             {11000, 216.774, 22700, 0.36480},   {20000, 216.650, 5529.3, 0.088910},
                             {32000, 228.490, 889.06, 0.013555}, {50000, 270.650, 79.779, 1.0269e-3},
                             {80000, 198.639, 1.0524, 1.8458e-5}};
  for (const auto& [height, temperature, pressure, density] : table) {
    const AirState state = standard_air_at(height);
    EXPECT_NEAR(state.temperature, temperature, 1e-3);
    EXPECT_NEAR(state.pressure, pressure, 1e-4 * pressure);
    EXPECT_NEAR(1.225 * state.relative_density, density, 1e-4 * density);
  }
}

TEST(Background, StandardAirIsTakenAtTheChannelsWavelengths) {
  MediumDials dials{standard(), {}, {}, ChannelWavelengths{{700.0, 600.0, 500.0}}};
  const Medium medium = medium_of(dials);
  EXPECT_EQ(medium.species[0].scattering[1], standard_air_scattering(600.0));
  EXPECT_EQ(std::get<Rayleigh<double>>(medium.species[0].phase).depolarisation, depolarisation_of(king_factor(600.0)));
  dials.channels.reset();  // linear sRGB
  EXPECT_EQ(medium_of(dials).species[0].scattering[0], standard_air_scattering(680.0));
}

TEST(Background, AltitudeThinsAirOfEveryKind) {
  for (const Air kind : {Air::note, Air::standard}) {
    Background air;
    air.air = kind;
    const Medium sea = medium_of({air, {}, {}});
    air.altitude = 5000.0;
    const Medium high = medium_of({air, {}, {}});
    EXPECT_NEAR(high.species[0].scattering[2] / sea.species[0].scattering[2], 0.73643 / 1.2250, 1e-4);
  }
}

TEST(Background, OzoneAbsorbsInItsLayerOnly) {
  Background air = standard();
  air.ozone = 300.0;
  const Medium medium = medium_of({air, {}, {}});
  ASSERT_EQ(medium.species.size(), 2u);
  const Species& ozone = medium.species[1];
  EXPECT_TRUE(is_zero(ozone.scattering));
  // 300 DU in a tent from 10 over 25 to 40 km: peaks 6.5e-7, 1.88e-6, 8.5e-8 and depths 0.0097, 0.028, 0.0013.
  EXPECT_NEAR(ozone.absorption[0], 6.5e-7, 0.05e-7);
  EXPECT_NEAR(ozone.absorption[1], 1.88e-6, 0.005e-6);
  EXPECT_NEAR(ozone.absorption[2], 8.5e-8, 0.05e-8);
  double depth = 0.0;
  for (int i = 0; i < 50000; ++i) depth += ozone.absorption[1] * factor(ozone, {0.0, i + 0.5, 0.0});
  EXPECT_NEAR(depth, 300.0 * dobson_unit * 3.5e-25, 1e-6);
  EXPECT_EQ(factor(ozone, {}), 0.0);
  EXPECT_EQ(factor(ozone, {0.0, 25000.0, 0.0}), 1.0);
  air.altitude = 3000.0;
  EXPECT_EQ(factor(medium_of({air, {}, {}}).species[1], {0.0, 22000.0, 0.0}), 1.0);
}

TEST(Background, RefusesChannelsWithoutData) {
  Background air = standard();
  const auto at = [&](double nm) {
    const auto compiled = compile(MediumDials{air, {}, {}, ChannelWavelengths{{680.0, 550.0, nm}}});
    const auto* objection = std::get_if<Objection>(&compiled);
    return objection != nullptr ? objection->field : "";
  };
  EXPECT_EQ(at(229.0), "channels/wavelengths_nm");
  EXPECT_EQ(at(300.0), "");
  air.ozone = 300.0;
  EXPECT_EQ(at(300.0), "channels/wavelengths_nm");
  EXPECT_EQ(at(839.0), "");
  EXPECT_EQ(at(840.0), "channels/wavelengths_nm");
}

TEST(AtWavelength, FollowsPowerLawsExactly) {
  const Spectrum nm{{680.0, 550.0, 440.0}}, sigma = map(nm, [](double x) { return 1e-3 * std::pow(x / 550.0, -1.3); });
  for (const double x : {400.0, 440.0, 500.0, 550.0, 600.0, 680.0, 900.0}) {
    EXPECT_NEAR(at_wavelength(sigma, nm, x), 1e-3 * std::pow(x / 550.0, -1.3), 1e-17);
  }
  EXPECT_EQ(at_wavelength({{0.0, 1.0, 0.0}}, nm, 550.0), 1.0);
  EXPECT_EQ(at_wavelength(Spectrum::grey(2.0), Spectrum::grey(600.0), 550.0), 2.0);
}

TEST(Droplets, LiquidWaterGivesTheExtinctionOfShettleAndFennsFogs) {
  // Their four fogs (1979): water [g/m^3], twice the effective radius [um], extinction at 550 nm [1/km] by Mie's
  // theory.
  const double fogs[][3] = {{0.372, 40.0, 28.7}, {0.191, 32.0, 18.5}, {0.0626, 12.0, 16.6}, {0.0156, 6.0, 8.6}};
  for (const auto& [water, diameter, per_km] : fogs) {
    EXPECT_NEAR(1e3 * extinction_of_liquid_water(water, diameter, 550.0), per_km, 0.01 * per_km);
  }
}

TEST(Droplets, MeanCosineAndAbsorptionAreThoseOfFogs) {
  // The fit itself at 10, 20 and 50 um, and between its two sides at 5; OPAC's fog (effective diameter near 16 um):
  // 0.866 and 3.0e-7.
  const double fit[][2] = {{5.0, 0.843035}, {10.0, 0.864164}, {20.0, 0.879310}, {50.0, 0.891194}};
  for (const auto& [diameter, g] : fit) EXPECT_NEAR(mean_cosine(fog_law(diameter)), g, 2e-6);
  EXPECT_NEAR(drop_absorbed_share(16.0, 550.0), 3.0e-7, 0.1e-7);
  EXPECT_NEAR(drop_extinction_efficiency(17.507, 550.0), 2.100, 0.01);  // x = 100: Mie's 2.0966 and what it absorbs
}

TEST(Measured, KindsHaveTheColourOfTheirTable) {
  Measured dust = measured(Particles::dust);
  dust.extinction = 1e-3;
  const Medium medium = medium_of({std::nullopt, dust, {}, ChannelWavelengths{{700.0, 550.0, 450.0}}});
  const Species& s = medium.species[0];
  EXPECT_NEAR(s.scattering[0] / s.extinction()[0], 0.919, 1e-12);
  EXPECT_NEAR(s.scattering[1] / s.extinction()[1], 0.888, 1e-12);
  EXPECT_NEAR(s.scattering[2] / s.extinction()[2], 0.843, 1e-12);
  EXPECT_DOUBLE_EQ(s.extinction()[1], 1e-3);
  EXPECT_NEAR(s.extinction()[0], 1e-3 * std::pow(700.0 / 550.0, -0.17), 1e-15);
  EXPECT_NEAR(s.extinction()[2], 1e-3 * std::pow(500.0 / 550.0, -0.17) * std::pow(450.0 / 500.0, -0.20), 1e-15);
  EXPECT_EQ(mean_cosine(s.phase), 0.729);
  EXPECT_EQ(s.name, "dust");
}

TEST(Measured, WhatIsStatedReplacesTheTable) {
  Measured haze = measured(Particles::urban);
  haze.extinction = 1e-3;
  haze.albedo = Spectrum{{0.9, 0.8, 0.7}};
  haze.angstrom_exponent = 2.0;
  haze.mean_cosine = 0.5;
  const Species s = medium_of({std::nullopt, haze, {}}).species[0];
  EXPECT_NEAR(s.extinction()[2], 1e-3 * std::pow(550.0 / 440.0, 2.0), 1e-15);
  EXPECT_NEAR(s.scattering[2] / s.extinction()[2], 0.7, 1e-14);
  EXPECT_EQ(mean_cosine(s.phase), 0.5);
}

TEST(Measured, FogHardlyAbsorbs) {
  Measured fog = measured(Particles::fog);
  fog.visibility = 100.0;
  const Species s = medium_of({std::nullopt, fog, {}}).species[0];
  for (std::size_t c = 0; c < channel_count; ++c) {
    EXPECT_GT(s.absorption[c], 0.0);
    EXPECT_LT(s.absorption[c], 1e-5 * s.scattering[c]);
  }
  EXPECT_EQ(mean_cosine(s.phase), mean_cosine(fog_law(12.0)));
}

TEST(Measured, TurbidityAddsToTheColumnOfAir) {
  Measured haze = measured(Particles::continental);
  haze.turbidity = 3.0;
  haze.profile = ExponentialProfile{2000.0, 0.0};
  const Species s = medium_of({standard(), haze, {}}).species[1];
  EXPECT_NEAR(s.extinction()[1] * 2000.0, 2.0 * air_optical_depth_above(550.0, 101325.0), 1e-12);
  haze.profile.reset();
  EXPECT_NEAR(medium_of({standard(), haze, {}}).species[1].extinction()[1] * usual_haze_height,
              2.0 * air_optical_depth_above(550.0, 101325.0), 1e-12);
}

TEST(Measured, IsWhatWasMeasuredAtTheOriginWhateverTheProfile) {
  Measured fog = measured(Particles::fog);
  fog.liquid_water_content = 0.1;
  const double homogeneous = medium_of({std::nullopt, fog, {}}).species[0].extinction()[1];
  fog.profile = ExponentialProfile{30.0, 20.0};
  const Medium medium = medium_of({std::nullopt, fog, {}});
  EXPECT_NEAR(scattering_at(medium, {})[1] + absorption_at(medium, {})[1], homogeneous, 1e-15);
}

TEST(Measured, ObjectsToWhatCannotBe) {
  const auto field = [](const Measured& m) {
    const auto compiled = compile(MediumDials{Background{}, m, {}});
    const auto* objection = std::get_if<Objection>(&compiled);
    return objection != nullptr ? objection->field : "none";
  };
  Measured m = measured(Particles::continental);
  EXPECT_EQ(field(m), "conditions");  // no density
  m.visibility = 1e6;
  EXPECT_EQ(field(m), "conditions/visibility");  // beyond what air leaves
  m.visibility = 1e4;
  EXPECT_EQ(field(m), "none");
  m.turbidity = 2.0;
  EXPECT_EQ(field(m), "conditions");  // two densities
  m.turbidity.reset();
  m.droplet_diameter = 10.0;
  EXPECT_EQ(field(m), "conditions/droplet_diameter");  // drops of haze
  m.air = Particles::rain;
  EXPECT_EQ(field(m), "conditions/droplet_diameter");
  m.air = Particles::fog;
  EXPECT_EQ(field(m), "none");
  m.droplet_diameter = 51.0;
  EXPECT_EQ(field(m), "conditions/droplet_diameter");
  m.droplet_diameter.reset();
  m.profile = SphereProfile{{100.0, 0.0, 0.0}, 1.0};
  EXPECT_EQ(field(m), "conditions/profile");
}

TEST(Remarks, NothingIsSaidOfRealAir) {
  Background air = standard();
  air.ozone = 300.0;
  air.profile = ExponentialProfile{8000.0, 0.0};
  for (const Particles kind : {Particles::clear, Particles::continental, Particles::urban, Particles::dust}) {
    Measured m = measured(kind);
    m.visibility = 20000.0;
    EXPECT_TRUE(fields_of({air, m, {}}).empty());
  }
  Simple fog;
  fog.thickness = Visibility{Spectrum::grey(200.0), 0.05};
  EXPECT_TRUE(fields_of({Background{}, fog, {}}).empty());
}

TEST(Remarks, EachNamesTheDialOutsidePhysics) {
  using Fields = std::vector<std::string>;
  Background air;
  air.exaggeration = 2.0;
  air.profile = ExponentialProfile{500.0, 0.0};
  air.ozone = 2000.0;
  EXPECT_EQ(fields_of({air, {}, {}}),
            (Fields{"background/exaggeration", "background/profile/scale_height", "background/ozone"}));
  Simple simple;
  simple.thickness = Visibility{Spectrum::grey(300e3), 0.05};
  EXPECT_EQ(fields_of({{}, simple, {}}), Fields{"conditions/thickness/visibility"});
  simple.thickness = Visibility{Spectrum::grey(300.0), 0.05};
  simple.albedo = {{0.9, 0.9, 0.5}};
  EXPECT_EQ(fields_of({{}, simple, {}}), Fields{"conditions/albedo"});
  TwoLobes lobes;
  lobes.g1 = 0.6;
  lobes.g2 = -0.2;
  EXPECT_EQ(fields_of({{}, lobes, {}}), Fields{"conditions/g1"});
  lobes.g1 = lobes.g2 = -0.8;
  EXPECT_EQ(fields_of({{}, lobes, {}}), Fields{"conditions/g1"});  // scatters back more than any particle
  TwoLobesExplicit two;
  two.first = {0.5, PlainExtinction{Spectrum::grey(1e-3)}, Spectrum::grey(1.0)};
  two.second = {0.1, Visibility{Spectrum::grey(1e6), 0.02}, Spectrum::grey(1.0)};
  EXPECT_EQ(fields_of({{}, two, {}}), (Fields{"conditions/second/thickness/visibility", "conditions/first/g"}));
  Measured fog = measured(Particles::fog);
  fog.visibility = 5000.0;
  fog.albedo = Spectrum::grey(0.9);
  fog.angstrom_exponent = 5.0;
  EXPECT_EQ(fields_of({{}, fog, {}}),
            (Fields{"conditions/visibility", "conditions/albedo", "conditions/angstrom_exponent"}));
  Measured haze = measured(Particles::clear);
  haze.turbidity = 0.5;
  EXPECT_EQ(fields_of({{}, haze, {}}), Fields{"conditions/turbidity"});
  EXPECT_TRUE(medium_of({{}, haze, {}}).species.empty());  // taken as 1
  Measured rain = measured(Particles::rain);
  rain.liquid_water_content = 20.0;
  rain.droplet_diameter = 6000.0;
  EXPECT_EQ(fields_of({{}, rain, {}}), (Fields{"conditions/liquid_water_content", "conditions/droplet_diameter"}));
}

TEST(TwoLobesExplicit, LobesKeepTheirOwnColour) {
  TwoLobesExplicit two;
  two.first = {-0.2, PlainExtinction{{{1e-3, 2e-3, 3e-3}}}, Spectrum::grey(0.5)};
  two.second = {0.8, PlainExtinction{{{3e-3, 2e-3, 1e-3}}}, Spectrum::grey(1.0)};
  two.veil = Veil{PlainExtinction{Spectrum::grey(1e-4)}, Spectrum::grey(1.0)};
  const Medium medium = medium_of({std::nullopt, two, {}});
  ASSERT_EQ(medium.species.size(), 3u);
  EXPECT_EQ(medium.species[0].scattering, (Spectrum{{0.5e-3, 1e-3, 1.5e-3}}));
  EXPECT_EQ(medium.species[1].scattering, (Spectrum{{3e-3, 2e-3, 1e-3}}));
  EXPECT_GT(mean_cosine_at(medium, {})[0], mean_cosine_at(medium, {})[2]);
}

}  // namespace
}  // namespace tyndall
