#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "control/journal.hpp"
#include "records/run_info.hpp"

/// A run as a control would have recorded it, written down by hand: a block of 120 x 80 x 40 mm with a bore of 30 mm,
/// its rotation, datum and sizes measured by a Klartext program.
namespace probewright::sample {

inline constexpr double blockLength = 120, blockWidth = 80, blockHeight = 40;
inline constexpr double boreDiameter = 30, boreX = 20, boreY = 0;
inline constexpr double ballRadius = 3;

inline const std::string& programText() {
  static const std::string text =
      "0 BEGIN PGM BEARING_BLOCK MM\n"
      "1 ;BEARING BLOCK, 1ST SIDE - CLAMPED IN VICE\n"
      "2 BLK FORM 0.1 Z X-60 Y-40 Z-40\n"
      "3 BLK FORM 0.2 X+60 Y+40 Z+0\n"
      "4 * - ALIGN AND SET PRESET\n"
      "5 TOOL CALL \"PROBE_D6\" Z S0\n"
      "6 L Z+100 R0 FMAX\n"
      "7 TCH PROBE 400 BASIC ROTATION ~\n"
      "    Q263=-50    ;1ST POINT 1ST AXIS ~\n"
      "    Q264=-40    ;1ST POINT 2ND AXIS ~\n"
      "    Q265=+50    ;2ND POINT 1ST AXIS ~\n"
      "    Q266=-40    ;2ND POINT 2ND AXIS ~\n"
      "    Q272=+2     ;MEASURING AXIS ~\n"
      "    Q267=+1     ;TRAVERSE DIRECTION ~\n"
      "    Q261=-10    ;MEASURING HEIGHT ~\n"
      "    Q320=+2     ;SET-UP CLEARANCE ~\n"
      "    Q260=+50    ;CLEARANCE HEIGHT\n"
      "8 TCH PROBE 417 PRESET IN TS AXIS ~\n"
      "    Q263=-30    ;1ST POINT 1ST AXIS ~\n"
      "    Q264=+0     ;1ST POINT 2ND AXIS ~\n"
      "    Q294=+0     ;1ST POINT 3RD AXIS ~\n"
      "    Q320=+2     ;SET-UP CLEARANCE ~\n"
      "    Q260=+50    ;CLEARANCE HEIGHT ~\n"
      "    Q305=+5     ;NUMBER IN TABLE ~\n"
      "    Q333=+0     ;PRESET ~\n"
      "    Q303=+1     ;MEAS. VALUE TRANSFER\n"
      "9 TCH PROBE 412 PRESET INSIDE CIRCLE ~\n"
      "    Q321=+20    ;CENTER IN 1ST AXIS ~\n"
      "    Q322=+0     ;CENTER IN 2ND AXIS ~\n"
      "    Q262=+29.5  ;NOMINAL DIAMETER ~\n"
      "    Q325=+0     ;STARTING ANGLE ~\n"
      "    Q247=+90    ;STEPPING ANGLE ~\n"
      "    Q261=-10    ;MEASURING HEIGHT ~\n"
      "    Q320=+2     ;SET-UP CLEARANCE ~\n"
      "    Q260=+50    ;CLEARANCE HEIGHT ~\n"
      "    Q301=+0     ;MOVE TO CLEARANCE ~\n"
      "    Q305=+5     ;NUMBER IN TABLE ~\n"
      "    Q331=+20    ;PRESET ~\n"
      "    Q332=+0     ;PRESET\n"
      "10 CYCL DEF 247 PRESETTING ~\n"
      "    Q339=+5     ;PRESET NUMBER\n"
      "11 * - MEASURE\n"
      "12 TCH PROBE 421 MEASURE HOLE ~\n"
      "    Q273=+20    ;CENTER IN 1ST AXIS ~\n"
      "    Q274=+0     ;CENTER IN 2ND AXIS ~\n"
      "    Q262=+30    ;NOMINAL DIAMETER ~\n"
      "    Q275=+30.021 ;MAXIMUM DIMENSION ~\n"
      "    Q276=+30    ;MINIMUM DIMENSION ~\n"
      "    Q279=+0.05  ;TOLERANCE 1ST CENTER ~\n"
      "    Q280=+0.05  ;TOLERANCE 2ND CENTER\n"
      "13 TCH PROBE 424 MEASURE RECTANGLE OUTSIDE ~\n"
      "    Q273=+0     ;CENTER IN 1ST AXIS ~\n"
      "    Q274=+0     ;CENTER IN 2ND AXIS ~\n"
      "    Q282=+120   ;1ST SIDE LENGTH ~\n"
      "    Q283=+80    ;2ND SIDE LENGTH ~\n"
      "    Q284=+120.1 ;MAX. LIMIT 1ST SIDE ~\n"
      "    Q285=+119.9 ;MIN. LIMIT 1ST SIDE ~\n"
      "    Q286=+80.03 ;MAX. LIMIT 2ND SIDE ~\n"
      "    Q287=+79.97 ;MIN. LIMIT 2ND SIDE\n"
      "14 FN 16: F-PRINT BLOCK.MSK / SCREEN:\n"
      "15 L Z+100 R0 FMAX M30\n"
      "16 END PGM BEARING_BLOCK MM\n";
  return text;
}

/// The 1-based line of programText() that starts with `start`; 0 if there is none.
inline std::uint64_t lineOf(const std::string& start) {
  std::istringstream lines(programText());
  std::string line;
  for (std::uint64_t number = 1; std::getline(lines, line); ++number)
    if (line.rfind(start, 0) == 0) return number;
  return 0;
}

inline const std::string programPath = "programs/BEARING_BLOCK.H";

inline SourcePlace placeOf(const std::string& start) { return {programPath, lineOf(start), 1}; }

/// A touch at `surface` by a ball moving along `direction`.
inline control::TouchRecord touch(const Vector3& surface, const Vector3& direction, double seconds) {
  control::TouchRecord record;
  record.target = {std::round(surface.x()), std::round(surface.y()), std::round(surface.z())};
  record.direction = direction;
  record.surface = surface;
  record.ballCentre = surface - ballRadius * direction;
  for (std::size_t i = 0; i < 3; ++i)
    record.latched[i] = record.ballCentre[static_cast<Eigen::Index>(i)] + 300;
  record.seconds = seconds;
  record.outcome = "touched";
  return record;
}

inline control::ResultRecord plain(std::string name, std::string meaning, double value, std::string unit = "mm") {
  control::ResultRecord record;
  record.name = std::move(name);
  record.meaning = std::move(meaning);
  record.value = value;
  record.unit = std::move(unit);
  return record;
}

inline control::ResultRecord toleranced(std::string name, std::string meaning, double value, double nominal,
                                        double lower, double upper, control::Verdict verdict) {
  control::ResultRecord record = plain(std::move(name), std::move(meaning), value);
  record.nominal = nominal;
  record.deviation = value - nominal;
  record.lowerLimit = lower;
  record.upperLimit = upper;
  record.verdict = verdict;
  return record;
}

inline control::CycleRecord cycle(std::string name, std::string title, double start, double end, double path) {
  control::CycleRecord record;
  record.name = std::move(name);
  record.title = std::move(title);
  record.startSeconds = start;
  record.endSeconds = end;
  record.pathLength = path;
  return record;
}

inline control::CycleRecord basicRotation() {
  auto record = cycle("400", "Basic rotation", 8.2, 17.9, 342.6);
  record.place = placeOf("7 TCH PROBE 400");
  record.parameters = {{"Q263", "-50", "1st measuring point in the 1st axis", false},
                       {"Q265", "50", "2nd measuring point in the 1st axis", false},
                       {"Q261", "-10", "measuring height in the touch probe axis", false},
                       {"Q307", "0", "preset for the rotation angle", true}};
  record.touches = {touch({-50, -39.31, -10}, Vector3::UnitY(), 12.4),
                    touch({50, -36.69, -10}, Vector3::UnitY(), 15.8)};
  record.results = {plain("Q150", "actual value of the rotation angle", 1.5008123, "deg")};
  record.writes = {{"PRESET.PR", "row 5, column SPC", "+0.0000", "+1.5008"}};
  return record;
}

inline control::CycleRecord touchOffTop() {
  auto record = cycle("417", "Preset in the touch probe axis", 17.9, 24.1, 118.2);
  record.place = placeOf("8 TCH PROBE 417");
  record.parameters = {{"Q263", "-30", "1st measuring point in the 1st axis", false},
                       {"Q305", "5", "number in the table", false},
                       {"Q333", "0", "new preset", false}};
  record.touches = {touch({-30, 0, 0.214}, -Vector3::UnitZ(), 22.3)};
  record.results = {plain("Q160", "actual value of the measured point", 0.214)};
  record.writes = {{"PRESET.PR", "row 5, column Z", "-412.300", "-412.086"}};
  return record;
}

inline std::vector<control::TouchRecord> boreTouches(double diameter, double height, double start) {
  std::vector<control::TouchRecord> touches;
  for (int i = 0; i < 4; ++i) {
    const double angle = i * std::numbers::pi / 2;
    const Vector3 outward(std::round(std::cos(angle)), std::round(std::sin(angle)), 0);
    touches.push_back(touch(Vector3(boreX, boreY, height) + diameter / 2 * outward, outward, start + 3.2 * i));
  }
  return touches;
}

inline control::CycleRecord presetInBore() {
  auto record = cycle("412", "Preset at the centre of a hole", 24.1, 43.5, 402.9);
  record.place = placeOf("9 TCH PROBE 412");
  record.parameters = {{"Q321", "20", "centre in the 1st axis", false},
                       {"Q262", "29.5", "nominal diameter", false},
                       {"Q247", "90", "stepping angle", false},
                       {"Q303", "1", "transfer of the measured value", true}};
  record.touches = boreTouches(30.012, -10, 28.0);
  record.results = {plain("Q151", "actual value, centre in the main axis", 20.4371),
                    plain("Q152", "actual value, centre in the minor axis", -0.1822),
                    plain("Q153", "actual value, diameter", 30.012)};
  record.writes = {{"PRESET.PR", "row 5, column X", "+251.000", "+251.437"},
                   {"PRESET.PR", "row 5, column Y", "-98.500", "-98.682"}};
  return record;
}

inline control::CycleRecord measureHole() {
  using control::Verdict;
  auto record = cycle("421", "Measure a hole", 44.0, 62.8, 377.4);
  record.place = placeOf("12 TCH PROBE 421");
  record.parameters = {{"Q273", "20", "centre in the 1st axis", false},
                       {"Q275", "30.021", "maximum limit of size", false},
                       {"Q276", "30", "minimum limit of size", false},
                       {"Q281", "1", "measuring log", true}};
  record.touches = boreTouches(30.0119, -15, 48.0);
  record.results = {
      toleranced("Q151", "actual value, centre in the main axis", 20.0008, 20, 19.95, 20.05, Verdict::Good),
      toleranced("Q152", "actual value, centre in the minor axis", -0.0005, 0, -0.05, 0.05, Verdict::Good),
      toleranced("Q153", "actual value, diameter", 30.0119, 30, 30, 30.021, Verdict::Good)};
  record.results.back().uncertainty = 0.0017;
  record.logFiles = {"TCHPR421.TXT"};
  record.verdict = Verdict::Good;
  return record;
}

inline control::CycleRecord measureRectangle() {
  using control::Verdict;
  auto record = cycle("424", "Measure a rectangular stud", 62.8, 91.4, 812.3);
  record.place = placeOf("13 TCH PROBE 424");
  record.parameters = {{"Q282", "120", "length of the 1st side", false},
                       {"Q283", "80", "length of the 2nd side", false},
                       {"Q286", "80.03", "maximum limit of the 2nd side", false},
                       {"Q287", "79.97", "minimum limit of the 2nd side", false}};
  record.touches = {touch({60.021, 0, -10}, -Vector3::UnitX(), 68.1), touch({-60.019, 0, -10}, Vector3::UnitX(), 74.4),
                    touch({0, 40.029, -10}, -Vector3::UnitY(), 80.2),
                    touch({0, -40.0251, -10}, Vector3::UnitY(), 86.5)};
  record.results = {
      toleranced("Q154", "actual value, side length in the main axis", 120.04, 120, 119.9, 120.1, Verdict::Good),
      toleranced("Q155", "actual value, side length in the minor axis", 80.0541, 80, 79.97, 80.03, Verdict::Rework)};
  record.logFiles = {"TCHPR424.TXT"};
  record.screens = {"Measuring log 424\nSide length in minor axis:   80.0541\n"};
  record.verdict = Verdict::Rework;
  return record;
}

/// The run that finishes: one side is 0.024 mm above its limit.
inline control::Journal journal() {
  control::Journal journal;
  journal.cycles = {basicRotation(), touchOffTop(), presetInBore(), measureHole(), measureRectangle()};
  journal.writes = {{"PRESET.PR", "active row", "0", "5"}};
  journal.events = {{control::EventKind::Tool, placeOf("5 TOOL CALL"), "", "PROBE_D6, length 112.430", 0.0},
                    {control::EventKind::Message, placeOf("14 FN 16"), "", "BORE 30.012 / WIDTH 80.054", 91.5}};
  return journal;
}

/// The same program, stopped by the control in its third cycle.
inline control::Journal alarmJournal() {
  control::Journal journal;
  journal.cycles = {basicRotation(), touchOffTop(), presetInBore()};
  auto& broken = journal.cycles.back();
  broken.touches.resize(2);
  broken.touches.back().outcome = "no contact";
  broken.results.clear();
  broken.writes.clear();
  broken.alarm = "Touch point inaccessible";
  journal.events = {{control::EventKind::Tool, placeOf("5 TOOL CALL"), "", "PROBE_D6, length 112.430", 0.0},
                    {control::EventKind::Alarm, broken.place, "Touch point inaccessible",
                     "no contact within the measuring path of 10 mm", 33.7}};
  return journal;
}

inline records::RunInfo runInfo() {
  records::RunInfo run;
  run.programs = {{programPath, programText()}};
  run.language = "Klartext";
  run.control = "TNC640";
  run.machine = "3-axis mill";
  run.axes = {{"X", machine::AxisKind::Linear, -10, 1010, 30000, 3000, false},
              {"Y", machine::AxisKind::Linear, -510, 10, 30000, 3000, false},
              {"Z", machine::AxisKind::Linear, -510, 10, 30000, 3000, false}};
  run.setupPath = "setups/vice.toml";
  run.partName = "Bearing block";
  run.partPath = "parts/bearing_block.step";
  run.seed = 20260707;
  run.version = "0.1.0";
  run.startedAt = "2026-07-07T18:42:10+02:00";
  run.totalSeconds = 95.2;
  run.totalPathLength = 2311.8;
  run.outputFiles = {"PRESET.PR", "TCHPR421.TXT", "TCHPR424.TXT"};
  run.exit = records::ExitState::OutOfTolerance;
  run.exitText = "Q155 of cycle 424 is above its upper limit";
  return run;
}

inline records::RunInfo alarmRunInfo() {
  auto run = runInfo();
  run.exit = records::ExitState::Stopped;
  run.exitText = "Touch point inaccessible: no contact within the measuring path of 10 mm";
  run.totalSeconds = 33.7;
  run.totalPathLength = 640.2;
  run.outputFiles.clear();
  return run;
}

}  // namespace probewright::sample
