#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "machine/machine.hpp"
#include "machine/own_control.hpp"

/// The words that engine and adapter speak; docs/machine-adapters.md describes them. What is read comes from another
/// program: whatever it does not say, or says wrongly, throws Breach.
namespace probewright::adapter {

/// Counts up when a line of an older engine or adapter would be understood wrongly.
inline constexpr int protocolVersion = 1;

using Json = nlohmann::json;

/// The other side does not keep to the protocol.
class Breach : public std::runtime_error {
public:
  using std::runtime_error::runtime_error;
};

/// How an order ended. `failed` is not among a machine's ends: drives off, an emergency stop, a broken wire. It is an
/// end of every order, and the machine does not get well by another order.
inline constexpr std::string_view failed = "failed";

std::string_view word(machine::MoveEnd end);
std::string_view word(machine::MeasureEnd end);
std::string_view word(machine::FunctionEnd end);
std::string_view word(machine::ToolChangeEnd end);
std::string_view word(machine::WaitEnd end);
std::string_view word(machine::Sensor sensor);
std::string_view word(machine::TouchWith part);
std::string_view word(machine::Rotation rotation);

machine::MoveEnd moveEnd(std::string_view word);
machine::MeasureEnd measureEnd(std::string_view word);
machine::FunctionEnd functionEnd(std::string_view word);
machine::ToolChangeEnd toolChangeEnd(std::string_view word);
machine::WaitEnd waitEnd(std::string_view word);
machine::Sensor sensor(std::string_view word);
machine::TouchWith touchWith(std::string_view word);
machine::Rotation rotation(std::string_view word);

Json toJson(const machine::AxisPositions& positions, std::size_t axes);
machine::AxisPositions positions(const Json& json, std::size_t axes);
Json toJson(const machine::OwnTables& tables, std::size_t axes);
machine::OwnTables ownTables(const Json& json, std::size_t axes);
/// The feed goes into `order`: "feed", or "rapid": true.
void addFeed(Json& order, machine::Feed feed);
machine::Feed feed(const Json& order);

Json toJson(const machine::MachineDescription& machine);
/// Without chains the linear axes carry the tool.
machine::MachineDescription description(const Json& json);

/// The line as JSON object.
Json parseLine(std::string_view line);
const Json& member(const Json& object, const char* name);
double number(const Json& object, const char* name);
std::string text(const Json& object, const char* name);
/// Empty if it is not there.
std::string optionalText(const Json& object, const char* name);

}  // namespace probewright::adapter
