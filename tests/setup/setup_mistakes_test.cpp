#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "setup/setup.hpp"
#include "support/test_names.hpp"

/// What people write wrongly in setup files.
namespace probewright::setup {
namespace {

using testing::HasSubstr;
using testing::SizeIs;

TEST(Setup, ReportsAllMistakesOfAFile) {
  Diagnostics diagnostics;
  EXPECT_FALSE(
      parseSetup("sed = 1\n[machine]\nname = \"mill3\"\nspeed = 1\n[[tool]]\nnumber = 1\n", "s.toml", diagnostics));
  EXPECT_THAT(diagnostics, SizeIs(5)) << "sed, speed, kind, length, ball_radius";
}

struct Mistake {
  const char *text, *message;
};
void PrintTo(const Mistake& mistake, std::ostream* out) { *out << testing_support::plainWords(mistake.message); }

class SetupMistake : public testing::TestWithParam<Mistake> {};

TEST_P(SetupMistake, IsReportedWithPlaceReasonAndAdvice) {
  Diagnostics diagnostics;
  EXPECT_FALSE(parseSetup(GetParam().text, "s.toml", diagnostics));
  ASSERT_FALSE(diagnostics.empty());
  EXPECT_THAT(format(diagnostics.front()), HasSubstr(GetParam().message));
}

constexpr const char* probeHead = "[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 100\nball_radius = 3\n";

INSTANTIATE_TEST_SUITE_P(
    All, SetupMistake,
    testing::Values(
        Mistake{"seeed = 1", "s.toml:1:1: error: unknown key \"seeed\"\n    Did you mean \"seed\"?"},
        Mistake{"seed = -1", "s.toml:1:8: error: \"seed\" must be a whole number from 0"},
        Mistake{"seed = 1.5", "\"seed\" must be a whole number"}, Mistake{"a = [1, 2", "this is not valid TOML"},
        Mistake{"[machine]\nname = \"mill33\"", "s.toml:2:8: error: there is neither a ready-made machine nor a file"},
        Mistake{"[machine]\nname = \"mill33\"", "Did you mean \"mill3\"?"},
        Mistake{"[machine]\nname = \"mill3\"\nfile = \"a.toml\"",
                "s.toml:3:8: error: [machine] has both a name and a file"},
        Mistake{"[machine]\nstart = { X = 5000 }", "\"X\" in [machine.start] must be at least -500 and at most 500"},
        Mistake{"[machine]\nstart = { Q = 5 }", "the machine has no axis called Q\n    It has X, Y, Z"},
        Mistake{"machine = \"mill3\"", "s.toml:1:11: error: \"machine\" must be a table, written [machine]"},
        Mistake{"[control]\ntype = \"TNC64\"", "Did you mean \"TNC640\"?"},
        Mistake{"[control]\ntables = \"no-such-folder\"", "s.toml:2:10: error: there is no folder"},
        Mistake{"[part]\nname = \"a\"", "s.toml:1:1: error: [part] needs either a file or features"},
        Mistake{"[[part.feature]]\nshape = \"bax\"", "s.toml:2:9: error: \"shape\" cannot be \"bax\""},
        Mistake{"[[part.feature]]\nshape = \"bax\"", "Did you mean \"box\"?"},
        Mistake{"[[part.feature]]\nshape = \"box\"\nsize = [1, 2]", "\"size\" in [[part.feature]] must be a list of 3"},
        Mistake{"[[part.feature]]\nshape = \"box\"\nsize = [1, 2, -3]",
                "s.toml:3:8: error: \"size\" in [[part.feature]] must be a list of numbers, each at least 0.001 and at "
                "most"},
        Mistake{"[[part.feature]]\nshape = \"sphere\"\ndiameter = 5\ndepth = 3",
                "s.toml:4:1: error: unknown key \"depth\" in [[part.feature]]"},
        Mistake{"[[part.feature]]\nshape = \"fillet\"\nradius = 5\nedges = [1]",
                "s.toml:4:9: error: \"edges\" in [[part.feature]] must be a list of points"},
        Mistake{"[[part.feature]]\nshape = \"fillet\"\nradius = 5\nedges = [[0, 0, inf]]",
                "s.toml:4:9: error: \"edges\" in [[part.feature]] must be a list of points"},
        Mistake{"[[part.feature]]\nshape = \"fillet\"\nradius = 5\nedges = [[0, \"top\", 0]]",
                "s.toml:4:9: error: \"edges\" in [[part.feature]] must be a list of points"},
        Mistake{"[[fixture]]\n[[fixture.feature]]\nshape = \"hole\"\ndiameter = 5\n[[fixture.feature.pattern]]\n"
                "kind = \"linear\"\ncount = 0\nspacing = [1, 0, 0]",
                "s.toml:7:9: error: \"count\" in [[fixture.feature.pattern]] must be a whole number from 1 to 1000"},
        Mistake{"[part]\nfile = \"a.dwg\"", "s.toml:2:8: error: \"a.dwg\" is not a part file"},
        Mistake{"[part]\nfile = \"a.stl\"\npose = { x = \"1\" }", "\"x\" in [part.pose] must be a number"},
        Mistake{"[part]\nfile = \"a.stl\"\npose = { alpha = 1 }", "unknown key \"alpha\" in [part.pose]"},
        Mistake{"[fixture]\nfile = \"a.stl\"", "\"fixture\" must be a list of tables, each written [[fixture]]"},
        Mistake{"[ring]\n", "\"diameter\" is missing in [ring]"},
        Mistake{"[ring]\ndiameter = 50\nouter_diameter = 40", "the ring must be larger than its bore"},
        Mistake{"[sphere]\ndiameter = -25",
                "s.toml:2:12: error: \"diameter\" in [sphere] must be at least 0.001 and at most 100000"},
        Mistake{"[sphere]\ndiameter = 25\nstem_diameter = 30", "the stem must be thinner"},
        Mistake{"[gauge_block]\nsize = [1, 2]", "\"size\" in [gauge_block] must be a list of 3 numbers"},
        Mistake{"[gauge_block]\nsize = [1, 2, 0]",
                "\"size\" in [gauge_block] must be a list of numbers, each at least 0.001"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"prob\"\nlength = 1\nball_radius = 0.1", "Did you mean \"probe\"?"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 50", "\"radius\" is missing in [[tool]]"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 50\nradius = 5\nball_radius = 3",
                "s.toml:6:1: error: unknown key \"ball_radius\" in [[tool]]"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 50\nradius = 5\n"
                "[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 50\nradius = 5\n",
                "s.toml:7:10: error: there are two tools with number 1"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 5\nball_radius = 3",
                "the probe is shorter than its ball"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 50\nball_radius = 3\nstylus_radius = 3",
                "the stylus must be thinner than its ball"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"probe\"\nlength = 150\nball_radius = 3\nstylus_length = 150",
                "s.toml:6:17: error: the stylus must be shorter than the whole probe"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 1e300\nradius = 5",
                "s.toml:4:10: error: \"length\" in [[tool]] must be"},
        Mistake{"[[tool]]\nnumber = 1\nkind = \"mill\"\nlength = 50\nradius = 5\nshank_direction = [0, 0, 0]",
                "a direction cannot be [0, 0, 0]"},
        Mistake{"[[preset]]\norigin = [1, 2, 3]", "\"row\" is missing in [[preset]]"},
        Mistake{"[[preset]]\nrow = 1\n[[preset]]\nrow = 1", "s.toml:4:7: error: this row appears here twice"},
        Mistake{"[[preset]]\nrow = 1\nactive = true\n[[preset]]\nrow = 2\nactive = true", "only one can be active"},
        Mistake{"[[preset]]\nrow = 1\nrotary = { X = 1 }", "the machine has no rotary axis called X"},
        Mistake{"[control]\ntype = \"TNC640\"\n[[zero_offset]]\nname = \"G54\"\n[[zero_offset]]\nname = \"G55\"",
                "s.toml:4:8: error: the TNC640 has no settable zero offsets\n    Write [[preset]], or leave [control] "
                "type"},
        Mistake{"[control]\ntype = \"840Dsl\"\n[[preset]]\nrow = 1",
                "s.toml:4:7: error: the 840Dsl has no preset table\n    Write [[zero_offset]]"},
        Mistake{"[[zero_offset]]\nname = \"G58\"", "s.toml:2:8: error: \"G58\" is not a settable zero offset"},
        Mistake{"[errors.axis.W]\nscale_mm_per_m = 1", "the machine has no axis called W"},
        Mistake{"[errors.axis.X]\nscale = 1", "s.toml:2:1: error: unknown key \"scale\" in [errors.axis.X]"},
        Mistake{"[errors.axis.X]\nbacklash = -1", "\"backlash\" in [errors.axis.X] must be at least 0"},
        Mistake{"[[errors.axis.X.deviation]]\nwavelength = 0", "\"wavelength\" in [[errors.axis.X.deviation]] must be"},
        Mistake{"[[errors.squareness]]\naxis = \"X\"\ntowards = \"X\"\ndegrees = 1",
                "an axis cannot lean towards itself"},
        Mistake{"[errors.rotary.C]\nposition = [0, 0, 0]",
                "the machine has no rotary axis called C\n    It has no rotary axis"},
        Mistake{"[[errors.thermal]]\ntime_constant = 100", "\"amount\" is missing in [[errors.thermal]]"},
        Mistake{"[[part.feature]]\nshape = \"bore\"", "\"shape\" cannot be \"bore\"; it must be one of box"},
        Mistake{"[[part.feature]]\nshape = \"bore\"", "Did you mean \"hole\"?"},
        Mistake{"[[part.feature]]\nshape = \"boss\"", "Did you mean \"cylinder\"?"},
        Mistake{"[[part.feature]]\nshape = \"groove\"", "Did you mean \"slot\"?"},
        Mistake{"[[part.feature]]\nshape = \"box\"\nsize = [1e9, 1, 1]", "each at least 0.001 and at most 100000"},
        Mistake{"[[part.feature]]\nshape = \"box\"\nsize = [1e-9, 1, 1]", "each at least 0.001 and at most 100000"},
        Mistake{"[[part.feature]]\nshape = \"box\"\nsize = [10, 8, 1]\ncorner_radius = 4.1",
                "s.toml:4:17: error: \"corner_radius\" must be at most half"},
        Mistake{"[[part.feature]]\nshape = \"torus\"\ndiameter = 10\ntube_diameter = 10",
                "\"tube_diameter\" must be smaller than \"diameter\""},
        Mistake{"[[part.feature]]\nshape = \"cone\"\ndiameter = 10\ntop_diameter = 10\nheight = 5",
                "\"top_diameter\" is equal to \"diameter\"\n    Write shape = \"cylinder\""},
        Mistake{"[[part.feature]]\nshape = \"slot\"\nsize = [10, 20]", "a slot is at most as wide as it is long"},
        Mistake{"[[part.feature]]\nshape = \"fillet\"\nradius = 2\nedges = []",
                "s.toml:4:9: error: \"edges\" needs a point on each edge"},
        Mistake{"[part]\nfeature = []", "s.toml:2:11: error: there is no feature in it"},
        Mistake{"[[part.feature]]\nshape = \"hole\"\ndiameter = 5\n[[part.feature.pattern]]\nkind = \"linear\"\n"
                "count = 40\nspacing = [9, 0, 0]\n[[part.feature.pattern]]\nkind = \"linear\"\ncount = 40\n"
                "spacing = [0, 9, 0]",
                "s.toml:10:9: error: the patterns of this feature make more than 1000 copies"},
        Mistake{"[[errors.axis.X.deviation]]\npolynomial = [0, 1e300, 1e300]",
                "must be a list of numbers, each at least -10 and at most 10"},
        Mistake{"[[errors.axis.X.deviation]]\npolynomial = [0,0,0,0,0,0,0,0,0,0,0]", "has at most 10 coefficients"},
        Mistake{"[part]\nfile = \"a.stl\"\npose = { x = 1e300 }", "\"x\" in [part.pose] must be at least -100000"},
        Mistake{"[[preset]]\nrow = 1\norigin = [1e300, 0, 0]", "each at least -100000 and at most 100000"},
        Mistake{"[parameters]\nMP1 = [1]", "\"MP1\" in [parameters] must be a number, a text, true or false"}));

TEST(SetupMistakes, PatternsMakeUpToAThousandCopies) {
  for (const auto& [first, second, tooMany] :
       std::vector<std::tuple<int, int, bool>>{{1000, 1, false}, {40, 25, false}, {77, 13, true}, {2, 501, true}}) {
    const std::string text = fmt::format(
        "[[part.feature]]\nshape = \"sphere\"\ndiameter = 1\n[[part.feature.pattern]]\nkind = \"linear\"\n"
        "count = {}\nspacing = [9, 0, 0]\n[[part.feature.pattern]]\nkind = \"linear\"\ncount = {}\n"
        "spacing = [0, 9, 0]\n",
        first, second);
    Diagnostics diagnostics;
    static_cast<void>(parseSetup(text, "s.toml", diagnostics));
    const bool found = std::ranges::any_of(diagnostics, [](const Diagnostic& each) {
      return each.message.find("more than 1000 copies") != std::string::npos;
    });
    EXPECT_EQ(found, tooMany) << first << " " << second;
  }
}

}  // namespace
}  // namespace probewright::setup
