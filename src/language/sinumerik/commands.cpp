#include "language/sinumerik/commands.hpp"

#include <algorithm>
#include <array>

#include "language/sinumerik/keywords.hpp"

namespace probewright::language::sinumerik {

namespace {

struct NamedKind {
  std::string_view name;
  CommandKind kind;
};

/// Sorted by name.
constexpr std::array<NamedKind, 38> kinds = {{{"CALCDAT", CommandKind::CircleThroughPoints},
                                              {"CONTDCON", CommandKind::BeginRecording},
                                              {"CONTPRON", CommandKind::BeginRecording},
                                              {"CTABDEF", CommandKind::BeginRecording},
                                              {"CTABEND", CommandKind::EndRecording},
                                              {"DEF", CommandKind::Declare},
                                              {"DEFINE", CommandKind::Define},
                                              {"DELETE", CommandKind::DeleteFile},
                                              {"DL", CommandKind::OffsetNumber},
                                              {"EXECSTRING", CommandKind::ExecuteText},
                                              {"EXECUTE", CommandKind::EndRecording},
                                              {"FA", CommandKind::AxisFeed},
                                              {"G", CommandKind::GroupFunction},
                                              {"G4", CommandKind::Dwell},
                                              {"G74", CommandKind::ReferencePoint},
                                              {"G75", CommandKind::FixedPoint},
                                              {"GETEXET", CommandKind::FindTool},
                                              {"GETSELT", CommandKind::FindTool},
                                              {"ISOCALL", CommandKind::CallIsoProgram},
                                              {"LIMS", CommandKind::SpeedLimit},
                                              {"MEAS", CommandKind::Measure},
                                              {"MEASA", CommandKind::Measure},
                                              {"MEAW", CommandKind::Measure},
                                              {"MEAWA", CommandKind::Measure},
                                              {"MSG", CommandKind::Message},
                                              {"POS", CommandKind::PositionAxis},
                                              {"POSA", CommandKind::PositionAxis},
                                              {"POSP", CommandKind::PositionAxis},
                                              {"READ", CommandKind::ReadFile},
                                              {"REP", CommandKind::Fill},
                                              {"SET", CommandKind::Fill},
                                              {"SETAL", CommandKind::RaiseAlarm},
                                              {"SPOS", CommandKind::OrientSpindle},
                                              {"SPOSA", CommandKind::OrientSpindle},
                                              {"STOPRE", CommandKind::StopPreprocessing},
                                              {"TOFFL", CommandKind::ToolLengthOffset},
                                              {"TOFFR", CommandKind::ToolRadiusOffset},
                                              {"WRITE", CommandKind::WriteFile}}};
static_assert(std::ranges::is_sorted(kinds, {}, &NamedKind::name));

}  // namespace

CommandKind commandKind(std::string_view name) {
  const auto found = std::ranges::lower_bound(kinds, name, {}, &NamedKind::name);
  if (found != kinds.end() && found->name == name) return found->kind;
  return keywordOf(name) == Keyword::SynchronizedAction ? CommandKind::SynchronizedAction : CommandKind::Other;
}

}  // namespace probewright::language::sinumerik
