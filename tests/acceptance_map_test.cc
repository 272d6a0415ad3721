// Every category of the reference data is read by tests and stands on docs/accuracy.md, or waits for something named
// here: data of a new kind fails until somebody has looked at it.
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <vector>

#include "tests/acceptance.h"

namespace tyndall {
namespace {

struct Reader {
  std::string source, test;
};
// The tests that read each category (tests/acceptance.h makes them fail at cases and keys that they do not know).
const std::map<std::string, std::vector<Reader>> readers = {
    {"phase_functions",
     {{"tyndall/phase/phase_acceptance_test.cc", "EqualsTheIndependentFigures"},
      {"tyndall/cli/cli_test.cc", "PhaseAgreesWithTheReferenceDensitiesAndMoments"}}},
    {"two_hg_fits", {{"tyndall/phase/phase_acceptance_test.cc", "FitsOfTwoLobesHaveTheStatedErrors"}}},
    {"seed_w_blend", {{"tyndall/document/acceptance_test.cc", "TheNotesWAgrees"}}},
    {"rayleigh_air", {{"tyndall/document/acceptance_test.cc", "StandardAirAgrees"}}},
    {"visibility", {{"tyndall/document/acceptance_test.cc", "VisibilityAgrees"}}},
    {"polydispersions", {{"tyndall/document/acceptance_test.cc", "FogOfAWaterContentIsNearMiesTheory"}}},
    {"slab_flux",
     {{"tyndall/render/slab_truth_test.cc", "FluxesOfHomogeneousSlabs"},
      {"tyndall/render/slab_truth_test.cc", "AChromaticSlabGivesEveryChannelItsOwnAnswer"}}},
    {"slab_angular", {{"tyndall/render/slab_truth_test.cc", "RadianceAtExitAngles"}}},
    {"semi_infinite_flux", {{"tyndall/render/slab_truth_test.cc", "AlbedoOfHalfSpaces"}}},
    {"chandrasekhar_H", {{"tyndall/render/slab_truth_test.cc", "AlbedoOfHalfSpaces"}}},
    {"published_slab", {{"tyndall/render/slab_truth_test.cc", "PublishedSlabs"}}},
    {"mixtures_layers", {{"tyndall/render/slab_truth_test.cc", "MixturesLayersGroundAndDiffuseLight"}}},
    {"airlight_point",
     {{"tyndall/render/single_airlight_test.cc", "AirlightOfPointAndSpotLightsToTenDigits"},
      {"tyndall/render/path_test.cc", "AirlightOfPointAndSpotLights"},
      {"tyndall/cli/probe_test.cc", "SingleReachesThePublishedAirlight"}}},
    {"airlight_spot",
     {{"tyndall/render/single_airlight_test.cc", "AirlightOfPointAndSpotLightsToTenDigits"},
      {"tyndall/render/path_test.cc", "AirlightOfPointAndSpotLights"},
      {"tyndall/cli/probe_test.cc", "SingleReachesThePublishedAirlight"}}},
    {"point_source_fluence", {{"tyndall/render/path_test.cc", "FluenceOfAPointSourceInInfiniteMedium"}}},
};
// What there is no part of Tyndall for yet.
const std::map<std::string, std::string> waiting = {
    {"mie_efficiencies", "Lorenz-Mie theory of single particles (floor 4, particle)"},
    {"mie_angular", "Lorenz-Mie theory of single particles (floor 4, particle)"},
};

std::string text_of(const std::string& file) {
  std::ifstream in(std::string(TYNDALL_SOURCE_DIR) + "/" + file);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

TEST(AcceptanceMap, EveryCategoryIsReadOrWaitsForSomethingNamed) {
  TYNDALL_NEEDS_SHARED_FILE(folder, "acceptance");
  int categories = 0;
  tests::for_each_category(folder, [&](const std::string& name, const nlohmann::json& content) {
    ++categories;
    EXPECT_TRUE(readers.count(name) + waiting.count(name) == 1) << "nothing reads the category " << name;
    EXPECT_FALSE(content.at("items").empty()) << name;
  });
  EXPECT_GE(categories, 17);
}

// Whether or not the data is here.
TEST(AcceptanceMap, TestsAndPageSpeakOfTheCategoriesTheyAreListedFor) {
  const std::string page = text_of("docs/accuracy.md");
  for (const auto& [category, tests] : readers) {
    EXPECT_NE(page.find(category), page.npos) << category << " is not on docs/accuracy.md";
    for (const Reader& reader : tests) {
      const std::string source = text_of(reader.source);
      EXPECT_NE(source.find('"' + category + '"'), source.npos) << reader.source << " does not name " << category;
      EXPECT_NE(source.find(", " + reader.test + ")"), source.npos) << reader.source << " has no test " << reader.test;
    }
  }
}

}  // namespace
}  // namespace tyndall
