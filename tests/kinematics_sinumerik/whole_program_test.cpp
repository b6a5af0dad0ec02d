#include <gmock/gmock.h>

#include "kinematics_sinumerik/scene.hpp"

/// The manual's example of CYCLE996 as a program of our own: its sequence, positions and values on a machine with B in
/// the head and C in the table, whose data set is that of the drawing.
namespace probewright {
namespace {

using namespace testing_support;
using ::testing::HasSubstr;

/// The printed program has an ENDIF without IF, uses a variable that it does not declare, and declares one that it does
/// not use. Here the axes are turned in one subprogram-like loop instead of six copies of the same lines.
constexpr const char* program = R"(DEF REAL AT_B[6]=SET(0,45,-45,0,0,0)
DEF REAL AT_C[6]=SET(0,0,0,0,90,180)
DEF REAL BEGIN_AT[6]=SET(0,45,210,0,0,0)
DEF REAL BALL=25
DEF REAL GAP=1
DEF INT PLACE
DEF INT CALLED
_FA=GAP*3
_TSA=GAP*4
REPEAT DATA_BEGIN DATA_END
MSG("Kinematics loaded?")
M0
STOPRE
MSG()
G17
CYCLE800()
ORIAXES ORIMKS
TRAORI
G56
T="3D-TASTER" D1
M6
IF (NOT $P_SEARCH) AND (NOT $P_ISTEST) AND (NOT $P_SIM)
 _OVR[40]=0
ENDIF
N99 G1 G710 G90 Z30 FFWON F2000
FOR PLACE=0 TO 5
 CALLED=10101+PLACE
 IF PLACE==0
  TOFFL=BALL/2+GAP
  D1 B=AT_B[0] C=AT_C[0]
  TOFFL=0
  X0 Y0 Z=GAP
 ELSE
  G1 F2000
  TOFFL=BALL/2+GAP
  D1 B=AT_B[PLACE] C=AT_C[PLACE]
  TOFFL=0
 ENDIF
 IF PLACE==3
  ; the first place of C is the first place of B
  _OVR[51]=_OVR[41] _OVR[52]=_OVR[42] _OVR[53]=_OVR[43]
  IF (NOT $P_SEARCH) AND (NOT $P_ISTEST) AND (NOT $P_SIM)
   _OVR[40]=_OVR[40]+10
  ENDIF
 ELSE
  IF PLACE>3
   CALLED=20098+PLACE
  ENDIF
  CYCLE996(CALLED,1,1,BALL,BEGIN_AT[PLACE],0,0,0,0,0,0,0,_FA,_TSA,1,,1,)
  M1
  STOPRE
  TOROT
  Z=IC(-_FA+GAP)
  TOROTOF
 ENDIF
ENDFOR
G0 Z30
B0 C0
CYCLE996(13001000,1,1,BALL,_STA1,0,0,0,0,0.02,0.001,22,_FA,_TSA,1,,1,101)
MSG("Kinematics measured")
M1
M30
DATA_BEGIN:
TCARR=0
TRAFOOF
$TC_CARR1[1]=-25 $TC_CARR2[1]=0 $TC_CARR3[1]=-121
$TC_CARR4[1]=25 $TC_CARR5[1]=0 $TC_CARR6[1]=121
$TC_CARR7[1]=0 $TC_CARR8[1]=1 $TC_CARR9[1]=0
$TC_CARR10[1]=0 $TC_CARR11[1]=0 $TC_CARR12[1]=-1
$TC_CARR13[1]=0 $TC_CARR14[1]=0
$TC_CARR15[1]=0 $TC_CARR16[1]=0 $TC_CARR17[1]=0
$TC_CARR18[1]=0 $TC_CARR19[1]=0 $TC_CARR20[1]=0
$TC_CARR23[1]="M"
$TC_CARR24[1]=0 $TC_CARR25[1]=0
$TC_CARR30[1]=-92 $TC_CARR31[1]=0
$TC_CARR32[1]=92 $TC_CARR33[1]=360
$TC_CARR34[1]="MIXED_BC"
$TC_CARR35[1]="B" $TC_CARR36[1]="C"
$TC_CARR37[1]=415003003
N24100 $MC_TRAFO_TYPE_1=72
N24110 $MC_TRAFO_AXES_IN_1[3]=4
N24110 $MC_TRAFO_AXES_IN_1[4]=5
N24574 $MC_TRAFO5_BASE_ORIENT_1[2]=1
N24582 $MC_TRAFO5_TCARR_NO_1=1
N42940 $SC_TOOL_LENGTH_CONST=0
N42950 $SC_TOOL_LENGTH_TYPE=0
STOPRE
NEWCONF
DATA_END:
M17
)";

class NoPrograms : public language::ProgramLibrary {
public:
  Result<std::shared_ptr<language::Program>> open(std::string_view, const language::Program*) override {
    return fail("none");
  }
  bool exists(std::string_view, const language::Program*) override { return false; }
};

TEST(WholeProgram, MeasuresTheMachineOfTheManual) {
  simulation::Truth truth = perfectWorld("mill5-head-table");
  for (machine::ChainElement& element : truth.machine.spindleChain)
    if (element.axis == truth.machine.axisIndex("B")) element.point = {25, 0, 121};
  truth.tools[0].name = "3D-TASTER";
  // Small enough for the program's tolerances: 0.02 mm and 0.001 degrees.
  truth.errors.rotaryAxes = {{*truth.machine.axisIndex("B"), {0.008, 0, -0.006}, {0.0004, 0, -0.0003}},
                             {*truth.machine.axisIndex("C"), {-0.005, 0.007, 0}, {-0.0002, 0.0005, 0}}};
  const Vector3 ball(130, 130, -600);
  place(truth, simulation::SolidSphere(Vector3::Zero(), 12.5), translation(ball), "ball",
        simulation::SolidRole::Sphere);
  place(truth, simulation::RoundBar(4, -70, -11), translation(ball) * rotation(Vector3(1, 1, 0).normalized(), 45),
        "stem", simulation::SolidRole::Fixture);
  SinumerikBench bench(truth);
  bench.control.data.set("$TC_TP2", {1}, std::string("3D-TASTER"));
  plantFrame(bench, "$P_UIFR", 3, ball + Vector3(0, 0, 12.5));  // G56: the north pole
  NoPrograms library;
  execution::InterpreterOptions options;
  options.programDepth = execution::sinumerik::SinumerikHost::programDepth;
  execution::sinumerik::SinumerikHost host(bench.control);
  const auto result = execution::Interpreter(library, host, options)
                          .run(language::sinumerik::SinumerikProgram::fromText("KINEMATICS.MPF", program));
  for (const Diagnostic& diagnostic : result.diagnostics)
    ADD_FAILURE() << format(diagnostic);
  coverage::noteRun(SinumerikBench::controlKind, bench.control.journal);

  const auto vector = [&](int first) { return Vector3(bench.ovr(first), bench.ovr(first + 1), bench.ovr(first + 2)); };
  const machine::MachineDescription real = simulation::trueDescription(truth.machine, truth.errors);
  // Rotary axis 2 is normalised to Z = 0; rotary axis 1 ends in the plane of its circle.
  const machine::ChainElement& c = real.tableChain.back();
  const Vector3 onC = c.point - c.direction * (c.point.z() / c.direction.z());
  EXPECT_LT((vector(15) - onC).norm(), 1e-5);
  EXPECT_EQ(vector(18), Vector3(-vector(15)));
  const machine::ChainElement& b = real.spindleChain.back();
  const Vector3 i2 = vector(4);
  EXPECT_LT((i2 - b.point).cross(b.direction).norm(), 1e-5);
  EXPECT_EQ(vector(1), Vector3(-i2));
  EXPECT_LT(angleBetween(vector(7), b.direction), 1e-8);
  EXPECT_LT(angleBetween(vector(10), c.direction), 1e-8);
  EXPECT_EQ(bench.data("$TC_CARR4", {1}), i2.x());
  EXPECT_THAT(bench.log("MIXED_BC_M1.SPF"), HasSubstr(fmt::format("$TC_CARR4[1]={:.6f} ", i2.x())));
  EXPECT_EQ(bench.ovr(40), 33);
}

}  // namespace
}  // namespace probewright
