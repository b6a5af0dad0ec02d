#pragma once

#include <string>
#include <vector>

#include "cycles/heidenhain/context.hpp"

/// The logs of cycles 450 to 453: HTML on the TNC 640, text on the iTNC 530. The manuals list what they hold and leave
/// the layout open.
namespace probewright::cycles::heidenhain {

class KinematicsLog {
public:
  using Rows = std::vector<std::vector<std::string>>;

  /// `file`: its ending decides on the form.
  KinematicsLog(Context& context, std::string file) : context_(context), file_(std::move(file)) {}

  /// Lines of a label and a value; those in a row become one table.
  void line(const std::string& label, const std::string& value);
  void table(const std::vector<std::string>& heading, const Rows& rows);
  /// Writes the file. A log in HTML grows with each call of a cycle, a text log is that of the last call.
  void write();

private:
  struct Table {
    std::vector<std::string> heading;
    Rows rows;
    bool lines = false;
  };
  std::string text() const;

  Context& context_;
  std::string file_;
  std::vector<Table> tables_;
};

extern const std::span<const LogTerm> kinematicsLogTerms;

}  // namespace probewright::cycles::heidenhain
