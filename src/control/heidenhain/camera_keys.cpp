#include "control/heidenhain/camera_keys.hpp"

#include <array>
#include <cmath>

#include "base/number_text.hpp"
#include "base/text.hpp"

namespace probewright::control::heidenhain {

namespace {

struct KeyName {
  std::string_view name;
  CameraKey key;
  std::size_t numbers = 0;  ///< that follow it
};

constexpr std::array keyNames = {
    KeyName{"BACK", CameraKey::Back},
    KeyName{"REPEAT", CameraKey::Repeat},
    KeyName{"REFERENCE IMAGE", CameraKey::ReferenceImage},
    KeyName{"REFERENCE IMAGE YES", CameraKey::ReferenceImage},
    KeyName{"ERROR IMAGE", CameraKey::ErrorImage},
    KeyName{"CONFIRM", CameraKey::Confirm},
    KeyName{"SELECT IMAGE", CameraKey::SelectImage, 1},
    KeyName{"DELETE IMAGE", CameraKey::DeleteImage},
    KeyName{"EVALUATE", CameraKey::Evaluate},
    KeyName{"CONFIGURE", CameraKey::Configure},
    KeyName{"DRAW AREA", CameraKey::DrawArea, 4},
    KeyName{"DELETE AREA", CameraKey::DeleteArea, 1},
    KeyName{"DRAW ERROR", CameraKey::DrawError, 4},
    KeyName{"DELETE ERROR", CameraKey::DeleteError, 1},
    KeyName{"SENSITIVITY", CameraKey::Sensitivity, 1},
    KeyName{"TEST IMAGE", CameraKey::TestImage},
    KeyName{"TEST ALL", CameraKey::TestAll},
    KeyName{"SHOW AREAS", CameraKey::ShowAreas},
    KeyName{"SHOW AVERAGE", CameraKey::ShowAverage},
    KeyName{"SAVE AND BACK", CameraKey::SaveAndBack},
    KeyName{"DISCARD AND BACK", CameraKey::DiscardAndBack},
};

std::optional<KeyStroke> keyStroke(std::string_view part) {
  std::string words;
  std::vector<double> numbers;
  while (!(part = trimmed(part, lineBlanks)).empty()) {
    const std::string_view word = part.substr(0, part.find_first_of(lineBlanks));
    part.remove_prefix(word.size());
    if (const auto number = parseDecimal(word)) {
      numbers.push_back(*number);
    } else if (numbers.empty()) {
      words += (words.empty() ? "" : " ") + upperCase(word);
    } else {
      return std::nullopt;
    }
  }
  for (const KeyName& known : keyNames) {
    if (known.name != words || known.numbers != numbers.size()) continue;
    KeyStroke stroke;
    stroke.key = known.key;
    stroke.text = words;
    if (known.numbers == 1) stroke.number = numbers[0];
    if (known.numbers == 4) {
      for (const double number : numbers)
        if (number != std::floor(number) || std::abs(number) > 1e5) return std::nullopt;
      const auto at = [&](std::size_t i) { return static_cast<int>(numbers[i]); };
      stroke.window = {at(0), at(1), at(2), at(3)};
    }
    return stroke;
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<KeyStroke>> keyStrokes(std::string_view text) {
  std::vector<KeyStroke> strokes;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(';'), text.size());
    const std::string_view part = trimmed(text.substr(0, end), lineBlanks);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (part.empty()) continue;
    auto stroke = keyStroke(part);
    if (!stroke) return std::nullopt;
    strokes.push_back(*std::move(stroke));
  }
  return strokes;
}

bool configures(CameraKey key) { return key >= CameraKey::DrawArea; }

}  // namespace probewright::control::heidenhain
