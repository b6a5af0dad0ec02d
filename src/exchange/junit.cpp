#include <fmt/format.h>

#include <pugixml.hpp>
#include <sstream>

#include "base/number_text.hpp"
#include "exchange/formats.hpp"

namespace probewright::exchange {

namespace {

std::string limitsText(const Row& row) {
  const auto limit = [&](const std::optional<double>& value) {
    return value ? formatFixed(*value, 6) : std::string("none");
  };
  if (!row.lowerLimit && !row.upperLimit) return fmt::format("{} = {}", row.result, formatShortest(row.actual));
  return fmt::format("{} = {} {}, limits {} and {}", row.result, formatFixed(row.actual, 6), row.unit,
                     limit(row.lowerLimit), limit(row.upperLimit));
}

}  // namespace

std::string junitText(const Inspection& inspection) {
  pugi::xml_document document;
  pugi::xml_node declaration = document.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node suites = document.append_child("testsuites");
  pugi::xml_node suite = suites.append_child("testsuite");
  const std::string program = inspection.run.programs.empty() ? "program" : inspection.run.programs.front().path;
  suite.append_attribute("name") = program.c_str();
  int tests = 0, failures = 0, errors = 0;
  const auto testCase = [&](const std::string& name, const std::string& file, std::uint64_t line) {
    ++tests;
    pugi::xml_node node = suite.append_child("testcase");
    node.append_attribute("name") = name.c_str();
    node.append_attribute("classname") = program.c_str();
    node.append_attribute("file") = file.c_str();
    node.append_attribute("line") = static_cast<unsigned long long>(line);
    return node;
  };
  for (const Row& row : inspection.rows) {
    if (row.verdict == control::Verdict::None) continue;
    pugi::xml_node node = testCase(nameOf(row), row.program, row.line);
    if (row.verdict == control::Verdict::Good) continue;
    ++failures;
    pugi::xml_node failure = node.append_child("failure");
    const bool scrap = row.verdict == control::Verdict::Scrap;
    failure.append_attribute("message") =
        fmt::format("out of tolerance ({}): {}", scrap ? "scrap" : "rework", limitsText(row)).c_str();
    failure.append_attribute("type") = scrap ? "scrap" : "rework";
  }
  for (const Failure& failed : inspection.failures) {
    const std::string name = fmt::format("{} {}{}: ends without alarm", failed.cycle, failed.cycleName,
                                         failed.feature.empty() ? "" : " " + failed.feature);
    pugi::xml_node node = testCase(name, failed.program, failed.line);
    ++errors;
    pugi::xml_node error = node.append_child("error");
    error.append_attribute("message") = failed.alarm.c_str();
    error.append_attribute("type") = "alarm";
  }
  {
    // The whole run is a case of its own: a program that stops between its cycles must not pass.
    pugi::xml_node node = testCase("the program runs to its end", program, 0);
    node.remove_attribute("line");
    const records::ExitState exit = inspection.run.exit;
    if (exit != records::ExitState::Good && exit != records::ExitState::OutOfTolerance) {
      ++errors;
      pugi::xml_node error = node.append_child("error");
      error.append_attribute("message") = inspection.run.exitText.c_str();
      error.append_attribute("type") = "stopped";
    }
  }
  for (pugi::xml_node node : {suites, suite}) {
    node.append_attribute("tests") = tests;
    node.append_attribute("failures") = failures;
    node.append_attribute("errors") = errors;
    node.append_attribute("time") = formatFixed(inspection.run.totalSeconds, 3).c_str();
  }
  if (!inspection.run.startedAt.empty()) suite.append_attribute("timestamp") = inspection.run.startedAt.c_str();
  std::ostringstream text;
  document.save(text, "  ");
  return text.str();
}

}  // namespace probewright::exchange
