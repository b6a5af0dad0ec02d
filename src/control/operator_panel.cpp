#include "control/operator_panel.hpp"

#include "control/alarm.hpp"

namespace probewright::control {

void OperatorPanel::stop(const std::string& text, double seconds) {
  message(EventKind::Stop, text, seconds);
  if (onStop == OnStop::Continue) return;
  if (onStop == OnStop::Ask && ask && ask(text)) return;
  throw Cancelled();
}

}  // namespace probewright::control
