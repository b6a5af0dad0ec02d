#pragma once

#include <array>
#include <string>
#include <vector>

/// The Q, QR and QS parameters of a HEIDENHAIN control: numbers that programs and cycles share.
namespace probewright::control::heidenhain {

class QParameters {
public:
  static constexpr int count = 2000;         ///< Q0 to Q1999, QS0 to QS1999
  static constexpr int remanentCount = 500;  ///< QR0 to QR499

  QParameters() : q_(count), undefined_(count, false), qs_(count) {}

  static bool exists(long number) { return number >= 0 && number < count; }

  /// Numbers in the unit of the program (Q113: 0 = mm, 1 = inch).
  double q(int number) const { return q_[index(number)]; }
  void setQ(int number, double value) {
    q_[index(number)] = value;
    undefined_[index(number)] = false;
  }
  bool isUndefined(int number) const { return undefined_[index(number)]; }
  void setUndefined(int number) {
    q_[index(number)] = 0;
    undefined_[index(number)] = true;
  }

  double qr(int number) const { return qr_[static_cast<std::size_t>(number)]; }
  void setQr(int number, double value) { qr_[static_cast<std::size_t>(number)] = value; }

  const std::string& qs(int number) const { return qs_[index(number)]; }
  void setQs(int number, std::string value) { qs_[index(number)] = std::move(value); }

private:
  static std::size_t index(int number) { return static_cast<std::size_t>(number); }

  std::vector<double> q_;
  std::vector<bool> undefined_;
  std::array<double, remanentCount> qr_{};
  std::vector<std::string> qs_;
};

}  // namespace probewright::control::heidenhain
