#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/program.hpp"

/// What `probewright cycles NAME` says of parameters.
namespace probewright::app::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The parameter in the answer of `probewright cycles CYCLE --json` with these options.
nlohmann::json catalogued(const char* cycle, const std::string& name, const std::vector<std::string>& options = {}) {
  std::vector<std::string> command = {"cycles", cycle, "--json"};
  command.insert(command.end(), options.begin(), options.end());
  const auto all = nlohmann::json::parse(probewright(command).output).at(0);
  for (const auto& each : all["parameters"])
    if (each["name"] == name) return each;
  return {};
}

// What the iTNC 530 refuses of these parameters, klartext/check_test.cpp and the tests of the cycles show.
TEST(Catalogue, PrintWhatTheControlTakes) {
  const std::vector<std::string> old = {"--control", "iTNC530"}, young = {"--control", "TNC640"};
  const auto text = [](std::vector<std::string> command) {
    command.insert(command.begin(), "cycles");
    return probewright(command).output;
  };
  EXPECT_THAT(text({"460", "--control", "iTNC530"}), HasSubstr("           3 to 4\n"));
  EXPECT_THAT(text({"460", "--control", "TNC640"}), HasSubstr("           3 to 8\n"));
  EXPECT_THAT(text({"460"}), HasSubstr("           3 to 8; iTNC530: 3 to 4\n"));
  // A parameter that only the other one has.
  EXPECT_THAT(text({"460", "--control", "iTNC530"}), Not(HasSubstr("Q455")));
  EXPECT_THAT(text({"460", "--control", "TNC640"}), Not(HasSubstr("TNC640 only")));
  EXPECT_THAT(text({"460"}), HasSubstr("TNC640 only"));
  EXPECT_THAT(text({"412", "--control", "iTNC530"}), HasSubstr("340 49x-05"));
  EXPECT_THAT(text({"412", "--control", "TNC640"}), Not(HasSubstr("340 49x-05")));
  EXPECT_EQ(catalogued("460", "Q423", old)["maximum"], 4);
  EXPECT_EQ(catalogued("460", "Q423", young)["maximum"], 8);
  EXPECT_EQ(catalogued("460", "Q423")["maximum"], 8);
  EXPECT_EQ(catalogued("460", "Q423")["on"]["iTNC530"]["maximum"], 4);
  EXPECT_TRUE(catalogued("460", "Q455", old).is_null());
  EXPECT_EQ(catalogued("450", "Q409", old)["maximum"], 9);
  EXPECT_EQ(catalogued("450", "Q409", old)["text"], false);
  EXPECT_EQ(catalogued("450", "Q409")["text"], true);
  const auto values = [](const nlohmann::json& parameter) {
    std::vector<int> all;
    for (const auto& choice : parameter["choices"])
      all.push_back(choice["value"]);
    return all;
  };
  using Values = std::vector<int>;
  for (const char* tool : {"481", "482", "483"})
    EXPECT_EQ(values(catalogued(tool, "Q340", old)), (Values{0, 1})) << tool;
  EXPECT_EQ(values(catalogued("31", "CHECK", old)), (Values{0, 1}));
  EXPECT_EQ(values(catalogued("31", "CHECK", young)), (Values{0, 1, 2}));
  EXPECT_EQ(values(catalogued("403", "Q312", old)), (Values{4, 5, 6}));
  EXPECT_EQ(values(catalogued("450", "Q410", old)), (Values{0, 1, 2}));
  EXPECT_EQ(values(catalogued("451", "Q406", old)), (Values{0, 1, 2}));
  EXPECT_EQ(values(catalogued("451", "Q406", young)), (Values{0, 1, 2, 3}));
  EXPECT_EQ(catalogued("451", "Q406")["choices"][3]["controls"], nlohmann::json({"TNC640"}));
}

// The input ranges of the manuals: FMAX and FAUTO stand for the feed of cycle 441 on the TNC 640 and for Q253 of cycles
// 451 to 453 on both; cycle 600 takes a number.
TEST(Catalogue, TellsWhereFmaxMayStand) {
  const auto text = [](std::vector<std::string> command) {
    command.insert(command.begin(), "cycles");
    return probewright(command).output;
  };
  EXPECT_THAT(text({"441"}), HasSubstr("0 to 99999.9999 mm/min or FMAX, FAUTO (TNC640 only)\n"));
  EXPECT_THAT(text({"441", "--control", "TNC640"}), HasSubstr("0 to 99999.9999 mm/min or FMAX, FAUTO\n"));
  EXPECT_THAT(text({"441", "--control", "iTNC530"}), HasSubstr("0 to 99999.9999 mm/min\n"));
  EXPECT_THAT(text({"451"}), HasSubstr("0.0001 to 99999.9999 mm/min or FMAX, FAUTO; PREDEF\n"));
  EXPECT_THAT(text({"600"}), HasSubstr("0.001 to 99999.999 mm/min\n"));
  EXPECT_EQ(catalogued("441", "Q396")["feed_words"], nlohmann::json({"TNC640"}));
  EXPECT_FALSE(catalogued("600", "Q616").contains("feed_words"));
}

// The manual, list of parameters of CYCLE998: the way from the start position to point 1 along the measuring axis. That
// of an edge lies in the plane; the probe stands at measuring height from the beginning.
TEST(Catalogue, TellsTheWayOfAProtectionZone) {
  const std::string way = catalogued("CYCLE998", "S_SETV")["meaning"];
  EXPECT_THAT(way, HasSubstr("way along the measuring axis (S_MA)"));
  EXPECT_THAT(way, Not(HasSubstr("height")));
  EXPECT_THAT(probewright({"cycles", "CYCLE998", "--language", "de"}).output, HasSubstr("Weg in der Messachse (S_MA)"));
}

}  // namespace
}  // namespace probewright::app::testing
