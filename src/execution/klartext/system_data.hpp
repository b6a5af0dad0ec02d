#pragma once

#include <optional>
#include <string>

#include "execution/klartext/cycles.hpp"
#include "execution/klartext/motion.hpp"
#include "execution/klartext/parameters.hpp"
#include "execution/klartext/tools.hpp"

namespace probewright::execution::klartext {

/// FN 18 and FN 17: data of the control by group (ID), number (NR) and index (IDX), in mm and degrees whatever the unit
/// of the program. docs/klartext.md lists the groups.
class SystemData {
public:
  SystemData(RunContext& run, Parameters& parameters, Tools& tools, const Spindle& spindle, const Motion& motion,
             const Cycles& cycles)
      : run_(run),
        control_(run.control),
        parameters_(parameters),
        tools_(tools),
        spindle_(spindle),
        motion_(motion),
        cycles_(cycles) {}

  /// FN 18.
  void read(const Command& command, Evaluation& evaluation);
  /// FN 17.
  void write(const Command& command, Evaluation& evaluation);

private:
  // system_data.cpp
  std::optional<double> systemData(int id, int number, double index) const;
  std::optional<double> programData(int number, int index) const;
  std::optional<double> parameterData(int number, int index) const;
  std::optional<double> stateData(int number) const;
  std::optional<double> touchData(int number, int index) const;
  std::optional<double> tableData(int id, int number, int index) const;
  std::optional<double> probingState(int number, int index) const;
  std::optional<double> coordinateData(int id, int number, int index) const;
  // system_tool_data.cpp: tools and touch probes
  /// Why a column of the tool table that is known cannot be read or written: ": TOOL.T has no row 7"; else empty.
  std::string missingTool(int id, int number, double index) const;
  std::string toolRowOf(double index) const;
  std::optional<double> toolData(int number, const std::string& row) const;
  std::optional<double> toolCallData(int number) const;
  std::optional<double> toolCompensation(int number, double index) const;
  std::optional<double> probeData(int number, int index) const;

  RunContext& run_;
  control::heidenhain::Control& control_;
  Parameters& parameters_;
  Tools& tools_;
  const Spindle& spindle_;
  const Motion& motion_;
  const Cycles& cycles_;
};

}  // namespace probewright::execution::klartext
