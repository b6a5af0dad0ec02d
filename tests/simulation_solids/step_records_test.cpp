#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <BRepAlgoAPI_Cut.hxx>
#include <BRepPrimAPI_MakeBox.hxx>
#include <BRepPrimAPI_MakeTorus.hxx>
#include <BinTools.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <XSControl_WorkSession.hxx>
#include <csignal>
#include <random>
#include <sstream>

#include "simulation/cad_solid.hpp"
#include "simulation/cad_step_library.hpp"
#include "simulation/step_records.hpp"
#include "simulation/step_text.hpp"
#include "worlds.hpp"
#include "written_step.hpp"

/// The records that OpenCASCADE's reader is given in place of those of its own scanner.
namespace probewright::simulation {
namespace {

using namespace testing;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string fileOf(const std::string& data) {
  return "ISO-10303-21;\nHEADER;\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\nDATA;\n" + data +
         "ENDSEC;\nEND-ISO-10303-21;\n";
}

/// "#7 PLANE(#8,'a')" of each record, the header's left out.
std::vector<std::string> recordsOf(const std::string& data, bool withoutAnnotations = false) {
  auto read = StepRecords::of(fileOf(data));
  if (!read) return {"another way"};
  if (withoutAnnotations) read->dropAnnotations();
  std::vector<std::string> all;
  for (std::size_t i = read->headerRecords(); i < read->records().size(); ++i) {
    const StepRecords::Record& record = read->records()[i];
    std::string arguments;
    for (std::size_t a = record.first; a < record.first + record.count; ++a)
      arguments += fmt::format("{}{}", a == record.first ? "" : " ", read->arguments()[a].text);
    const bool isList = record.type == std::string(StepRecords::kList);
    all.push_back(fmt::format("{} {}({})", record.name, isList ? "" : record.type, arguments));
  }
  return all;
}

TEST(StepRecords, HoldListsBeforeTheEntityThatTheyStandIn) {
  EXPECT_THAT(recordsOf("#1=A('x',#2,.T.,1,-2.5,1.e-3,$,*,\"0F\");\n"),
              ElementsAre("#1 A('x' #2 .T. 1 -2.5 1.E-3 $ * \"0F\")"));
  EXPECT_THAT(recordsOf("#1 = A ( 'it''s', ( 1., 2. ), ( ) ) ;"),
              ElementsAre("$1 (1. 2.)", "$2 ()", "#1 A('it''s' $1 $2)"));
  EXPECT_THAT(recordsOf("#1=A(((1,2),(3)),B(4.));"),
              ElementsAre("$2 (1 2)", "$3 (3)", "$1 ($2 $3)", "$4 B(4.)", "#1 A($1 $4)"));
  EXPECT_THAT(recordsOf("#5=(A()B((1),2)C(#1));#6=D();"),
              ElementsAre("#5 A()", "$1 (1)", "#0 B($1 2)", "#0 C(#1)", "#6 D()"));
  EXPECT_THAT(recordsOf("/* #9=X(); */\n#1=A(/* ' */ 'b;c(');\n"), ElementsAre("#1 A('b;c(')"));
}

TEST(StepRecords, LeaveWhatIsNotPlainToOpenCascade) {
  for (const std::string data :
       {"#1=A(1,);\n", "#1=A(,1);\n", "#1=A(1 2);\n", "#1=A(1;\n", "#1=A('x);\n", "#1=A(1))\n;", "#1=!OWN(1);\n",
        "#1=&SCOPE #2=B(); ENDSCOPE A();\n", "#1=A(1.E);\n", "#1=A(1E5);\n", "#1=A(.T);\n", "#1=A(-);\n", "#=A();\n",
        "#0=A();\n", "1=A();\n", "#1=A()\n", "#1=A(#);\n", "#1=(A());\n#2=();\n"}) {
    EXPECT_THAT(recordsOf(data), ElementsAre("another way")) << data;
  }
  EXPECT_FALSE(StepRecords::of(""));
  EXPECT_FALSE(StepRecords::of("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA('a',('b'));\nENDSEC;\nEND-ISO-10303-21;\n"));
  EXPECT_FALSE(StepRecords::of("ISO-10303-21;\nHEADER;\nENDSEC;\nDATA;\n"));
}

TEST(StepRecords, DropWhatOnlyDrawingsReferTo) {
  const std::string shape =
      "#1=SHAPE_DEFINITION_REPRESENTATION(#2,#3);#2=PRODUCT_DEFINITION_SHAPE('','',$);"
      "#3=SHAPE_REPRESENTATION('',(#4),$);#4=SOLID(#5);#5=FACE();";
  const std::vector<std::string> plain = recordsOf(shape, true);
  EXPECT_EQ(plain.size(), 6U);
  EXPECT_EQ(
      recordsOf(shape + "#10=STYLED_ITEM('',(#11),#5);#11=COLOUR();#12=PRESENTATION_LAYER_ASSIGNMENT('','',(#10));"
                        "#20=DRAUGHTING_MODEL('',(#21),$);#21=CURVE(#22,#5);#22=POINT();"
                        "#23=REPRESENTATION_RELATIONSHIP('','',#3,#20);"
                        "#24=DRAUGHTING_MODEL_ITEM_ASSOCIATION('','',#20,#21,#4);",
                true),
      plain);
  // What nobody knows stays, with all that it refers to.
  EXPECT_EQ(recordsOf(shape + "#10=UNKNOWN(#11);#11=COLOUR();", true).size(), plain.size() + 2);
  EXPECT_EQ(recordsOf(shape + "#10=(REPRESENTATION_RELATIONSHIP('','',#3,#11)SHAPE_REPRESENTATION_RELATIONSHIP());"
                              "#11=DRAUGHTING_MODEL('',(),$);",
                      true)
                .size(),
            plain.size() + 4);
}

/// What a reader has loaded: the entities by number and type.
std::string loaded(STEPControl_Reader& reader) {
  std::string all;
  const auto model = Handle(StepData_StepModel)::DownCast(reader.WS()->Model());
  if (model.IsNull()) return "nothing";
  for (int i = 1; i <= model->NbEntities(); ++i)
    all += fmt::format("#{} {} {}\n", model->IdentLabel(model->Value(i)), model->Value(i)->DynamicType()->Name(),
                       model->IsErrorEntity(i));
  return all;
}

void read(STEPControl_Reader& reader, const std::string& text, bool quickly) {
  Message::DefaultMessenger()->ChangePrinters().Clear();
  if (quickly) reader.WS()->SetLibrary(quickStepLibrary(text));
  std::istringstream stream(text);
  reader.ReadStream("part.step", stream);
}

std::string shapeOf(STEPControl_Reader& reader) {
  reader.TransferRoots();
  std::ostringstream bytes;
  BinTools::Write(reader.OneShape(), bytes, Standard_False, Standard_False, BinTools_FormatVersion_CURRENT);
  return bytes.str();
}

std::vector<std::string> sampleFiles() {
  const ScratchFolder folder;
  const TopoDS_Shape part =
      BRepAlgoAPI_Cut(BRepPrimAPI_MakeBox(40, 30, 20).Shape(), BRepPrimAPI_MakeTorus(12, 4).Shape()).Shape();
  EXPECT_TRUE(writeStep(part, folder / "part.step"));
  std::ifstream file(folder / "part.step");
  std::ostringstream own;
  own << file.rdbuf();
  StepFile written({25.4, true});
  const Meridian bush{{{6, 0}, {18, 0}, {22, 6}, {22, 14, true, 20, 14, true}, {20, 16}, {6, 16}}};
  Dialect splines;
  splines.surfaces = Dialect::Surfaces::Splines;
  const int shell = written.add(
      fmt::format("CLOSED_SHELL('',({}))", listOf(revolvedFaces(written, bush, Pose::Identity(), splines))));
  return {own.str(), written.withItems({written.add(fmt::format("MANIFOLD_SOLID_BREP('',#{})", shell))})};
}

TEST(StepRecords, GiveTheSameShapeAsOpenCascadesScanner) {
  for (const std::string& text : sampleFiles()) {
    ASSERT_TRUE(StepRecords::of(text));
    STEPControl_Reader plain, quick;
    read(plain, text, false);
    read(quick, text, true);
    EXPECT_EQ(loaded(quick), loaded(plain));
    const std::string shape = shapeOf(plain);
    EXPECT_GT(shape.size(), 2000U);
    EXPECT_TRUE(shapeOf(quick) == shape);
  }
}

TEST(StepRecords, OfDamagedFilesAreTheSameAsOpenCascadesOrLeftToIt) {
  std::mt19937_64 random(31);
  constexpr std::string_view characters = "0123456789#,()'.$*A;E ";
  int quick = 0, left = 0, refused = 0, endless = 0;
  for (const std::string& good : sampleFiles()) {
    for (int i = 0; i < 150; ++i) {
      std::string bad = good;
      bad[random() % bad.size()] = characters[random() % characters.size()];
      if (!StepRecords::of(bad)) {
        ++left;
        continue;
      }
      // Where a number stands twice OpenCASCADE reads memory that nobody has set: an import refuses such a file before.
      if (!scanStep(bad, "part.step")) {
        ++refused;
        continue;
      }
      ++quick;
      // OpenCASCADE may go round in a damaged file for ever: so a process of its own, which ends after a while.
      const pid_t child = fork();
      ASSERT_GE(child, 0);
      if (child == 0) {
        alarm(10);
        STEPControl_Reader one, other;
        read(one, bad, false);
        read(other, bad, true);
        _exit(loaded(other) == loaded(one) ? 0 : 1);
      }
      int status = 0;
      ASSERT_EQ(waitpid(child, &status, 0), child);
      if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
        ++endless;
      else
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0) << i << ", status " << status;
    }
  }
  EXPECT_GT(quick, 100);
  EXPECT_GT(left, 20);
  EXPECT_GT(refused, 0);
  EXPECT_LT(refused, quick / 10);
  EXPECT_EQ(endless, 0);
}

}  // namespace
}  // namespace probewright::simulation
