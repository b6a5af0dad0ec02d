#include "exchange/formats.hpp"

#include <algorithm>
#include <array>

#include "base/text.hpp"

namespace probewright::exchange {

namespace {

template <std::string (*write)(const Inspection&)>
Result<std::string> always(const Inspection& inspection) {
  return write(inspection);
}

constexpr std::array kFormats = {
    Format{"csv", "inspection.csv", "a table of text, for any program", always<csvText>},
    Format{"xlsx", "inspection.xlsx", "a workbook for Excel or LibreOffice", xlsxFile},
    Format{"qif", "inspection.qif", "QIF 3.0 results (ISO 23952)", always<qifText>},
    Format{"dfq", "inspection.dfq", "AQDEF, for Q-DAS and other statistics programs", always<dfqText>},
    Format{"dmis", "inspection.dmo", "DMIS 5.2 output (ISO 22093)", always<dmisText>},
    Format{"junit", "junit.xml", "JUnit XML, for build servers that check programs", always<junitText>},
};

}  // namespace

std::span<const Format> formats() { return kFormats; }

const Format* formatNamed(std::string_view name) {
  const auto found = std::ranges::find_if(
      kFormats, [&](const Format& format) { return std::ranges::equal(format.name, name, {}, lower, lower); });
  return found == kFormats.end() ? nullptr : &*found;
}

}  // namespace probewright::exchange
