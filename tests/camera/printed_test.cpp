#include <gmock/gmock.h>

#include "camera/scenes.hpp"

/// The printed examples of the cycles, each in a world made for it.
namespace probewright::testing_support {
namespace {

const std::string printed600 =
    "4 TCH PROBE 600 GLOBAL. RABOCH. ZONA ~\n  QS600 = \"OS\";KONTROLNAYA TOCHKA ~\n  Q616=500 ;PODACHA ~\n"
    "  Q309 = 1 ;PGM- STOP DOPUSK ~\n  Q617 = 10 ;OPORNYE IZOBRAZHENIYA\n";
const std::string printed601 =
    "4 TCH PROBE 601 LOKAL. RABOCH. ZONA ~\n  QS600=\"OS\";KONTROLNAYA TOCHKA ~\n  Q309=+1 ;PGM- STOP DOPUSK ~\n"
    "  Q613=0 ;DERZHAT' KAMERU OTKRYTOI ~\n  Q617=10 ;OPORNYE IZOBRAZHENIYA\n";
/// The labels that the page leaves out lead to the end.
const std::string printedQuery =
    "2 FUNCTION MODE MILL\n"
    "3 TCH PROBE 601 LOKAL. RABOCH. ZONA ~\n  QS600 = OS ;KONTROLNAYA TOCHKA ~\n  Q309 = +0 ;PGM- STOP DOPUSK ~\n"
    "  Q613 = +0 ;DERZHAT' KAMERU OTKRYTOI ~\n  Q617 = 10 ;OPORNYE IZOBRAZHENIYA\n"
    "4 FN 9: IF Q601 EQU 1 GOTO LBL 20\n5 FN 9: IF Q601 EQU 2 GOTO LBL 21\n6 FN 9: IF Q601 EQU 3 GOTO LBL 22\n"
    "7 FN 9: IF Q601 EQU 10 GOTO LBL 23\n8 M30\n9 LBL 20\n10 Q1 = 20\n11 M30\n57 LBL 21\n58 STOP\n59 Q1 = 21\n"
    "60 M30\n61 LBL 22\n62 Q1 = 22\n63 M30\n64 LBL 23\n65 Q1 = 23\n";

TEST(PrintedCameraExamples, RunOneAfterAnother) {
  CameraBench bench;
  RunFolder folder;
  bench.answers({{"600 OS", teach(10, bench.camera())}, {"601 OS", teach(10, bench.camera())}});
  for (const std::string& printed : {printed600, printed601}) {
    const Ran ran = bench.run(printed);
    EXPECT_TRUE(ran.finished()) << ran.why();
    EXPECT_EQ(ran.q(601), 1);
    folder.keep(ran);
  }
  EXPECT_EQ(bench.run(printedQuery).q(1), 22) << "nothing is set up yet";
  bench.setup.beliefs.tables = folder.path();
  EXPECT_EQ(bench.run(printedQuery).q(1), 20);
  CameraBench crowded = bench;
  crowded.put("spanner", SolidRole::Fixture, {box({70, 14, 8})}, {0, 0, plateTop}, 40);
  EXPECT_EQ(crowded.run(printedQuery).q(1), 21);
  CameraBench broken = bench;
  broken.camera().fault = camera::CameraFault::NoSignal;
  EXPECT_EQ(broken.run(printedQuery).q(1), 23);
}

}  // namespace
}  // namespace probewright::testing_support
