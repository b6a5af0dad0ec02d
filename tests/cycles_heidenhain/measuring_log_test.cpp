#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "cycles_heidenhain/worlds.hpp"
#include "language/encoding.hpp"

/// The logs of the inspection cycles, letter by letter.
namespace probewright::testing_support {
namespace {

using control::DialogLanguage;
using ::testing::HasSubstr;

// Titles, labels and values are those of the log of cycle 421 that the manuals of each language print.
constexpr const char* english = R"(****** Measuring Log for Probing Cycle 421 Hole Measuring *****

Date:              30-06-2005
Time:              6:55:04
Measuring program: TNC:\GEH35712\CHECK1.H
-------------------------------------------------------------
Nominal values:      Center in reference axis:                   50.0000
                     Center in minor axis:                       65.0000
                     Diameter:                                   12.0000
-------------------------------------------------------------
Given limit values:  Maximum limit for center in reference axis: 50.1000
                     Minimum limit for center in reference axis: 49.9000
                     Maximum limit for center in minor axis:     65.1000
                     Minimum limit for center in minor axis:     64.9000
                     Maximum dimension for hole:                 12.0450
                     Minimum dimension for hole:                 12.0000
*************************************************************
Actual values:       Center in reference axis:                   50.0810
                     Center in minor axis:                       64.9530
                     Diameter:                                   12.0259
-------------------------------------------------------------
Deviations:          Center in reference axis:                    0.0810
                     Center in minor axis:                       -0.0470
                     Diameter:                                    0.0259
*************************************************************
Further measuring results: Measuring height:                     -5.0000
******************** End of measuring log ********************
)";

constexpr const char* russian = R"(****** Протокол измерений цикла 421 Измерение отверстия *****

Дата:                30.06.2005
Время:               6:55:04
Программа измерения: TNC:\GEH35712\CHECK1.H
-------------------------------------------------------------
Заданные значения:             Центр главной оси:                              50.0000
                               Центр вспомогательной оси:                      65.0000
                               Диаметр:                                        12.0000
-------------------------------------------------------------
Заданные предельные значения:  Максимальный размер центра главной оси:         50.1000
                               Наименьший размер центра главной оси:           49.9000
                               Максимальный размер центра вспомогательной оси: 65.1000
                               Наименьший размер центра вспомогательной оси:   64.9000
                               Максимальный размер отверстия:                  12.0450
                               Наименьший размер отверстия:                    12.0000
*************************************************************
Фактические значения:          Центр главной оси:                              50.0810
                               Центр вспомогательной оси:                      64.9530
                               Диаметр:                                        12.0259
-------------------------------------------------------------
Погрешности:                   Центр главной оси:                               0.0810
                               Центр вспомогательной оси:                      -0.0470
                               Диаметр:                                         0.0259
*************************************************************
Прочие результаты измерений:   Высота измерения:                               -5.0000
******************** Окончание протокола измерения ********************
)";

constexpr const char* swedish = R"(****** Mätprotokoll avkännarcykel 421 Mätning av hål *****

Datum:      30-06-2005
Klockan:    6:55:04
Mätprogram: TNC:\GEH35712\CHECK1.H
-------------------------------------------------------------
Börvärden:          Centrum huvudaxel:                          50.0000
                    Centrum komplementaxel:                     65.0000
                    Diameter:                                   12.0000
-------------------------------------------------------------
Givna gränsvärden:  Största mått centrum huvudaxel:             50.1000
                    Minsta mått centrum huvudaxel:              49.9000
                    Största mått centrum komplementaxel:        65.1000
                    Minsta mått centrum komplementaxel:         64.9000
                    Största mått hål:                           12.0450
                    Minsta mått hål:                            12.0000
*************************************************************
Ärvärden:           Centrum huvudaxel:                          50.0810
                    Centrum komplementaxel:                     64.9530
                    Diameter:                                   12.0259
-------------------------------------------------------------
Avvikelser:         Centrum huvudaxel:                           0.0810
                    Centrum komplementaxel:                     -0.0470
                    Diameter:                                    0.0259
*************************************************************
Ytterligare mätresultat: Mäthöjd:                               -5.0000
******************** Mätprotokoll slut ********************
)";

/// A hole whose measured values are those of the printed log; the log is written at 6:55:04.
Ran printedRun(ControlKind kind, DialogLanguage language, int logParameter = 1) {
  Bench bench(kind);
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::Ring(12.0259 / 2, 40, -40), pose({50.081, 64.953, -400}));
  bench.probeOf(100, 1);
  bench.program = "TNC:\\GEH35712\\CHECK1.H";
  bench.language = language;
  const Words words = {{273, 50},  {274, 65},           {262, 12}, {325, 0},      {247, 90}, {261, -5},
                       {320, 0},   {260, 20},           {301, 0},  {275, 12.045}, {276, 12}, {279, 0.1},
                       {280, 0.1}, {281, logParameter}, {309, 0},  {330, 0}};
  // How long the machine travels before the log is written decides when the program has to start.
  const std::int64_t printed = 1120114504;  // 30 June 2005, 6:55:04
  bench.wallClock = printed - std::llround(bench.run(probe(421, words)).cycle().endSeconds);
  Ran ran = bench.run(probe(421, words));
  EXPECT_TRUE(ran.finished()) << ran.why();
  EXPECT_EQ(ran.q(180), 1);
  return ran;
}

TEST(MeasuringLog, IsLaidOutAsPrinted) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530})
    EXPECT_EQ(printedRun(kind, DialogLanguage::English).log("TCHPR421.TXT"), english);
}

/// Also where a limit has a sign or many digits, in inches too.
TEST(MeasuringLog, HasAllValuesInOneColumn) {
  for (const ControlKind kind : {ControlKind::TNC640, ControlKind::iTNC530}) {
    for (const bool inch : {false, true}) {
      for (const double x : {-50.0, -312.0, 312.0}) {
        SCOPED_TRACE(fmt::format("inch {} X{}", inch, x));
        const double unit = inch ? 25.4 : 1;
        Bench bench(kind);
        bench.preset(1, {0, 0, -400});
        bench.part(simulation::Ring(6, 40, -40), pose({x, -65, -400}));
        bench.probeOf(100, 1);
        const Ran ran = bench.run(probe(421, {{273, x / unit},
                                              {274, -65 / unit},
                                              {262, 12 / unit},
                                              {325, 0},
                                              {247, 90},
                                              {261, -5 / unit},
                                              {320, 0},
                                              {260, 20 / unit},
                                              {301, 0},
                                              {275, 12.1 / unit},
                                              {276, 11.9 / unit},
                                              {279, 0.1 / unit},
                                              {280, 0.1 / unit},
                                              {281, 1},
                                              {309, 0},
                                              {330, 0}}),
                                  inch ? "INCH" : "MM");
        ASSERT_TRUE(ran.finished()) << ran.why();
        std::istringstream log(ran.log("TCHPR421.TXT"));
        std::set<std::size_t> ends;
        int values = 0;
        for (std::string line; std::getline(log, line);) {
          if (line.empty() || line.back() < '0' || line.back() > '9' || line.find('.') == std::string::npos) continue;
          ends.insert(line.size());
          ++values;
        }
        EXPECT_EQ(values, 16);
        EXPECT_EQ(ends.size(), 1U) << ran.log("TCHPR421.TXT");
      }
    }
  }
}

TEST(MeasuringLog, SpeaksTheLanguageOfTheControl) {
  EXPECT_EQ(printedRun(ControlKind::TNC640, DialogLanguage::Russian).log("TCHPR421.TXT"), russian);
  EXPECT_EQ(printedRun(ControlKind::TNC640, DialogLanguage::Swedish).log("TCHPR421.TXT"), swedish);
  // The Chinese manual prints it in English.
  EXPECT_EQ(printedRun(ControlKind::iTNC530, DialogLanguage::Chinese).log("TCHPR421.TXT"), english);
  EXPECT_EQ(printedRun(ControlKind::iTNC530, DialogLanguage::Polish).log("TCHPR421.TXT"), english);
}

TEST(MeasuringLog, HasTheCharacterSetOfTheControl) {
  const std::string cyrillic = printedRun(ControlKind::iTNC530, DialogLanguage::Russian).log("TCHPR421.TXT");
  EXPECT_THAT(cyrillic, HasSubstr("\xC4\xE0\xF2\xE0:"));  // the word for date in windows-1251
  EXPECT_EQ(language::toUtf8(cyrillic, language::Encoding::Windows1251), russian);
  const std::string western = printedRun(ControlKind::iTNC530, DialogLanguage::Swedish).log("TCHPR421.TXT");
  EXPECT_THAT(western, HasSubstr("M\xE4tprogram:"));
  EXPECT_EQ(language::toUtf8(western, language::Encoding::Windows1252), swedish);
}

TEST(MeasuringLog, StandsOnTheScreenUntilTheProgramGoesOn) {
  const Ran ran = printedRun(ControlKind::iTNC530, DialogLanguage::Russian, 2);
  EXPECT_EQ(ran.log("TCHPR421.TXT"), "");
  EXPECT_EQ(ran.screens(), std::vector<std::string>{russian});
  EXPECT_EQ(printedRun(ControlKind::TNC640, DialogLanguage::English, 2).screens(), std::vector<std::string>{english});
  EXPECT_TRUE(printedRun(ControlKind::TNC640, DialogLanguage::English, 1).screens().empty());
}

/// Latin letters stand in names of axes and files only.
TEST(MeasuringLog, IsTranslatedInEveryCycle) {
  Bench bench;
  bench.language = DialogLanguage::Russian;
  bench.showAllResults = true;
  bench.preset(1, {0, 0, -400});
  bench.part(simulation::Box({-20, -20, -40}, {20, 20, 0}), pose({0, 0, -400}));
  const std::string blocks = probe(420, {{263, -10},
                                         {264, -20},
                                         {265, 10},
                                         {266, -20},
                                         {272, 2},
                                         {267, 1},
                                         {261, -5},
                                         {320, 0},
                                         {260, 20},
                                         {301, 0},
                                         {281, 0}}) +
                             probe(424, {{273, 0},
                                         {274, 0},
                                         {282, 40},
                                         {283, 40},
                                         {261, -5},
                                         {320, 0},
                                         {260, 20},
                                         {301, 0},
                                         {284, 40.1},
                                         {285, 39.9},
                                         {286, 40.1},
                                         {287, 39.9},
                                         {279, 0.1},
                                         {280, 0.1},
                                         {281, 0},
                                         {309, 0},
                                         {330, 0}}) +
                             probe(426, {{263, 20},
                                         {264, 0},
                                         {265, -20},
                                         {266, 0},
                                         {272, 1},
                                         {261, -5},
                                         {320, 0},
                                         {260, 20},
                                         {311, 40},
                                         {288, 40.1},
                                         {289, 39.9},
                                         {281, 0},
                                         {309, 0},
                                         {330, 0}}) +
                             probe(427, {{263, 0},
                                         {264, 0},
                                         {261, 0},
                                         {320, 0},
                                         {272, 3},
                                         {267, -1},
                                         {260, 20},
                                         {281, 0},
                                         {288, 0.1},
                                         {289, -0.1},
                                         {309, 0},
                                         {330, 0}}) +
                             probe(431, {{263, -10},
                                         {264, -10},
                                         {294, 0},
                                         {265, 10},
                                         {266, -10},
                                         {295, 0},
                                         {296, 0},
                                         {297, 10},
                                         {298, 0},
                                         {320, 0},
                                         {260, 20},
                                         {281, 0}});
  const Ran ran = bench.run(blocks);
  ASSERT_TRUE(ran.finished()) << ran.why();
  ASSERT_EQ(ran.screens().size(), 5U);
  for (std::string screen : ran.screens()) {
    const std::size_t program = screen.find("BENCH.H");
    ASSERT_NE(program, std::string::npos);
    screen.erase(program, 7);
    std::string latin;
    std::size_t letters = 0;
    for (const char c : screen) {
      letters = std::isalpha(static_cast<unsigned char>(c)) != 0 ? letters + 1 : 0;
      if (letters > 1) latin += c;
    }
    EXPECT_EQ(latin, "") << screen;
  }
}

}  // namespace
}  // namespace probewright::testing_support
