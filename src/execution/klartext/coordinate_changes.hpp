#pragma once

#include "execution/klartext/tilting.hpp"

namespace probewright::execution::klartext {

/// Coordinate transformations and presets: cycles 7, 8, 10, 11, 26, 247, TRANS, PRESET, FN 25. Tilted planes are
/// Tilting's.
class CoordinateChanges {
public:
  CoordinateChanges(RunContext& run, Tilting& tilting) : run_(run), control_(run.control), tilting_(tilting) {}

  void carryOut(const Transform& transform, Evaluation& evaluation);
  /// SEL TABLE.
  void selectDatumTable(const std::string& name);
  /// PRESET SELECT, PRESET COPY, PRESET CORR.
  void presetCommand(const Command& command, Evaluation& evaluation);
  /// FN 25: the position with the coordinate given gets the new value.
  void setPresetInAxis(const Command& command, Evaluation& evaluation);

private:
  void mirror(WordRange words, Evaluation& evaluation);
  void scaleAxes(WordRange words, Evaluation& evaluation);
  void shiftDatum(WordRange words, Evaluation& evaluation);
  void shiftAxis(char letter, double value, WordMode mode);
  void shiftDatumByTable(double row);
  enum class Earlier { End, Stay };
  void activatePreset(int row, Earlier transformations);
  int presetRowOf(const Word& word, Evaluation& evaluation) const;
  void correctPreset(control::heidenhain::ActivePreset& preset, control::heidenhain::Control::PresetChange& change,
                     WordRange words, Evaluation& evaluation);

  RunContext& run_;
  control::heidenhain::Control& control_;
  Tilting& tilting_;
};

}  // namespace probewright::execution::klartext
