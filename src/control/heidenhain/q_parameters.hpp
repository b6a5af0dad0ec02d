#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

/// The Q, QR and QS parameters of a HEIDENHAIN control: numbers that programs and cycles share.
namespace probewright::control::heidenhain {

class QParameters {
public:
  static constexpr int count = 2000;         ///< Q0 to Q1999, QS0 to QS1999
  static constexpr int remanentCount = 500;  ///< QR0 to QR499

  static constexpr std::size_t longestText = 255;  ///< characters of a QS parameter

  QParameters() : q_(count), qs_(count) {}

  static bool exists(long number) { return number >= 0 && number < count; }

  /// Numbers in the unit of the program (Q113: 0 = mm, 1 = inch). A parameter that was never set is undefined and
  /// reads as 0, or as an empty text.
  double q(int number) const { return q_[index(number)].value_or(0); }
  void setQ(int number, double value) { q_[index(number)] = value; }
  bool isUndefined(int number) const { return !q_[index(number)]; }
  void setUndefined(int number) { q_[index(number)].reset(); }

  /// Remanent: they outlive the run.
  double qr(int number) const { return qr_[index(number)].value_or(0); }
  void setQr(int number, std::optional<double> value) { qr_[index(number)] = value; }
  bool isQrUndefined(int number) const { return !qr_[index(number)]; }

  const std::string& qs(int number) const {
    static const std::string empty;
    const auto& text = qs_[index(number)];
    return text ? *text : empty;
  }
  void setQs(int number, std::optional<std::string> value) { qs_[index(number)] = std::move(value); }
  bool isQsUndefined(int number) const { return !qs_[index(number)]; }

private:
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  std::vector<std::optional<double>> q_;
  std::array<std::optional<double>, remanentCount> qr_{};
  std::vector<std::optional<std::string>> qs_;
};

}  // namespace probewright::control::heidenhain
