#include "session/heidenhain/remanent_parameters.hpp"

#include <fmt/format.h>

#include <sstream>

#include "base/file.hpp"
#include "base/number_text.hpp"
#include "language/klartext/formula_writer.hpp"

namespace probewright::session::heidenhain {

using control::heidenhain::QParameters;

void readRemanentParameters(const std::filesystem::path& tables, QParameters& q, Diagnostics& diagnostics) {
  const std::filesystem::path path = tables / remanentFile;
  std::error_code error;
  if (tables.empty() || !std::filesystem::is_regular_file(path, error)) return;
  const Result<std::string> text = readFile(path);
  if (!text) {
    diagnostics.push_back(text.error());
    return;
  }
  std::istringstream lines(*text);
  std::string line;
  for (std::uint64_t number = 1; std::getline(lines, line); ++number) {
    while (!line.empty() && (line.back() == '\r' || line.back() == ' '))
      line.pop_back();
    if (line.empty()) continue;
    const std::size_t sign = line.find(" = ");
    const bool named = line.starts_with("QR") && sign != std::string::npos;
    const auto index = named ? parseInteger(std::string_view(line).substr(2, sign - 2)) : std::nullopt;
    const auto value = named ? parseDecimal(std::string_view(line).substr(sign + 3)) : std::nullopt;
    if (!index || !value || *index < 0 || *index >= QParameters::remanentCount) {
      diagnostics.push_back({Severity::Error,
                             {path.string(), number, 1},
                             "this is not a QR parameter with its value",
                             line,
                             "write lines such as QR5 = 12.5, with numbers from QR0 to QR499",
                             {}});
      continue;
    }
    q.setQr(static_cast<int>(*index), *value);
  }
}

std::string remanentParametersText(const QParameters& q) {
  std::string text;
  for (int i = 0; i < QParameters::remanentCount; ++i) {
    if (!q.isQrUndefined(i)) text += fmt::format("QR{} = {}\n", i, language::klartext::writeNumber(q.qr(i)));
  }
  return text;
}

}  // namespace probewright::session::heidenhain
